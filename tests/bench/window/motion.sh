#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Picture quality during motion: frames of a replayed window, compared with the same views at rest.
#   tests/bench/window/motion.sh BIN SCENE.pro [ROOM] [OPTIONS...]     BIN: the folder of pointrt-view; OPTIONS: its own
# For a slow orbit, a fast orbit and a moving lamp: FLIP of moving frames and pictures of 4 samples (mean, and the worst
# 5% of the pixels), the same for disoccluded pixels only, and frame times. Needs no window. FLIP and its Python
# environment: as in tests/bench/quality/flip.sh, with numpy and pillow.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || {
    sed -n '3,7s/^# //p' "$0" >&2
    exit 2
}
bin=$(cd "$1" && pwd)
scene=$(realpath "$2")
room=${3:-matte}
shift $(($# > 2 ? 3 : 2))
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
environment=${FLIP_ENVIRONMENT:-$folder/environment}
if [ ! -e "$environment/bin/python" ]; then
    python3 -m venv "$environment"
    "$environment/bin/pip" install -q --disable-pip-version-check flip-evaluator==1.7 numpy pillow
fi

echo "| $(basename "$scene"), $room | FLIP | worst 5% of pixels | come to light | frame, ms: median | 95% | pixels traced |"
echo "|---|---|---|---|---|---|---|"
for motion in slow fast lamp; do
    [ "$motion $room" != "lamp none" ] || continue # a studio's lamps are in another panel
    for kind in moving resting; do
        mkdir -p "$folder/$motion/$kind"
        python3 "$here/motion.py" "$motion" "$kind" >"$folder/$motion/$kind.txt"
        (cd "$folder/$motion/$kind" &&
            "$bin/pointrt-view" "$scene" --room "$room" "$@" --replay "$folder/$motion/$kind.txt" --offscreen \
                --stats stats.json 2>/dev/null)
    done
    "$environment/bin/python" "$here/compare_motion.py" "$motion" "$folder/$motion"
    [ -z "${KEEP:-}" ] || cp -r "$folder/$motion" "$KEEP"
done
