# SPDX-License-Identifier: Apache-2.0
# Flattens JSON: one line "path<TAB>value" for each number, string and literal; seconds.total, rays.0 and so on.
# For scripts on a machine that has neither jq nor Python. Input is expected to be valid JSON.

{ text = text $0 "\n" }

# The path of the value that comes now; inside an array it counts on.
function path(    i, joined) {
    if (depth > 0 && kind[depth] == "array") key[depth] = count[depth]++
    for (i = 1; i <= depth; i++) joined = joined (i > 1 ? "." : "") key[i]
    return joined
}

function open(new_kind) {
    path()
    depth++
    kind[depth] = new_kind
    count[depth] = 0
}

END {
    while (match(text, /"([^"\\]|\\.)*"|[-+.0-9a-zA-Z]+|[][{}:,]/)) {
        token = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        if (token == "{") open("object")
        else if (token == "[") open("array")
        else if (token == "}" || token == "]") depth--
        else if (token == ":") key[depth] = name
        else if (token != ",") {
            name = token
            if (substr(token, 1, 1) == "\"") name = substr(token, 2, length(token) - 2)
            if (kind[depth] == "array" || text !~ /^[ \t\r\n]*:/) print path() "\t" name
        }
    }
}
