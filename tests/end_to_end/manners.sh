#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What all three tools have in common: help, typing errors, standard output, and that inputs are never overwritten.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

tools="pointrt-bake pointrt-view pointrt-info"

bakeSphere() {
    sphere 3000 >scan.xyz
    pointrt-bake -q scan.xyz -o scan.pro
}

# scanPly: prints a sphere as PLY.
scanPly() {
    printf 'ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x\nproperty float y\nproperty float z\nend_header\n'
    sphere 3000
}

# expectUsage PATTERN COMMAND...: must fail with a usage error, in the format of all tools.
expectUsage() {
    local pattern=$1
    shift
    expectError 2 "$pattern \(see --help\)\$" "$@"
}

# onTerminal COMMAND...: runs it on a terminal, whose output goes to the file screen.
onTerminal() {
    command -v script >/dev/null || skip "no script(1), which gives a program a terminal"
    script -qec "$*" /dev/null >screen </dev/null
}

case_unknown_options_name_the_near_one() {
    bakeSphere
    expectUsage "--otuput, .*--output\?" pointrt-bake scan.xyz --otuput out/a.pro
    expectUsage "--otuput, .*--output\?" pointrt-bake scan.xyz --otuput=out/a.pro
    expectUsage "--theads, .*--threads\?" pointrt-bake scan.xyz -o out/a.pro --theads 2
    expectUsage "--otuput, .*--output\?" pointrt-view scan.pro --otuput out/a.png
    expectUsage "--siez, .*--size\?" pointrt-view scan.pro -o out/a.png --siez 8x8
    expectUsage "--integ, .*--integrator\?" pointrt-view scan.pro -o out/a.png --integ path
    expectUsage "--jsn, .*--json\?" pointrt-info scan.pro --jsn
    expectUsage "--exprot, .*--export\?" pointrt-info --exprot out/a.ply
    expectUsage "-output, .*--output\?" pointrt-bake scan.xyz -output out/a.pro
    expectUsage "-size, .*--size\?" pointrt-view scan.pro -size 8x8 -o out/a.png
    expectUsage "unknown option --frobnicate" pointrt-info scan.pro --frobnicate
    expectUsage "unknown option -x" pointrt-view scan.pro -x
}

case_slips() {
    local tool
    bakeSphere
    expectUsage "no output .*-o out/a.pro\?" pointrt-bake scan.xyz out/a.pro
    expectUsage "no output .*FILE.pro" pointrt-bake scan.xyz
    expectUsage "argument out/a.png, .*-o out/a.png\?" pointrt-view scan.pro out/a.png
    expectUsage "argument out/a.ply, .*--export out/a.ply\?" pointrt-info scan.pro out/a.ply
    expectUsage "argument more.pro" pointrt-info scan.pro more.pro
    expectUsage "-o: empty .*" pointrt-bake scan.xyz -o ""
    expectUsage "-o=out/a.pro: .*-o VALUE.*" pointrt-bake scan.xyz -o=out/a.pro
    expectUsage "out/.pro: .*\.proset" pointrt-bake scan.xyz -o out/.pro
    expectUsage "--seed: -1 is negative" pointrt-bake scan.xyz -o out/a.pro --seed -1
    expectUsage "argument more.pro" pointrt-info scan.pro -- more.pro
    expectError 1 "help: No such file" env -u DISPLAY -u WAYLAND_DISPLAY pointrt-view help
    expectUsage "--output: FILE missing" pointrt-bake scan.xyz --output
    for tool in $tools; do
        expectUsage "empty .*" "$tool" ""
        expectUsage "(is required|no SCENE given)" "$tool"
    done
    expectUsage "-q and -v .*" pointrt-bake scan.xyz -o out/a.pro -q -v
    expectUsage "out/a.xyz: --export .*\.spz" pointrt-info scan.pro --export out/a.xyz
}

case_the_last_of_a_repeated_option_counts() {
    bakeSphere
    expectDone pointrt-bake -q scan.xyz -o out/a.pro --seed 1 -j 1 -j 2 -o out/b.pro --seed 0
    cmp out/b.pro scan.pro
    [ ! -e out/a.pro ] || fail "both outputs were written"
    expectDone pointrt-info scan.pro --export out/a.ply --export out/b.ply
    [ ! -e out/a.ply ] || fail "both outputs were written"
}

case_version_and_short_options() {
    local tool
    for tool in $tools; do
        expectDone "$tool" --version
        grep -Eqx "$tool [0-9]+\.[0-9]+\.[0-9]+" stdout || fail "$tool does not name itself and its version"
        expectDone "$tool" --help
        mv stdout long
        expectDone "$tool" -h
        cmp long stdout
        [ ! -s stderr ] || fail "help on standard error"
        grep -q -e "  -q,--quiet  " stdout || fail "$tool has no -q"
    done
}

case_quiet() {
    bakeSphere
    expectDone pointrt-bake -q scan.xyz -o out/a.pro
    [ ! -s stdout ] && [ ! -s stderr ] || fail "pointrt-bake -q says something"
    expectDone pointrt-view -q scan.pro --size 8x8 --spp 1 -o out/a.png
    [ ! -s stdout ] && [ ! -s stderr ] || fail "pointrt-view -q says something"
    expectDone pointrt-info -q scan.pro --verify
    [ ! -s stdout ] && [ ! -s stderr ] || fail "pointrt-info -q says something of a good file"
    expectDone pointrt-info -q scan.pro --export out/a.ply
    [ ! -s stdout ] && [ ! -s stderr ] || fail "pointrt-info -q says something"
    expectDone pointrt-info -q scan.pro
    [ -s stdout ] || fail "-q suppresses the requested output"
}

# All examples of --help work (except the one that opens a window). cat replaces other programs.
case_examples_of_help() {
    local tool example count
    useCache bakes
    bakeSphere
    rm scan.pro
    scanPly >scan.ply
    cp scan.ply a.ply
    { printf '# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3000\nHEIGHT 1\n' &&
        printf 'VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3000\nDATA ascii\n' && sphere 3000 | awk '{ print $1 + 3, $2, $3 }'; } >b.pcd
    printf 'v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n' >mesh.obj
    mkdir tiles
    { printf 'ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x\nproperty float y\nproperty float z\n' &&
        printf 'property uchar classification\nend_header\n' && sphere 3000 | awk '{ print $0, NR % 3 }'; } >tiles/a.ply
    gzip -k scan.xyz
    printf '[[instance]]\nfile = "scan.pro"\n[[view]]\nname = "top"\neye = [0, 5, 0]\nup = [0, 0, -1]\n' >scene.toml
    for tool in $tools; do
        expectDone "$tool" --help
        sed -n '/^Examples:$/,/^$/s/^  //p' stdout | sed 's/   .*//;/^$/d' >"$tool.examples"
        count=$(wc -l <"$tool.examples")
        [ "$count" -ge 2 ] && [ "$count" -le 5 ] || fail "$tool has $count examples"
        while read -r example; do
            [ "$example" != "pointrt-view scan.ply" ] || continue
            [[ "$example" != *"| convert"* ]] || example="${example%%|*}| cat >top.jpg"
            [[ "$example" != *"| jq"* ]] || example="${example%%|*}| cat"
            example=${example/--time-limit 60/--time-limit 1 --size 64x36}
            run bash -o pipefail -c "${example/1000000/10000}"
            [ "$status" != 3 ] || grep -q "this build has no LAZ" stderr || fail "$example: exit status 3"
            [ "$status" = 0 ] || [ "$status" = 3 ] || fail "$example: exit status $status"
        done <"$tool.examples"
    done
    for example in scan.png all.png all.pro city.pro mesh.pro top.jpg splats.ply; do
        [ -s "$example" ] || fail "no example wrote $example"
    done
}

case_help_says_what_is_overwritten() {
    local tool
    for tool in $tools; do
        expectDone "$tool" --help
        tr -s ' \n' ' ' <stdout >"$tool.help"
    done
    grep -q "existing output is kept unless -f is given" pointrt-bake.help || fail "pointrt-bake does not say it"
    grep -q "overwriting an existing file" pointrt-view.help || fail "pointrt-view does not say it"
    grep -q "Let --export overwrite an existing file" pointrt-info.help || fail "pointrt-info does not say it"
}

case_a_scan_is_no_scene() {
    scanPly >scan.ply
    sphere 3000 >scan.xyz
    expectError 1 "scan.ply: .*PLY; .*: pointrt-bake scan.ply -o scan.pro\$" pointrt-info scan.ply
    expectError 1 "out: .*folder" pointrt-info out
    printf '[[instance]]\nfile = "scan.ply"\n' >scene.toml
    expectError 1 "scan.ply: .*PLY" pointrt-view scene.toml -o out/a.png
    expectError 1 "scene.toml: .*scene file.*pointrt-view" pointrt-info scene.toml
    expectUsage "-: .*memory-mapped.*" pointrt-info -
}

case_a_window_bakes_the_scan_that_it_is_given() {
    useCache bakes
    sphere 3000 >scan.xyz
    printf 'pointrt-recording 1 window 64x64 scale 1\n0 wait 1\n1 screenshot shown\n2 quit\n' >user.txt
    expectDone pointrt-view scan.xyz --replay user.txt --offscreen
    [ "$(find "$kept" -name '*.pro' | wc -l)" = 1 ] || fail "not one bake in the cache"
    [ -s shown.png ] || fail "no screenshot"
    echo nonsense >letter.xyz
    expectError 1 "letter.xyz(:[0-9]+)?: " pointrt-view letter.xyz --replay user.txt --offscreen
    expectError 1 "missing.ply: No such file" pointrt-view missing.ply --replay user.txt --offscreen
}

# The picture of a scan is that of its bake, with its options; it is baked once.
case_pictures_of_scans() {
    local bake
    useCache bakes
    sphere 3000 | awk '{ print $1, $2, $3, 200, 100, 50 }' >scan.xyz
    expectDone pointrt-view scan.xyz -o out/a.png --integrator normal --size 64x48 --bake --clean off --radius-scale 2
    bake=$(find "$kept" -type f)
    expectDone pointrt-bake -q scan.xyz -o scan.pro --clean off --radius-scale 2
    cmp "$bake" scan.pro || fail "another bake, or not one in the cache: $bake"
    expectDone pointrt-view scan.pro -o out/b.png --integrator normal --size 64x48
    cmp out/a.png out/b.png || fail "another picture"
    mkdir scans
    mv scan.xyz scans
    expectDone pointrt-view scans/scan.xyz -o out/c.png --integrator normal --size 64x48 --bake --clean off --radius-scale 2
    [ "$(find "$kept" -type f)" = "$bake" ] || fail "it was baked again"
    cp scan.pro "$bake.tmp-left" && : >"$kept/left.lock" && truncate -s 100 "$bake"
    expectDone pointrt-view scans -o out/d.png --integrator normal --size 64x48
    expectDone pointrt-view scans/scan.xyz -o out/c.png --integrator normal --size 64x48 --bake --clean off --radius-scale 2
    cmp "$bake" scan.pro || fail "a damaged bake was used"
    sphere 50 >scans/more.xyz
    expectDone pointrt-view scans/more.xyz scans/scan.xyz -o out/e.png --integrator normal --size 64x48
    # the reasons are those that pointrt-bake gives
    echo nonsense >letter.xyz
    expectError 1 "letter.xyz(:[0-9]+)?: " pointrt-view letter.xyz -o out/f.png
    expectError 1 "missing.ply: No such file" pointrt-view missing.ply -o out/f.png
    expectError 2 "--cleen" pointrt-view scans/scan.xyz -o out/f.png --bake --cleen off
    expectUsage "--bake: -o .*" pointrt-view scans/scan.xyz -o out/f.png --bake -o b.pro
    expectUsage "--bake: .*scan.pro .*" pointrt-view scan.pro -o out/f.png --bake --clean off
    expectUsage "scan.pro: .*scene file.*" pointrt-view scan.pro scans/scan.xyz -o out/f.png
    expectUsage "scan.xyz: --stats .*input.*" pointrt-view scans/more.xyz scans/scan.xyz -o out/f.png --stats scans/scan.xyz
    POINTRT_BAKE_CACHE=off expectError 4 "scan.xyz: .*cache" pointrt-view scans/scan.xyz -o out/f.png
}

# Killed at any moment, a viewer leaves nothing that a later one would show.
case_killed_while_it_bakes() {
    local delay id
    useCache bakes
    sphere 20000 >scan.xyz
    for delay in 0.05 0.2 0.4; do
        pointrt-view -q scan.xyz -o out/a.png --size 64x48 &
        id=$!
        sleep "$delay"
        kill -KILL "$id" 2>/dev/null || true
        wait "$id" 2>/dev/null || true
    done
    expectDone pointrt-view scan.xyz -o out/a.png --size 64x48
    pointrt-bake -q scan.xyz -o scan.pro
    cmp "$(find "$kept" -name '*.pro')" scan.pro || fail "not one good bake"
}

case_nothing_lands_on_an_input() {
    bakeSphere
    cp scan.pro before.pro
    ln -s scan.pro link.pro
    printf '[[instance]]\nfile = "scan.pro"\n' >scene.toml
    cp scene.toml before.toml
    expectUsage "scan.pro: --stats .*input of the scene" \
        pointrt-view scan.pro -o out/a.png --stats scan.pro
    expectUsage "link.pro: --stats .*input of the scene" \
        pointrt-view scan.pro -o out/a.png --stats link.pro
    expectUsage "scan.pro: --stats .*input.*" pointrt-view scene.toml -o out/a.png --stats scan.pro
    expectUsage "scene.toml: --stats .*input.*" pointrt-view scene.toml --bench 1 --stats scene.toml
    expectUsage "out/a.png: -o and --stats .*" pointrt-view scan.pro -o out/a.png --stats out/a.png
    expectUsage "scan.pro: --record .*input.*" pointrt-view scan.pro --record scan.pro
    expectUsage "scan.pro: .*input" pointrt-info scan.pro --export scan.pro -f
    expectUsage "scan.xyz: --stats .*input" pointrt-bake scan.xyz -o out/a.pro --stats scan.xyz
    expectUsage "out/a.pro: --stats and --output .*" pointrt-bake scan.xyz -o out/a.pro --stats out/a.pro
    cmp scan.pro before.pro
    cmp scene.toml before.toml
}

# Outputs that cannot be written are reported before any work: otherwise the missing input would be reported, with exit
# status 1.
case_places_that_cannot_be_written() {
    bakeSphere
    expectError 4 "/proc/x.pro: .* /proc\$" pointrt-bake missing.ply -o /proc/x.pro
    expectError 4 "/proc/x.png: .* /proc\$" pointrt-view scan.pro -o /proc/x.png
    expectError 4 "/proc/x.ply: .* /proc\$" pointrt-info scan.pro --export /proc/x.ply
    expectError 4 "/proc/x.json: .* /proc\$" pointrt-bake missing.ply -o out/a.pro --stats /proc/x.json
    expectError 4 "/sys/x.pro: .*" pointrt-bake missing.ply -o /sys/x.pro
    expectError 4 "out: .*folder" pointrt-bake missing.ply -o out/a.pro --stats out
    expectError 4 "out/none/x.json: .*folder" \
        pointrt-bake missing.ply -o out/a.pro --stats out/none/x.json
}

case_standard_output() {
    bakeSphere
    expectDone pointrt-view scan.pro -q --size 32x24 --spp 1 -o out/a.png
    expectDone pointrt-view scan.pro -v --size 32x24 --spp 1 -o -
    cmp stdout out/a.png || fail "not the picture"
    [ -s stderr ] || fail "reports go to standard error"
    expectDone pointrt-view scan.pro -q --exposure 0 --size 32x24 --spp 1 -o -
    cmp stdout out/a.png || fail "not the picture"
    expectDone pointrt-info scan.pro --export out/a.ply
    expectDone pointrt-info scan.pro --export -
    cmp stdout out/a.ply || fail "not the splats"
    [ ! -e - ] || fail "a file called -"
    expectUsage "-o -: .*memory-mapped.*FILE.pro" pointrt-bake scan.xyz -o -
    expectUsage "-o - and --stats - .*" pointrt-view scan.pro -o - --stats -
    expectUsage "-o - and --bench .*" pointrt-view scan.pro -o - --bench 1
    expectUsage "-: --turntable .*%0Nd.*" pointrt-view scan.pro -o - --turntable 3
    expectUsage "--resume: .*FILE.exr" pointrt-view scan.pro -o - --resume
    if onTerminal "pointrt-view scan.pro -o -"; then fail "a picture on a terminal"; fi
    grep -q "standard output .*terminal; .*picture .*(see --help)" screen || fail "it does not say why"
    if onTerminal "pointrt-info scan.pro --export -"; then fail "splats on a terminal"; fi
    grep -q "standard output .*terminal; .*splats .*(see --help)" screen || fail "it does not say why"
}

# On a terminal one line is redrawn, with a percentage that increases once over all stages, and cleared at the end.
case_progress_of_a_bake_on_a_terminal() {
    sphere 300000 >scan.xyz
    local began_ms took_ms
    began_ms=$(date +%s%3N)
    onTerminal "pointrt-bake scan.xyz -o out/a.pro -j 1"
    took_ms=$(($(date +%s%3N) - began_ms))
    tr '\r' '\n' <screen | sed 's/\x1b\[K//' | grep '^baking' >drawn || fail "nothing was drawn"
    grep -Evx 'baking +[0-9]+%(, [0-9]+ (s|min [0-9]+ s) left)?: [a-z]+ [0-9]+%(, [0-9]+ points/s)?' drawn && fail "not as it should be"
    sed 's/^baking *\([0-9]*\)%.*/\1/' drawn | sort -nc || fail "the share goes back"
    [ "$(sed 's/^baking *\([0-9]*\)%.*/\1/' drawn | tail -n 1)" -ge 80 ] || fail "the share does not run over all stages"
    [ "$(sed 's/.*: \([a-z]*\) .*/\1/' drawn | uniq | wc -l)" -ge 3 ] || fail "not the stages"
    # no estimate during the first two seconds, by which time a fast machine may have finished
    [ "$took_ms" -lt 4000 ] || grep -q ' left' drawn || fail "no time left after $took_ms ms"
    ! head -n 1 drawn | grep ' left' >/dev/null || fail "a time left is shown at the beginning"
    tail -n 3 screen | grep $'\r\033\\[Kpointrt-bake: every point' >/dev/null || fail "the line is not wiped for the summary"
    tail -n 2 screen | grep '^out/a.pro: 300000 splats' >/dev/null || fail "no summary"
}

runCase "$@"
