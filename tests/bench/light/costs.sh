#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The cost of each effect: renders one scan with the same camera, 512x512 and 4 samples per pixel, with one effect after
# the other. Prints a table: milliseconds per frame (median of FRAMES), numbers of rays, and million rays per second.
#   tests/bench/light/costs.sh BIN_DIR SCAN.pro       # FRAMES=3
set -euo pipefail
[ $# -eq 2 ] || {
    sed -n '3,5s/^# //p' "$0" >&2
    exit 2
}
view=$(cd "$1" && pwd)/pointrt-view scan=$(realpath "$2") frames=${FRAMES:-3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The scan's bounding box, to place a floor and lamps.
read -r low_y size center_x center_z < <("$(dirname "$view")/pointrt-info" "$scan" --json | python3 -c '
import json, sys
info = json.load(sys.stdin)
lo, hi = info["bounds_min"], info["bounds_max"]
print(lo[1], max(h - l for l, h in zip(lo, hi)), (lo[0] + hi[0]) / 2, (lo[2] + hi[2]) / 2)')

# scene NAME LAMP MATERIAL: LAMP point or sphere, MATERIAL the lines of a material
scene() {
    local lamp='type = "point"
position = [%s, %s, %s]
intensity = %s'
    [ "$2" = point ] || lamp='type = "sphere"
center = [%s, %s, %s]
radiance = %s
radius = '$(python3 -c "print(0.2 * $size)")
    {
        printf '[[instance]]\nfile = "%s"\nmaterial = "body"\n[material.body]\n%s\n' "$scan" "$3"
        printf '[material.floor]\nkind = "matte"\ncolor = [0.5, 0.5, 0.5]\n[[shape]]\ntype = "plane"\nmaterial = "floor"\n'
        printf 'point = [0, %s, 0]\nnormal = [0, 1, 0]\n[[light]]\n' "$low_y"
        # shellcheck disable=SC2059,SC2046
        printf "$lamp\n" $(python3 -c "
s = $size
print($center_x - 1.5 * s, $low_y + 3 * s, $center_z + 1.5 * s, 18 * s * s if '$2' == 'point' else 140)")
    } >"$work/$1.toml"
}

matte='kind = "matte"'
scene hard point "$matte"
scene soft sphere "$matte"
scene metal sphere $'kind = "metal"\nroughness = 0.3'
scene mirror sphere 'kind = "mirror"'
scene glass sphere 'kind = "glass"'

# row TITLE SCENE OPTION...: renders a scene and prints its row of the table.
row() {
    local title=$1 file=$2
    shift 2
    "$view" "$work/$file.toml" --bench "$frames" "$@" | python3 -c '
import json, sys
d = json.load(sys.stdin)
rays = d["rays"]
print("| %s | %.0f | %s | %.1f |" % (sys.argv[1], d["frame_ms"]["median"],
      " | ".join(f"{rays[k]:,}" for k in ("primary", "shadow", "secondary")), d["mrays_per_second"]))' "$title"
}

echo "| effect | ms | primary | shadow | secondary | Mrays/s |"
echo "|---|---|---|---|---|---|"
row "matte, one lamp, no shadows" hard --integrator phong --shadows off
row "hard shadows" hard --integrator phong
row "soft shadows" soft --integrator phong
row "mirror, whitted" mirror --integrator whitted --bounces 8 --caustics off
row "rough metal, whitted" metal --integrator whitted --bounces 8 --caustics off
row "glass, whitted: reflected and refracted" glass --integrator whitted --bounces 8 --caustics off
row "glass with its caustic, whitted" glass --integrator whitted --bounces 8
row "matte, path, 4 bounces" soft --integrator path --bounces 4
row "glass, path, 8 bounces" glass --integrator path --bounces 8 --caustics off
row "glass with its caustic, path, 8 bounces" glass --integrator path --bounces 8
