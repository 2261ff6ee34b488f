#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Scene files on the command line of pointrt-view. Their keys and their pictures are tested elsewhere.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# writeScene: writes sphere.pro and scene.toml, a glass sphere next to a mirror sphere over a floor.
writeScene() {
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o sphere.pro
    cat >scene.toml <<'EOF'
[camera]
eye = [0, 2, 6]
target = [0, 0.5, 0]
[render]
integrator = "whitted"
bounces = 6
spp = 3
size = [40, 30]
[material.glass]
kind = "glass"
[material.mirror]
kind = "mirror"
[[instance]]
file = "sphere.pro"
material = "glass"
[[instance]]
file = "sphere.pro"
translate = [-2, 0, -1]
scale = 0.5
[[shape]]
type = "sphere"
center = [2, 0, -1]
radius = 1
material = "mirror"
[[shape]]
type = "plane"
point = [0, -1, 0]
normal = [0, 1, 0]
[[light]]
type = "sphere"
center = [3, 5, 2]
radius = 0.5
power = 500
EOF
}

# pixelsOf FILE: "width height" of a PNG file.
pixelsOf() { od -An -t u1 -j 16 -N 8 "$1" | awk '{ print $3 * 256 + $4, $7 * 256 + $8 }'; }

case_settings_of_the_file() {
    writeScene
    expectDone pointrt-view scene.toml -q -o out/a.png --stats stats.json
    [ "$(pixelsOf out/a.png)" = "40 30" ] || fail "not the size of the file"
    [ "$(jsonValue stats.json integrator)" = whitted ] || fail "not the integrator of the file"
    [ "$(jsonValue stats.json spp)" = 3 ] || fail "not the samples of the file"
    [ "$(jsonValue stats.json rays.secondary)" -gt 0 ] || fail "glass and mirror without secondary rays"
}

case_the_command_line_wins() {
    writeScene
    expectDone pointrt-view scene.toml -q --size 24x16 --spp 2 --integrator path --bounces 0 -o out/a.png --stats s.json
    [ "$(pixelsOf out/a.png)" = "24 16" ] || fail "not the requested size"
    [ "$(jsonValue s.json integrator)" = path ] || fail "not the requested integrator"
    [ "$(jsonValue s.json spp)" = 2 ] || fail "not the requested samples"
    [ "$(jsonValue s.json rays.secondary)" = 0 ] || fail "not the requested bounces"
    local normals=(pointrt-view scene.toml -q --integrator normal) # light takes a second a picture
    expectDone "${normals[@]}" -o out/file.png
    expectDone "${normals[@]}" --eye 0,2,6 --fov 40 -o out/same.png
    expectDone "${normals[@]}" --eye 0,2,7 -o out/other.png
    cmp out/file.png out/same.png
    ! cmp -s out/file.png out/other.png || fail "--eye changes nothing"
}

case_works_from_any_folder() {
    writeScene
    mkdir elsewhere
    (cd elsewhere && pointrt-view ../scene.toml -q --integrator normal -o ../out/a.png)
    [ -s out/a.png ] || fail "no picture"
}

case_errors_name_file_line_and_key() {
    writeScene
    sed 's/spp = 3/spp = 0/' scene.toml >bad.toml
    expectError 1 'bad.toml:7: key "render.spp": ' pointrt-view bad.toml -q -o out/a.png
    sed 's/file = "sphere.pro"/file = "missing.pro"/' scene.toml >bad.toml
    expectError 1 'bad.toml:14: key "instance\[0\].file": .*missing.pro' pointrt-view bad.toml -q -o out/a.png
    echo 'not toml' >bad.toml
    expectError 1 'bad.toml:1: ' pointrt-view bad.toml -q -o out/a.png
    expectError 1 'none.toml: ' pointrt-view none.toml -q -o out/a.png
    : >empty.pro
    sed 's/file = "sphere.pro"/file = "empty.pro"/' scene.toml >bad.toml
    expectError 1 'empty.pro: ' pointrt-view bad.toml -q -o out/a.png
    { cat scene.toml && printf '[[instance.override]]\nrow = 9\nmaterial = "glass"\n'; } >bad.toml
    expectError 1 'bad.toml:[0-9]*: key "instance\[1\].override\[0\].row": sphere.pro .*row 9' \
        pointrt-view bad.toml -q -o out/a.png
}

case_a_pipe_as_sky_picture_is_not_waited_for() {
    writeScene
    mkfifo pipe.hdr
    { cat scene.toml && printf '[sky]\nimage = "pipe.hdr"\n'; } >pipe.toml
    expectError 1 'pipe.hdr: .*regular' timeout 20 pointrt-view pipe.toml -q -o out/a.png
}

runCase "$@"
