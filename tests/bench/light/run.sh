#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compares pictures of splats with pictures that independent path tracers render of the original meshes.
#   tests/bench/light/run.sh BIN_DIR OUT_DIR [SCENE...]
# Writes to OUT_DIR the scenes, the linear pictures as EXR, comparisons as PNG and JSON, and RESULTS.md, also printed.
# Keeps references from earlier runs if their scene has not changed; delete them to render them again.
# Scenes (default: all): diffuse mirror metal glass soft-shadow sky, and caustic-glass, caustic-exact-glass (with an analytic
# ball) and caustic-ring, of which only the caustic is compared, with light traced on Mitsuba's surfaces. Settings, from the
# environment, with defaults:
#   SPP=256             samples per pixel of pointrt-view
#   MITSUBA_SPP=512     of Mitsuba, the reference (its metal scatters once only, 5 to 10% too dark at roughness 0.5)
#   PHOTONS=250         million light paths for the reference of a caustic
#   CHECK_SPP=1024      of Mitsuba's paths from the eye, whose total light must equal that of the reference; 0: no check
#   CYCLES_SPP=256      of Blender's Cycles, the reference for metal and a second reference for others; 0: without
#   SIZE=512            pixels of a side; SPACING=0.5 pixels between splats where the camera is nearest
#   VIEW_OPTIONS=       more options for pointrt-view
# Installs Debian's blender, libllvm19 and python3-venv where they are missing (root or sudo), and Mitsuba, FLIP and
# OpenEXR from PyPI into OUT_DIR/environment.
set -euo pipefail
[ $# -ge 2 ] || {
    sed -n '3,18s/^# //p' "$0" >&2
    exit 2
}
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
shift 2
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(diffuse mirror metal glass soft-shadow sky caustic-{glass,exact-glass,ring})
spp=${SPP:-256} mitsuba_spp=${MITSUBA_SPP:-512} cycles_spp=${CYCLES_SPP:-256}
photons=${PHOTONS:-250} check_spp=${CHECK_SPP:-1024}
size=${SIZE:-512} spacing=${SPACING:-0.5}
read -ra view_options <<<"${VIEW_OPTIONS:-}"

say() { printf '==> %s\n' "$*" >&2; }

installPackages() {
    local package missing=()
    for package in libllvm19 python3-venv $([ "$cycles_spp" = 0 ] || echo blender); do
        dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -x installed >/dev/null || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    say "installing ${missing[*]}"
    local as_root=()
    [ "$(id -u)" = 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get -q update >&2
    "${as_root[@]}" apt-get -q -y install --no-install-recommends "${missing[@]}" >&2
}

installPython() {
    [ -e "$out/environment/complete" ] && return
    say "installing Mitsuba, FLIP and OpenEXR"
    python3 -m venv "$out/environment"
    "$out/environment/bin/pip" install -q --disable-pip-version-check \
        mitsuba==3.9.1 flip-evaluator==1.7 OpenEXR==3.5.3 numpy==2.4.6 pillow==13.0.0
    touch "$out/environment/complete"
}

# timed NAME COMMAND...: runs it with its output in NAME.log, and records the seconds it took.
timed() {
    local name=$1 started=$SECONDS
    shift
    "$@" >"$out/$name.log" 2>&1 || {
        cat "$out/$name.log" >&2
        exit 1
    }
    say "$name: $((SECONDS - started)) s"
}

bakeAll() {
    local mesh samples
    for mesh in "$out"/*.ply; do
        mesh=$(basename "$mesh" .ply)
        samples=$(cat "$out/$mesh.samples")
        timed "$mesh" "$bin/pointrt-bake" "$out/$mesh.ply" --sample "$samples" --force -o "$out/$mesh.pro"
    done
}

python() { "$out/environment/bin/python" "$@"; }
blenderRun() { blender -b --factory-startup --python-exit-code 1 -P "$here/render_reference.py" -- "$@"; }

# reference SCENE NAME SPP COMMAND...: renders a reference of SCENE, unless it exists or SPP is 0.
reference() {
    local scene=$1 name=$2 samples=$3
    [ "$samples" != 0 ] && [ ! -e "$out/$scene.$name.exr" ] || return 0
    # Renamed when complete, so that an interrupted run leaves no half picture to be kept.
    timed "$scene.$name" "${@:4}" "$out/$scene.json" "$out/partial.exr"
    mv "$out/partial.exr" "$out/$scene.$name.exr"
}

# References of an earlier version of the scene are deleted.
dropStale() {
    local scene=$1
    cmp -s "$out/$scene.json" "$out/$scene.rendered.json" || rm -f "$out/$scene".{hits,mitsuba,cycles,light,paths}.exr
    cp "$out/$scene.json" "$out/$scene.rendered.json"
}

renderReferences() {
    dropStale "$1"
    reference "$1" hits 1 python "$here/render_mitsuba.py" --first-hits
    reference "$1" mitsuba "$mitsuba_spp" python "$here/render_mitsuba.py" --spp "$mitsuba_spp"
    reference "$1" cycles "$cycles_spp" blenderRun --spp "$cycles_spp"
}

renderCausticReferences() {
    dropStale "$1"
    reference "$1" hits 1 python "$here/render_mitsuba.py" --first-hits
    reference "$1" light "$photons" python "$here/render_caustic.py" --photons "$photons"
    reference "$1" paths "$check_spp" python "$here/render_mitsuba.py" --spp "$check_spp"
}

compareWith() {
    local scene=$1 reference=$2 test=$3
    python "$here/compare.py" "$out/$scene.json" "$out/$scene.$reference.exr" "$out/$scene.$test.exr" \
        "$out/$scene.$test-$reference" --first-hits "$out/$scene.hits.exr"
}

installPackages
installPython
DRJIT_LIBLLVM_PATH=$(dpkg -L libllvm19 | grep -m 1 -E '/libLLVM\.so\.19\.[0-9.]+$')
export DRJIT_LIBLLVM_PATH PYTHONDONTWRITEBYTECODE=1
python "$here/check_compare.py" >&2
python "$here/make_scenes.py" "$out" --size "$size" --spacing "$spacing"
bakeAll
{
    echo "Ours: $spp samples a pixel; Mitsuba: $mitsuba_spp; Cycles: $cycles_spp. $size x $size pixels, splats every" \
        "$spacing pixels. Rows are TEST-REFERENCE; both encoded by sRGB after the scene's exposure, clipped." \
        "The difference of the two references is what noise and definitions alone amount to."
    echo
    python "$here/compare.py" --heading
} >"$out/RESULTS.md"
compareCaustic() {
    local scene=$1 integrator
    renderCausticReferences "$scene"
    for integrator in whitted path; do
        timed "$scene.$integrator" "$bin/pointrt-view" "$out/$scene.toml" --integrator "$integrator" --spp "$spp" \
            -o "$out/$scene.$integrator.exr" "${view_options[@]}"
        compareWith "$scene" light "$integrator"
    done
    [ "$check_spp" = 0 ] || compareWith "$scene" light paths
}

compareScene() {
    local scene=$1
    renderReferences "$scene"
    timed "$scene.ours" "$bin/pointrt-view" "$out/$scene.toml" --spp "$spp" -o "$out/$scene.ours.exr" \
        "${view_options[@]}"
    python "$here/compare_first_hits.py" "$out/$scene.json" "$out/$scene.hits.exr" "$out/$scene.ours.exr" \
        >"$out/$scene.first-hits.json" || say "$scene: other surfaces are seen: $scene.first-hits.json"
    compareWith "$scene" mitsuba ours
    [ "$cycles_spp" = 0 ] || {
        compareWith "$scene" cycles ours
        compareWith "$scene" mitsuba cycles
    }
}

for scene in "${scenes[@]}"; do
    case $scene in
        caustic-*) compareCaustic "$scene" ;;
        *) compareScene "$scene" ;;
    esac >>"$out/RESULTS.md"
done
cat "$out/RESULTS.md"
