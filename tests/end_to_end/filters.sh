#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Filters: what is shown of scans by an attribute, for rays and for pictures.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# Two levels of 80 x 80 points: class 2 at z = 0, class 5 at z = 3; and rays from z = 6 straight down.
bakeLevels() {
    awk 'BEGIN { print "x,y,z,classification"
        for (i = 0; i < 80; ++i) for (j = 0; j < 80; ++j) { print i/10 "," j/10 ",0,2"; print i/10 "," j/10 ",3,5" } }' >levels.csv
    awk 'BEGIN { print "ox,oy,oz,dx,dy,dz"; for (i = 0; i < 20; ++i) for (j = 0; j < 20; ++j)
        print 1 + 0.29 * i "," 1 + 0.29 * j ",6,0,0,-1" }' >rays.csv
    pointrt-bake -q levels.csv -o levels.pro
    pointrt-bake -q levels.csv -o levels.proset --tile-splats 3000
}

# distances SCENE OPTION...: the distances of all rays, each once.
distances() {
    pointrt-rays cast "$1" -q --rays rays.csv -o hits.csv "${@:2}" || return
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "t_hit") at = i; next }
        { print $at == "inf" ? "inf" : sprintf("%.2f", $at) }' hits.csv | sort -u | paste -sd ' '
}

case_rays_pass_what_is_hidden() {
    local scene
    bakeLevels
    for scene in levels.pro levels.proset; do
        [ "$(distances $scene)" = 3.00 ] || fail "$scene: the upper level is not hit"
        [ "$(distances $scene --only class=2)" = 6.00 ] || fail "$scene: rays stop before the lower level"
        [ "$(distances $scene --only class=2,5)" = 3.00 ] || fail "$scene: two values hide a level"
        [ "$(distances $scene --only height=-1:1)" = 6.00 ] || fail "$scene: heights hide nothing"
        [ "$(distances $scene --only class=9)" = inf ] || fail "$scene: hidden points are hit"
        [ "$(distances $scene --only class=2 --only height=2:4)" = inf ] || fail "$scene: one filter of two is enough"
    done
    printf '[[instance]]\nfile = "levels.pro"\n[[filter]]\nattribute = "class"\nvalues = [2]\n' >scene.toml
    [ "$(distances scene.toml)" = 6.00 ] || fail "the scene file's filter hides nothing"
    [ "$(distances scene.toml --only class=5)" = inf ] || fail "the option replaces the scene file's filter"
}

case_pictures_lack_what_is_hidden() {
    bakeLevels
    for scene in levels.pro levels.proset; do
        pointrt-view -q $scene --integrator normal --size 96x64 --up z -o whole.png
        pointrt-view -q $scene --integrator normal --size 96x64 --up z --only class=2,5 -o all.png
        cmp whole.png all.png || fail "$scene: a filter that hides nothing changes the picture"
        pointrt-view -q $scene --integrator normal --size 96x64 --up z --only class=2 -o lower.png
        ! cmp -s whole.png lower.png || fail "$scene: nothing is hidden"
        expectDone pointrt-view $scene --integrator normal --size 96x64 --up z --only class=9 -o none.png
        grep -q "the filters hide every point" stderr || fail "$scene: nothing is said"
    done
}

case_errors_say_what_there_is() {
    bakeLevels
    run pointrt-view levels.pro --only clas=2 -o out/a.png
    [ "$status" = 1 ] || fail "exit status $status"
    grep -q 'error: --only: levels.pro has no attribute "clas", did you mean "classification"?' stderr || fail "another error"
    run pointrt-view levels.pro --only class=2: -o out/a.png
    [ "$status" = 2 ] || fail "exit status $status"
    run pointrt-rays cast levels.proset --rays rays.csv --only clas=2 -o out/hits.csv
    [ "$status" = 1 ] || fail "exit status $status"
    [ -z "$(ls -A out)" ] || fail "something was written"
}

runCase "$@"
