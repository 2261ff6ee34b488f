# SPDX-License-Identifier: Apache-2.0
# Prints rooms.txt as the table of CONTRIBUTING.md.
BEGIN {
    FS = "|"
    print "| room | what it is for |"
    print "|---|---|"
}
{ printf "| `%s` | %s |\n", $1, $3 }
