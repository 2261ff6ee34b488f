# SPDX-License-Identifier: Apache-2.0
# rooms.txt as the map of CONTRIBUTING.md.
BEGIN {
    FS = "|"
    print "| room | what it is for |"
    print "|---|---|"
}
{ printf "| `%s` | %s |\n", $1, $3 }
