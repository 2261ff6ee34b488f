#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Unpacks a Python for 64-bit Windows into a folder: python.exe, its standard library, headers and import libraries.
# Maven downloads it from JavaCPP's presets.
#   packaging/windows/python.sh FOLDER
# Does nothing if the folder already has this version.
set -euo pipefail
folder=$1 artifact=org.bytedeco:cpython:3.13.5-1.5.12:jar:windows-x86_64
[ "$(cat "$folder/made_of" 2>/dev/null)" != $artifact ] || exit 0
command -v mvn >/dev/null || { echo "mvn is missing: install the package maven" >&2 && exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$work" # Maven must not find a project
mvn -q -B dependency:unpack -Dartifact=$artifact -DoutputDirectory="$work/all" -Dmdep.unpack.excludes='**/test/**' >log ||
    { cat log >&2 && exit 1; }
mkdir -p "$folder"
cp -r all/org/bytedeco/cpython/windows-x86_64/. "$folder"
echo $artifact >"$folder/made_of"
