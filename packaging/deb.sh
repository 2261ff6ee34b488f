#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the packages for this Debian release (12 or 13), installing what is missing: pointrt, libpointrt-dev and
# pointrt-doc, and pointrt.spdx.json, their bill of materials. The result is in build/package/packages. Reproducible: the
# only date is that of the newest commit, and there are no paths of this machine (tests/release/reproducible.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
. .ci/common.sh

# The date of everything in the packages.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)}
umask 022

installPackages build bake view package
buildPreset package
out=build/package/packages
rm -rf "$out"
cpack --config build/package/CPackConfig.cmake -B "$out" >build/package/cpack.log || {
    cat build/package/cpack.log >&2
    die "cpack could not make the packages"
}
rm -rf "$out/_CPack_Packages"
python3 packaging/sbom.py >"$out/pointrt.spdx.json"
say "packages: $PWD/$out"
ls -l "$out"
