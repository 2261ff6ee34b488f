# SPDX-License-Identifier: Apache-2.0
# The table at the end of demo.sh, from the flattened figures of pointrt-bake --stats and pointrt-view --bench.

BEGIN { FS = "\t" }

{ value[$1] = $2 }
$1 ~ /^bake\.seconds\./ { stages[++stage_count] = substr($1, 14) }

# 1234567 as 1,234,567.
function grouped(number,    digits, tail) {
    digits = sprintf("%.0f", number)
    while (length(digits) > 3) {
        tail = "," substr(digits, length(digits) - 2) tail
        digits = substr(digits, 1, length(digits) - 3)
    }
    return digits tail
}

function row(label, text) { printf "  %-22s %s\n", label, text }
function each(count) { return sprintf("%.2f", value["bake.splats"] > 0 ? count / value["bake.splats"] : 0) }

END {
    row("points read", grouped(value["bake.input_points"]))
    row("splats", grouped(value["bake.splats"]))
    row("leaves", grouped(value["bake.filled_leaves"]) " filled, " grouped(value["bake.empty_leaves"]) " empty")
    row("references per splat", each(value["bake.references_unpruned"]) " -> " each(value["bake.references"]) " pruned")
    row("bytes", grouped(value["bake.bytes"]))
    row("bytes per splat", each(value["bake.bytes"]))
    row("peak memory", grouped(value["bake.peak_rss_bytes"] / 1048576) " MiB")
    for (i = 1; i <= stage_count; i++) row("seconds, " stages[i], sprintf("%.2f", value["bake.seconds." stages[i]]))
    row("device", value["bench.device"])
    row("frame", sprintf("%.1f ms (median), %dx%d, %d samples", value["bench.frame_ms.median"], value["bench.width"],
                         value["bench.height"], value["bench.spp"]))
    row("rays a frame", grouped(value["bench.rays.primary"]) " primary, " grouped(value["bench.rays.shadow"]) \
        " shadow, " grouped(value["bench.rays.secondary"]) " secondary")
    row("rays a second", sprintf("%.2f million", value["bench.mrays_per_second"]))
}
