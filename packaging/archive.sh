# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2034 # its variables are for the script that sources it
# Functions shared by the scripts that make archives of the tools. Source it from the repository's root, after
# .ci/common.sh.

export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)}
umask 022
version=$(sed -n 's/^project(pointrt VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

# installTree BUILD NAME: installs the tools of a build folder, with documentation and licences, into $tree, the folder
# NAME of the temporary folder $work.
installTree() {
    local component
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    tree=$work/$2
    for component in tools docs licences; do
        cmake --install "$1" --prefix "$tree" --component $component --strip >"$work/log" || die "$(tail -1 "$work/log")"
    done
}

# copyLicences FOLDER PACKAGE...: copies the licences of packages (unpacked or installed) into a folder.
copyLicences() {
    local folder=$1 package copyright
    shift
    mkdir -p "$folder"
    for package in "$@"; do
        copyright=/usr/share/doc/$package/copyright
        [ -e "$copyright" ] || copyright=build/headers$copyright
        cp -L "$copyright" "$folder/$package.copyright"
    done
}
