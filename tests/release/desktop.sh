#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# File managers recognise a .pro file by its first bytes, whatever its name, and do not mistake Qt project files for
# one. desktop.sh CASE REPOSITORY
set -euo pipefail
desktop=$2/packaging/desktop golden=$2/tests/format/golden/tiny_v1_4.pro

fail() {
    echo "$*" >&2
    exit 1
}
needs() { command -v "$1" >/dev/null || { echo "SKIPPED: no $1 here" >&2 && exit 77; }; }
tidyFolder() {
    cd "$(mktemp -d)"
    trap 'rm -rf "$PWD"' EXIT
}
# typeOf FILE: its MIME type, by this machine's definitions and ours.
typeOf() { XDG_DATA_HOME=$PWD/share gio info -a standard::content-type "$1" | sed -n 's/.*content-type: //p'; }

case_mime_type() {
    needs update-mime-database
    needs gio
    tidyFolder
    mkdir -p share/mime/packages
    cp "$desktop/pointrt.xml" share/mime/packages
    update-mime-database share/mime 2>/dev/null
    cp "$golden" scan.pro
    cp "$golden" scan
    printf 'TEMPLATE = app\nSOURCES += main.cpp\n' >project.txt
    for file in scan.pro scan; do
        [ "$(typeOf $file)" = model/x-pointrt ] || fail "$file is taken for $(typeOf $file)"
    done
    [ "$(typeOf project.txt)" = text/plain ] || fail "a text is taken for $(typeOf project.txt)"
    # Qt Creator's definition
    cat >share/mime/packages/qt.xml <<'END'
<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info"><mime-type type="application/vnd.qt.qmakeprofile">
<sub-class-of type="text/plain"/><glob pattern="*.pro"/></mime-type></mime-info>
END
    update-mime-database share/mime 2>/dev/null
    cp project.txt project.pro
    [ "$(typeOf scan.pro)" = model/x-pointrt ] || fail "scan.pro is taken for $(typeOf scan.pro) beside Qt's type"
    [ "$(typeOf project.pro)" = application/vnd.qt.qmakeprofile ] || fail "Qt's project is taken for $(typeOf project.pro)"
}
# The desktop files refer to each other's types and to existing files.
case_entries() {
    local type
    type=$(sed -n 's/.*mime-type type="\([^"]*\)".*/\1/p' "$desktop/pointrt.xml")
    grep -qx "MimeType=$type;" "$desktop/pointrt.desktop" || fail "pointrt.desktop does not open $type"
    grep -qx "MimeType=$type;" "$desktop/pointrt.thumbnailer" || fail "pointrt.thumbnailer is not for $type"
    [ -e "$desktop/$(sed -n 's/^Icon=//p' "$desktop/pointrt.desktop").svg" ] || fail "the icon is not there"
    if command -v desktop-file-validate >/dev/null; then desktop-file-validate "$desktop/pointrt.desktop"; fi
}

"case_$1" "$@"
