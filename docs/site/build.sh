#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the documentation site from the repository's Markdown: docs/site/build.sh OUT
# Needs mkdocs and mkdocs-material. Broken links and pages without a place in the navigation are errors.
set -euo pipefail
[ $# = 1 ] || {
    echo "usage: docs/site/build.sh OUT" >&2
    exit 2
}
out=$(realpath -m "$1")
root=$(realpath "$(dirname "$0")/../..")
pages=$(mktemp -d)
trap 'rm -rf "$pages"' EXIT
cd "$root"
python3 tests/structure/doc_links.py "$root" --list | while IFS= read -r file; do
    install -D -m 644 "$file" "$pages/$file"
done
POINTRT_SITE_PAGES=$pages POINTRT_SITE_OUT=$out mkdocs build --strict --config-file docs/site/mkdocs.yml
