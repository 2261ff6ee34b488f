# SPDX-License-Identifier: Apache-2.0
# rooms.txt as the table of CONTRIBUTING.md.
BEGIN {
    FS = "|"
    print "| room | what it is for | may include |"
    print "|---|---|---|"
}
{
    uses = $2
    gsub(/format\/include\/pointrt/, "pointrt/*.h", uses)
    gsub(/ /, ", ", uses)
    if (uses == "") uses = "nothing of ours"
    printf "| `%s` | %s | %s |\n", $1, $3, uses
}
