#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The inputs of pointrt-bake, and the one-line errors for inputs that it cannot read.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# rejects FILE [PATTERN]: the bake must refuse FILE with exit status 1 and one line that names it.
rejects() {
    expectError 1 "$1(:[^ ]+)?: .*${2:-}" pointrt-bake -q "$1" -o out/scene.pro
}

# plyHeader FORMAT VERTICES
plyHeader() {
    printf 'ply\nformat %s 1.0\nelement vertex %s\n' "$1" "$2"
    printf 'property float x\nproperty float y\nproperty float z\nend_header\n'
}

case_empty_file() {
    : >empty.ply
    rejects empty.ply
    : >empty.xyz
    rejects empty.xyz
}

case_text_that_is_no_cloud() {
    printf 'Dear reader,\nthis is a letter and not a scan.\n' >letter.txt
    rejects letter.txt
    cp letter.txt letter.ply
    rejects letter.ply
}

case_unknown_binary() {
    head -c 4096 "$POINTRT_BIN/pointrt-info" >program.bin
    rejects program.bin
}

case_ply_cut_in_the_middle() {
    { plyHeader binary_little_endian 1000 && head -c 6000 /dev/zero; } >binary.ply
    rejects binary.ply
    { plyHeader ascii 1000 && sphere 500; } >ascii.ply
    rejects ascii.ply
    plyHeader ascii 1000 | head -c 60 >header.ply
    rejects header.ply
}

case_ply_that_promises_4_billion_vertices() {
    { plyHeader binary_little_endian 4294967295 && head -c 1200 /dev/zero; } >binary.ply
    rejects binary.ply
    { plyHeader ascii 4294967295 && sphere 100; } >ascii.ply
    rejects ascii.ply
}

case_points_all_equal() {
    seq 1000 | awk '{ print 1, 2, 3 }' >equal.xyz
    rejects equal.xyz
}

case_points_all_collinear() {
    seq 1000 | awk '{ print $1 / 10, $1 / 5, -$1 }' >line.xyz
    rejects line.xyz
}

case_one_point() {
    echo '1 2 3' >one.xyz
    rejects one.xyz
}

case_only_non_finite_points() {
    printf 'nan 0 0\n0 inf 0\n0 0 -inf\nnan nan nan\n' >nan.xyz
    rejects nan.xyz
}

case_nan_and_infinity_among_good_points() {
    { sphere 2000 && printf 'nan 0 0\n0 inf 0\n0 0 -inf\nNaN NaN NaN\n' && sphere 500; } >mixed.xyz
    expectDone pointrt-bake -q mixed.xyz -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json splats)" -ge 2000 ] || fail "good points were lost"
    [ "$(jsonValue stats.json splats)" -le 2500 ] || fail "bad points became splats"
    expectDone pointrt-info out/scene.pro --verify
}

case_folder() {
    mkdir folder
    rejects folder
}

case_no_such_file() {
    rejects missing.ply
}

# Root may read all files, so the test first drops that capability.
case_no_permission() {
    local as_user=()
    sphere 100 >secret.xyz
    chmod 000 secret.xyz
    if cat secret.xyz >/dev/null 2>&1; then
        as_user=(setpriv "--bounding-set=-dac_override,-dac_read_search")
        ! "${as_user[@]}" cat secret.xyz >/dev/null 2>&1 || skip "this user reads every file and can't stop it"
    fi
    expectError 1 "secret.xyz: .*[Pp]ermission" "${as_user[@]}" pointrt-bake -q secret.xyz -o out/scene.pro
}

case_one_bad_file_among_good_ones() {
    sphere 1000 >good.xyz
    : >empty.ply
    expectError 1 "empty.ply(:[^ ]+)?: " pointrt-bake -q good.xyz empty.ply -o out/scene.pro
}

# Some programs mark missing data by coordinates such as 1e30: among other points, as the first point, and alone.
case_coordinates_out_of_all_proportion() {
    for value in 1e20 1e25 1e30 1.70141e38 1e60; do
        { sphere 1000 && echo "$value $value $value" && sphere 2000; } >stray.xyz
        expectDone pointrt-bake -f stray.xyz -o out/scene.pro --stats stats.json
        [ "$(jsonValue stats.json splats)" -le 3000 ] || fail "$value became a splat"
        grep -Eq 'left out .*1 (outliers|not finite)' stderr || fail "$value was not counted"
    done
    { echo '1e30 1e30 1e30' && sphere 1000; } >first.xyz
    expectDone pointrt-bake -f first.xyz -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json splats)" = 1000 ] || fail "1000 points are there"
    rm out/scene.pro
    echo '1e30 1e30 1e30' >one.xyz
    rejects one.xyz 'none of its 1 .*1e\+25'
    sphere 1000 | awk '{ print $1 * 1e30, $2 * 1e30, $3 * 1e30 }' >all.xyz
    rejects all.xyz
}

case_several_files_are_merged() {
    sphere 1000 >near.xyz
    sphere 500 | awk '{ print $1 + 4, $2, $3 }' >far.xyz
    expectDone pointrt-bake -q near.xyz far.xyz -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json input_points)" = 1500 ] || fail "1500 points went in"
}

case_standard_input() {
    sphere 1000 >sphere.xyz
    pointrt-bake -q - --input-format xyz -o out/scene.pro --stats stats.json <sphere.xyz
    [ "$(jsonValue stats.json input_points)" = 1000 ] || fail "1000 points went in"
    expectDone pointrt-info out/scene.pro --verify
}

# Formats are detected by content, on standard input too. --input-format overrides that.
case_standard_input_is_detected_by_content() {
    sphere 1000 >sphere.xyz
    { plyHeader ascii 1000 && sphere 1000; } >sphere.ply
    gzip -k sphere.ply
    for file in sphere.xyz sphere.ply sphere.ply.gz; do
        cat "$file" | pointrt-bake -q - -f -o out/scene.pro --stats stats.json
        [ "$(jsonValue stats.json input_points)" = 1000 ] || fail "1000 points went in: $file"
    done
    status=0
    pointrt-bake -q - --input-format obj -o out/other.pro <sphere.xyz 2>stderr || status=$?
    [ "$status" = 1 ] || fail "exit status $status where 1 was expected"
    grep -q 'standard input: .*no points' stderr || fail "--input-format was not taken"
}

case_named_pipe() {
    sphere 1000 >sphere.xyz
    expectDone pointrt-bake -q <(cat sphere.xyz) -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json input_points)" = 1000 ] || fail "1000 points went in"
}

case_devices_are_not_read() {
    expectError 1 '/dev/zero: .*regular' pointrt-bake -q /dev/zero -o out/scene.pro
    expectError 1 'standard input: .*regular' bash -c 'pointrt-bake -q - -o out/scene.pro </dev/zero'
}

case_conf_stays_in_its_folder() {
    echo 'correct horse battery staple' >secret
    mkdir set
    echo "bmesh ../secret 0 0 0 0 0 0 1" >set/set.conf
    expectError 1 "set.conf:1: '../secret': .*outside" pointrt-bake -q set/set.conf -o out/scene.pro
    ! grep -q horse stderr || fail "what a file holds is in the message"
    mkfifo set/pipe
    echo "bmesh pipe 0 0 0 0 0 0 1" >set/set.conf
    expectError 1 'pipe: .*regular' timeout 10 pointrt-bake -q set/set.conf -o out/scene.pro
}

case_content_overrides_the_suffix() {
    { plyHeader ascii 1000 && sphere 1000; } >cloud.xyz
    expectDone pointrt-bake -q cloud.xyz -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json input_points)" = 1000 ] || fail "1000 points went in"
}

case_mesh_sampled_over_its_area() {
    printf 'v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n' >sheet.obj
    expectDone pointrt-bake -q sheet.obj --sample 5000 -o out/scene.pro --stats stats.json
    [ "$(jsonValue stats.json splats)" -gt 4900 ] || fail "5000 points were requested"
    [ "$(jsonValue stats.json splats)" -le 5000 ] || fail "5000 points were requested"
}

cube() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nv 0.5 0.5 0.5\n'
    printf 'f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n'
}

case_coarse_mesh_is_sampled() {
    cube >cube.obj
    expectDone pointrt-bake cube.obj -o out/scene.pro --stats stats.json
    [ "$(grep -c '^pointrt-bake: cube.obj: .*8 vertices .*--sample 0' stderr)" = 1 ] ||
        fail "nothing was said"
    grep -q 'left out 1 .*face' stderr || fail "the vertex that no face uses was not counted"
    [ "$(jsonValue stats.json points_unused)" = 1 ] || fail "points_unused is not 1"
    [ "$(jsonValue stats.json points_sampled)" = 793800 ] || fail "630 to the diagonal were due"
    [ "$(jsonValue stats.json splats)" -gt 790000 ] || fail "793800 points were spread"
    grep -q '"cube.obj: .*8 vertices' stats.json || fail "the note is not among the figures"
    expectDone pointrt-bake -q cube.obj --prune off --compact -f -o out/scene.pro
    [ ! -s stderr ] || fail "-q is not quiet"
    expectDone pointrt-bake cube.obj --sample 2000 -f -o out/scene.pro --stats stats.json
    ! grep -q 'vertices' stderr || fail "there is nothing to say of 2000 samples"
    [ "$(jsonValue stats.json points_unused)" = 1 ] || fail "points_unused is not 1"
    expectDone pointrt-bake cube.obj --sample 0 -f -o out/scene.pro --stats stats.json
    ! grep -q 'vertices' stderr || fail "no note is needed about vertices that were requested"
    [ "$(jsonValue stats.json splats)" = 8 ] || fail "8 vertices are used"
    [ "$(jsonValue stats.json points_sampled)" = 0 ] || fail "nothing was to be sampled"
    expectError 2 '--sample' pointrt-bake -q cube.obj --sample -1 -f -o out/scene.pro
}

case_intensity_after_colors() {
    sphere 1000 | awk '{ print $0, 200, 100 + NR % 7, 50, 1000 + NR % 900 }' >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/scene.pro
    expectDone pointrt-info out/scene.pro --export splats.ply
    # behind them two bytes of intensity
    tail -c 5 splats.ply | head -c 3 | od -An -t u1 | grep -E '^ +200 +10[0-6] +50$' >/dev/null || fail "not the colours of the file"
    grep -aq '^property ushort intensity$' splats.ply || fail "the intensity is lost"
}

case_conf_with_a_missing_scan() {
    printf 'camera 0 0 0 0 0 0 1\nbmesh missing.ply 0 0 0 0 0 0 1\n' >set.conf
    expectError 1 "missing.ply(:[^ ]+)?: " pointrt-bake -q set.conf -o out/scene.pro
}

runCase "$@"
