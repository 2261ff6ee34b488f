#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The command line of pointrt-view. What its pictures show is tested elsewhere.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

bakeSphere() {
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o scene.pro --stats stats.json
}

# bigEndian FILE OFFSET: prints the 4-byte big-endian number there, as in PNG files.
bigEndian() {
    od -An -t u1 -j "$2" -N 4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}

case_help_names_every_option() {
    local option
    expectDone pointrt-view --help
    for option in -o --output --size --spp --seed --turntable --thumbnail --view --eye --target --up --fov --ortho --integrator --bounces --room --lights --background \
        --color-by --color-map --color-range --legend --shadows --caustics --denoise --exposure --time-limit --noise --resume --device --bench --stats --profile -q -v; do
        grep -Eq -e "(^|[ ,])$option([ ,=]|\$)" stdout || fail "--help does not name $option"
    done
}

case_wrong_usage() {
    bakeSphere
    expectError 2 "" pointrt-view
    expectError 2 "frobnicate" pointrt-view scene.pro -o out/a.png --frobnicate
    expectError 2 "" pointrt-view scene.pro -o out/a.png --size 64
    expectError 2 "" pointrt-view scene.pro -o out/a.png --size 0x64
    expectError 2 "" pointrt-view scene.pro -o out/a.png --size 64x-1
    expectError 2 "" pointrt-view scene.pro -o out/a.png --size 99999999x99999999
    expectError 2 "" pointrt-view scene.pro -o out/a.png --spp 0
    expectError 2 "" pointrt-view scene.pro -o out/a.png --fov 180
    expectError 2 "--ortho: " pointrt-view scene.pro -o out/a.png --ortho 0
    expectError 2 "--ortho: .*10000" pointrt-view scene.pro -o out/a.png --ortho 1e9
    expectError 2 "--fov and --ortho " pointrt-view scene.pro -o out/a.png --ortho 2 --fov 40
    expectError 2 "" pointrt-view scene.pro -o out/a.png --eye 1,2
    expectError 2 "--up: .*upwards.*auto, x, y, z" pointrt-view scene.pro -o out/a.png --up upwards
    expectError 2 "" pointrt-view scene.pro -o out/a.png --room cellar
    expectError 2 "--background: .*grey" pointrt-view scene.pro -o out/a.png --background grey
    expectError 2 "--time-limit" pointrt-view scene.pro -o out/a.png --time-limit 0
    expectError 2 "--noise" pointrt-view scene.pro -o out/a.png --noise -0.1
    expectError 2 "--denoise" pointrt-view scene.pro -o out/a.png --denoise perhaps
    expectError 2 "--resume" pointrt-view scene.pro -o out/a.png --resume
    expectError 2 "--exposure" pointrt-view scene.pro -o out/a.exr --exposure 1
}

# bakeHill: bakes hill.pro, a hill of class 2 under a roof of class 6, with z up. Intensity grows with the distance from
# the middle.
bakeHill() {
    awk 'BEGIN {
        n = 80
        printf "ply\nformat ascii 1.0\nelement vertex %d\n", n * n
        print "property float x\nproperty float y\nproperty float z\nproperty uchar classification"
        print "property ushort intensity\nend_header"
        for (i = 0; i < n; i++) for (k = 0; k < n; k++) {
            x = 2 * i / (n - 1) - 1; y = 2 * k / (n - 1) - 1
            house = x > -0.4 && x < 0.4 && y > -0.4 && y < 0.4
            printf "%.5f %.5f %.5f %d %d\n", x, y, 0.3 * (1 - x * x) + 0.2 * house, house ? 6 : 2, 1000 * sqrt(x * x + y * y)
        }
    }' >hill.ply
    pointrt-bake -q hill.ply -o hill.pro --up z --outliers keep --orient none
}

case_colours_and_legends() {
    bakeHill
    local by
    for by in rgb height normal intensity class; do
        expectDone pointrt-view -q hill.pro -o "out/$by.png" --size 96x64 --color-by "$by"
        [ "$by" = rgb ] || ! cmp -s out/rgb.png "out/$by.png" || fail "$by: as without it"
    done
    expectDone pointrt-view hill.pro -o out/plain.png --size 96x64
    cmp out/height.png out/plain.png || fail "a colourless hill is not coloured by height"
    grep -q 'coloured by height .*--color-by rgb' stderr || fail "the viewer does not say so"
    awk '{ print $1, $2, $3, 90, 160, 70 }' <(sed '1,/end_header/d' hill.ply) >grass.xyz
    pointrt-bake -q grass.xyz -o grass.pro --up z --outliers keep --orient none
    expectDone pointrt-view grass.pro -o out/grass.png --size 96x64
    ! grep -q 'coloured by' stderr || fail "it has colours of its own"
    expectDone pointrt-view -q grass.pro -o out/green.png --size 96x64 --color-by rgb
    cmp out/green.png out/grass.png || fail "rgb is not what there is by itself"
    bakeSphere
    expectDone pointrt-view scene.pro -o out/ball.png --size 96x64
    ! grep -q 'coloured by' stderr || fail "objects stay as clay"
    expectDone pointrt-view -q hill.pro -o out/legend.png --size 96x64 --color-by height --legend on
    ! cmp -s out/legend.png out/height.png || fail "no legend"
    expectDone pointrt-view -q hill.pro -o out/own.png --size 96x64 --legend on
    cmp out/own.png out/legend.png || fail "no legend of the colours by default"
    expectError 2 "--legend: needs --color-by" pointrt-view grass.pro -o out/a.png --legend on
    expectDone pointrt-view -q hill.pro -o out/map.png --size 96x64 --color-by height --color-map magma --color-range 0,0.2
    ! cmp -s out/map.png out/height.png || fail "map and range make no difference"
    rm out/*
    expectError 2 "hill.pro .*\"intensty\", .*\"intensity\"" \
        pointrt-view hill.pro -o out/a.png --color-by intensty
    expectError 2 "--color-map: \"jet\".*viridis, magma" pointrt-view hill.pro -o out/a.png --color-by height --color-map jet
    expectError 2 "--color-range: .*2,1.*lower" pointrt-view hill.pro -o out/a.png --color-by height --color-range 2,1
    expectError 2 "--legend: .*FILE.png" pointrt-view hill.pro -o out/a.exr --color-by height --legend on
}

# hasIntegrator NAME SPP ARGUMENT...: renders a small picture of scene.pro and checks how.
hasIntegrator() {
    local name=$1 spp=$2
    shift 2
    expectDone pointrt-view -q scene.pro --size 32x32 --stats stats.json "$@"
    [ "$(jsonValue stats.json integrator)" = "$name" ] || fail "$*: not $name"
    [ "$(jsonValue stats.json spp)" = "$spp" ] || fail "$*: not $spp samples"
}

case_only_pictures_left_to_us_are_path_traced() {
    bakeSphere
    hasIntegrator path 8 -o out/a.png
    hasIntegrator path 8 -o out/again.png --color-by rgb --exposure 0
    cmp out/a.png out/again.png
    hasIntegrator phong 4 -o out/b.png --integrator phong
    hasIntegrator phong 2 -o out/b.png --spp 2
    hasIntegrator phong 4 -o out/b.png --lights 3
    hasIntegrator phong 4 -o out/b.png --room matte
    hasIntegrator phong 4 -o out/b.png --background white
    hasIntegrator phong 4 -o out/b.exr
    printf '[[instance]]\nfile = "scene.pro"\n' >scene.toml
    expectDone pointrt-view -q scene.toml -o out/b.png --size 32x32 --stats stats.json
    [ "$(jsonValue stats.json integrator)" = phong ] || fail "scene files say how"
}

case_films_differ_by_colours() {
    bakeHill
    expectDone pointrt-view -q hill.pro -o film.exr --size 32x24 --spp 2 --color-by normal
    expectError 1 "color_by .*normal .*height" \
        pointrt-view -q hill.pro -o film.exr --resume --size 32x24 --spp 4 --color-by height
}

# A scene file makes the roof emit light, selected by its height and then by its class. The camera looks down.
case_overrides_by_numbers() {
    bakeHill
    cat >scene.toml <<'EOF'
up = "z"
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
[render]
size = [32, 32]
spp = 1
lights = 0
[material.roof]
color = [0, 0, 0]
emission = [1, 1, 1]
[[instance]]
file = "hill.pro"
[[instance.override]]
attribute = "height"
range = [0.4, 1]
material = "roof"
EOF
    expectDone pointrt-view -q scene.toml -o out/high.png --integrator path
    sed -i 's/"height"/"class"/; s/range = .*/values = [6]/' scene.toml
    expectDone pointrt-view -q scene.toml -o out/class.png --integrator path
    cmp out/high.png out/class.png || fail "the roof is not what is of class 6"
    sed -i 's/values = .*/values = [7]/' scene.toml
    expectDone pointrt-view -q scene.toml -o out/none.png --integrator path
    ! cmp -s out/none.png out/class.png || fail "the override makes no difference"
    rm out/*
    sed -i 's/"class"/"klass"/' scene.toml
    expectError 1 "scene.toml:15: key \"instance.0..override.0..attribute\": .*hill.pro .*\"klass\"" \
        pointrt-view scene.toml -o out/a.png
}

# gaussians XYZ...: a .splat of round Gaussians; each digit is a coordinate, 0, 1 or 2.
gaussians() {
    local at axis
    local -A bytes=([0]='\0\0\0\0' [1]='\0\0\x80\x3f' [2]='\0\0\0\x40')
    for at in "$@"; do
        for axis in 0 1 2; do printf "${bytes[${at:axis:1}]}"; done
        # three deviations of 0.0625, opaque white, no rotation
        printf '\0\0\x80\x3d\0\0\x80\x3d\0\0\x80\x3d\xff\xff\xff\xff\xff\x80\x80\x80'
    done
}

# A row of balls does not show which way is up, and the format's convention is only a guess: both tools say so.
case_captures_without_a_base_have_a_guessed_up() {
    gaussians 000 100 200 >row.splat
    expectDone pointrt-bake row.splat -o row.pro --stats stats.json
    grep -q 'up is a guess: -y' stderr || fail "the bake does not say that it guessed"
    [ "$(jsonValue stats.json up_from)" = guess ] || fail "the statistics do not say that up is a guess"
    expectDone pointrt-view row.pro --size 8x8 --spp 1 -o out/row.png
    grep -q 'up is a guess: -y' stderr || fail "the viewer does not say that up is a guess"
}

case_lit_captures_say_that_they_show_no_caustics() {
    gaussians 000 100 200 >row.splat
    pointrt-bake -q row.splat -o row.pro
    cat >lit.toml <<'TOML'
[[instance]]
file = "row.pro"
[material.glass]
kind = "glass"
[[shape]]
type = "sphere"
center = [0, -2, 0]
radius = 0.5
material = "glass"
[[light]]
type = "point"
position = [0, -5, 0]
intensity = 20
TOML
    expectDone pointrt-view lit.toml --size 8x8 --spp 1 --relight on -o out/lit.png
    grep -q 'no caustics' stderr || fail "the viewer does not say that caustics are missing"
    expectDone pointrt-view lit.toml --size 8x8 --spp 1 --relight on --caustics off -o out/off.png
    ! grep -q 'no caustics' stderr || fail "the viewer warns of missing caustics that are turned off"
    expectDone pointrt-view lit.toml --size 8x8 --spp 1 -o out/kept.png
    ! grep -q 'no caustics' stderr || fail "the viewer warns of missing caustics, but the capture is not relit"
}

case_captures_become_discs_on_request() {
    gaussians 000 100 010 110 001 101 >some.splat
    pointrt-bake -q some.splat -o discs.pro --splat disc --outliers keep
    pointrt-bake -q some.splat -o kept.pro
    pointrt-info kept.pro | grep '^Gaussians ' >/dev/null || fail "Gaussians are not kept"
    ! pointrt-info discs.pro | grep '^Gaussians ' >/dev/null || fail "--splat disc keeps Gaussians"
}

# Two walls that meet in an upright edge, seen along z.
case_balls_have_the_up_of_discs() {
    awk 'BEGIN { srand(1); for (k = 0; k < 8000; ++k) { i = k % 7; u = rand(); foot = 0.1 * (i % 3)
        y = foot + (1.2 - 0.07 * (i % 4) - foot) * rand(); t = 0.1 * (i + u)
        print (k % 2 ? t - 0.7 : t), y, (k % 2 ? t : 0.7 - t) } }' >front.xyz
    local splat
    for splat in disc ball; do
        pointrt-bake front.xyz -o $splat.pro --splat $splat 2>log
        grep -q 'up is a guess: y, as it faces along z' log || fail "of $splat: $(tail -1 log)"
    done
}

# The up direction stored in a file, found or guessed by the bake, acts like --up. The points of a ball do not show it:
# z is guessed.
case_up_directions() {
    bakeHill
    sphere 2000 >ball.xyz
    pointrt-bake -q ball.xyz -o silent.pro --orient none --stats silent.json
    pointrt-bake -q ball.xyz -o known.pro --orient none --up z --stats known.json
    pointrt-bake -q ball.xyz -o flat.pro --orient none --up y
    pointrt-bake hill.ply -o found.pro --outliers keep --orient none --stats found.json 2>log
    grep -q 'up is z, from .*--up' log || fail "the bake does not say that it found what is up"
    [ "$(jsonValue found.json up_from)" = data ] || fail "the report does not say so"
    [ "$(jsonValue known.json up_from)" = option ] || fail "the report does not say who said it"
    [ "$(jsonValue silent.json up_from)" = guess ] || fail "a ball does not show its up axis"
    local picture="--integrator normal --size 48x32 --spp 1"
    # shellcheck disable=SC2086
    {
        expectDone pointrt-view -q hill.pro -o out/hill.png $picture
        expectDone pointrt-view -q found.pro -o out/found.png $picture
        expectDone pointrt-view -q known.pro -o out/known.png $picture
        expectDone pointrt-view -q flat.pro -o out/told.png $picture --up z
        expectDone pointrt-view silent.pro -o out/silent.png $picture
        grep -q 'silent.pro: up is a guess: z,.*--up' stderr || fail "the viewer does not say that it guesses"
        expectDone pointrt-view -q flat.pro -o out/flat.png $picture
        expectDone pointrt-view -q known.pro -o out/again.png $picture --up y
        printf '[[instance]]\nfile = "known.pro"\n' >scene.toml
        expectDone pointrt-view -q scene.toml -o out/scene.png $picture
        printf 'up = "z"\n[[instance]]\nfile = "silent.pro"\n' >word.toml
        expectDone pointrt-view -q word.toml -o out/word.png $picture
        printf 'up = "auto"\n[[instance]]\nfile = "silent.pro"\n' >auto.toml
        expectDone pointrt-view -q auto.toml -o out/auto.png $picture
    }
    cmp out/hill.png out/found.png || fail "found: not upright"
    local same
    for same in told scene word silent auto; do cmp out/known.png "out/$same.png" || fail "$same: not upright"; done
    cmp out/flat.png out/again.png || fail "again: not as ever"
    ! cmp -s out/known.png out/flat.png || fail "up makes no difference"
}

case_sections_are_clips_seen_in_true_scale() {
    sphere 3000 >ball.xyz
    pointrt-bake -q ball.xyz -o ball.pro --up z
    local look="--size 64x48 --integrator normal"
    printf '[[instance]]\nfile = "ball.pro"\n[[clip]]\ntype = "plane"\npoint = [0, 0, 0.3]\nnormal = [0, 0, -1]\n' >cut.toml
    # shellcheck disable=SC2086
    {
        expectDone pointrt-view ball.pro --section z=0.3 $look -o out/plan.png
        grep -q 'section .* per pixel' stderr || fail "the viewer does not say the scale"
        expectDone pointrt-view -q cut.toml --up z --view top --ortho fit $look -o out/top.png
        expectDone pointrt-view -q ball.pro --view top --ortho fit $look -o out/whole.png
        expectDone pointrt-view -q ball.pro --clip=-2,-2,-2,2,2,0.3 --view top --ortho fit $look -o out/box.png
        expectDone pointrt-view ball.pro --clip=5,5,5,6,6,6 $look -o out/nothing.png
    }
    grep -q 'clips hide the scans' stderr || fail "the viewer does not say that nothing is left"
    cmp out/plan.png out/top.png || fail "the plan is not the clipped scan from above"
    cmp out/plan.png out/box.png || fail "the box does not cut as the plane"
    ! cmp -s out/plan.png out/whole.png || fail "the section cuts nothing"
    expectError 2 '--section: "z" ' pointrt-view ball.pro --section z -o out/none.png
    expectError 2 '--clip: "1,2,3" ' pointrt-view ball.pro --clip 1,2,3 -o out/none.png
}

# expectSamePictures CLOUD: bakes it with a tracing index, which the viewer reads, and without, so that the viewer builds
# the index. Both must give the same picture.
expectSamePictures() {
    local bake
    expectDone pointrt-bake -q "$1" --outliers keep -o whole.pro -f
    expectDone pointrt-bake -q "$1" --outliers keep -o compact.pro -f --compact
    for bake in whole compact; do
        expectDone pointrt-view -v "$bake.pro" -o "out/$bake.png" --size 96x64 --spp 1
        grep -q "tracing index $([ $bake = whole ] && echo "from the file" || echo built)" stderr || fail "$bake: which index?"
    done
    cmp out/whole.png out/compact.png
    rm out/*
}

case_the_index_shows_the_same_picture() {
    sphere 5000 >even.xyz
    expectSamePictures even.xyz
    # dense in the middle, where cells are divided into groups
    sphere 15000 | awk '{ k = NR % 5 < 3 ? 0.02 : 1; print k * $1, k * $2, k * $3 }' >uneven.xyz
    expectSamePictures uneven.xyz
    expectDone pointrt-info whole.pro --json
    [ "$(jsonValue stdout index.groups)" -gt 0 ] || fail "no groups were tried"
}

case_damaged_index() {
    local offset size
    bakeSphere
    size=$(stat -c %s scene.pro)
    for offset in $((size * 45 / 100)) $((size * 6 / 10)) $((size * 9 / 10)); do # CELS, DSCS, DSPL
        cp scene.pro damaged.pro
        printf '\377\377\377\377' | dd of=damaged.pro bs=1 seek="$offset" conv=notrunc status=none
        expectError 1 "damaged.pro: .*checksum" pointrt-view damaged.pro -o out/a.png --size 32x32
    done
}

case_thumbnail() {
    local command
    bakeSphere
    command=$(sed -n 's/^Exec=//p' "$suite_dir/../../packaging/desktop/pointrt.thumbnailer") # what file managers run
    command=${command//%i/scene.pro} command=${command//%s/128} command=${command//%o/out/no_suffix}
    # shellcheck disable=SC2086 # a list of words
    expectDone env -u DISPLAY -u WAYLAND_DISPLAY $command
    [ ! -s stderr ] || fail "something on stderr"
    [ "$(head -c 8 out/no_suffix | od -An -t x1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG"
    [ "$(bigEndian out/no_suffix 16)x$(bigEndian out/no_suffix 20)" = 128x128 ] || fail "not of 128 pixels"
    expectDone pointrt-view scene.pro --size 128x128 -q --integrator phong -o out/picture.png # for its time, no path tracing
    cmp out/no_suffix out/picture.png || fail "a thumbnail that had time enough is another picture"
    # the picture is written to the file that the file manager has created and holds open
    : >out/held
    exec 3<out/held
    expectDone pointrt-view scene.pro --thumbnail 128 -o out/held
    cmp out/picture.png <(cat <&3) || fail "the file was replaced"
    rm out/held
    expectError 4 "nowhere/a.png: " pointrt-view scene.pro --thumbnail 64 -o out/nowhere/a.png
    expectError 2 "--thumbnail: .*-o FILE" pointrt-view scene.pro --thumbnail 64
    expectError 2 "--thumbnail and --size " pointrt-view scene.pro --thumbnail 64 --size 8x8 -o out/a.png
}

case_wrong_suffix() {
    bakeSphere
    expectError 2 "out/a.jpeg: " pointrt-view scene.pro -o out/a.jpeg
}

case_no_such_scene() {
    expectError 1 "missing.pro: " pointrt-view missing.pro -o out/a.png
}

case_hostile_scenes() {
    local size bytes
    bakeSphere
    size=$(stat -c %s scene.pro)
    for bytes in 0 1 64 4096 $((size / 2)) $((size - 1)); do
        head -c "$bytes" scene.pro >cut.pro
        expectError 1 "cut.pro(:[^ ]+)?: " pointrt-view cut.pro -o out/a.png
    done
    head -c "$size" /dev/urandom >noise.pro
    expectError 1 "noise.pro(:[^ ]+)?: " pointrt-view noise.pro -o out/a.png
    { cat scene.pro && echo more; } >long.pro
    expectError 1 "long.pro(:[^ ]+)?: " pointrt-view long.pro -o out/a.png
}

case_output_folder_missing() {
    bakeSphere
    expectError 4 "out/none/a.png: " pointrt-view scene.pro -q --size 16x16 --spp 1 -o out/none/a.png
}

case_no_device() {
    bakeSphere
    expectError 3 "" env VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent \
        pointrt-view scene.pro -q -o out/a.png
}

case_device_list() {
    expectDone pointrt-view --device list
    [ -s stdout ] || fail "no device is listed"
}

case_no_display_is_needed() {
    bakeSphere
    expectDone env -u DISPLAY -u WAYLAND_DISPLAY pointrt-view scene.pro -q --size 48x32 --spp 1 -o out/a.png
    [ "$(head -c 8 out/a.png | od -An -t x1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "not a PNG"
    [ "$(bigEndian out/a.png 16)x$(bigEndian out/a.png 20)" = 48x32 ] || fail "not 48x32"
}

case_exr_channels() {
    local channel
    bakeSphere
    expectDone pointrt-view scene.pro -q --size 32x32 --spp 1 -o out/a.exr
    [ "$(head -c 4 out/a.exr | od -An -t x1 | tr -d ' \n')" = 762f3101 ] || fail "not an EXR"
    head -c 2000 out/a.exr | tr '\0' '\n' >header.txt
    for channel in R G B A Z N.X N.Y N.Z P.X P.Y P.Z direct.R indirect.G caustic.B albedo.R id.splat id.instance \
        id.material samples variance; do
        grep -aqxF "$channel" header.txt || fail "no channel $channel"
    done
}

case_bench() {
    bakeSphere
    expectDone pointrt-view scene.pro --size 64x64 --spp 2 --room mirror --lights 2 --bounces 3 --bench 2
    expectKeys stdout device width height integrator spp samples noise denoise_ms splats device_bytes load_seconds first_frame_seconds frame_ms.min \
        frame_ms.median frame_ms.max frame_cpu_ms.median rays.primary rays.shadow rays.secondary mrays_per_second
    [ "$(jsonValue stdout rays.primary)" = $((64 * 64 * 2)) ] || fail "one primary ray for each sample was expected"
    [ "$(jsonValue stdout rays.secondary)" -gt 0 ] || fail "a mirror room without secondary rays"
    [ "$(jsonValue stdout splats)" = "$(jsonValue stats.json splats)" ] || fail "not the splats that were baked"
    expectDone pointrt-view scene.pro -q --size 64x64 --spp 2 --bench 2 --profile
    [ "$(jsonValue stdout profile.frames)" = 2 ] || fail "a profile of other frames than those measured"
    expectKeys stdout profile.frames_ms profile.unaccounted_ms
    grep -q "unaccounted for" stderr || fail "no table"
}

case_same_seed_same_picture() {
    bakeSphere
    expectDone pointrt-view scene.pro -q --size 48x48 --spp 2 --seed 7 -o out/a.png
    expectDone pointrt-view scene.pro -q --size 48x48 --spp 2 --seed 7 -o out/b.png
    cmp out/a.png out/b.png
}

# The options reach the denoiser and the tone mapping, whose effects are tested elsewhere.
case_denoise_and_exposure() {
    local options="-q --size 48x48 --spp 2"
    bakeSphere
    # shellcheck disable=SC2086 # words
    {
        expectDone pointrt-view scene.pro $options -o out/auto.png --stats auto.json
        expectDone pointrt-view scene.pro $options --denoise on -o out/on.png
        expectDone pointrt-view scene.pro $options --denoise off -o out/off.png --stats off.json
        expectDone pointrt-view scene.pro $options --denoise off --exposure 0 -o out/same.png
        expectDone pointrt-view scene.pro $options --denoise off --exposure -1 -o out/dark.png
        expectDone pointrt-view scene.pro $options -o out/data.exr --stats data.json
    }
    cmp out/auto.png out/on.png || fail "soft shadows are not denoised by default"
    ! cmp -s out/auto.png out/off.png || fail "the denoiser changes nothing"
    cmp out/off.png out/same.png
    ! cmp -s out/off.png out/dark.png || fail "--exposure changes nothing"
    awk -v ms="$(jsonValue auto.json denoise_ms)" 'BEGIN { exit !(ms > 0) }' || fail "denoise_ms is not above 0"
    [ "$(jsonValue off.json denoise_ms)" = 0 ] || fail "denoise_ms is not 0"
    [ "$(jsonValue data.json denoise_ms)" = 0 ] || fail "data are denoised unasked"
}

# pngChannels FILE: prints the number of channels, from the colour type in its header.
pngChannels() {
    case $(od -An -t u1 -j 25 -N 1 "$1" | tr -d ' ') in
    2) echo 3 ;;
    6) echo 4 ;;
    *) fail "$1: neither RGB nor RGBA" ;;
    esac
}

# Transparent pictures have an alpha channel, whichever way they are written.
case_background() {
    local denoise
    bakeSphere
    for denoise in off on; do
        expectDone pointrt-view -q scene.pro -o "out/$denoise.png" --size 48x32 --background transparent --denoise $denoise
        [ "$(pngChannels "out/$denoise.png")" = 4 ] || fail "denoise $denoise: no alpha"
    done
    expectDone pointrt-view -q scene.pro -o out/late.png --size 48x32 --background transparent --time-limit 60 --spp 4
    [ "$(pngChannels out/late.png)" = 4 ] || fail "written at the end: no alpha"
    expectDone pointrt-view -q scene.pro -o out/white.png --size 48x32 --background white
    [ "$(pngChannels out/white.png)" = 3 ] || fail "white: it is not RGB"
    printf 'background = "transparent"\n[[instance]]\nfile = "scene.pro"\n' >scene.toml
    expectDone pointrt-view -q scene.toml -o out/scene.png --size 48x32 --denoise off
    cmp out/off.png out/scene.png || fail "the scene file's differs"
}

# The viewer must run on machines with little more than a driver.
case_light_dependencies() {
    ldd "$POINTRT_BIN/pointrt-view" >libraries
    ! grep -Ei 'pcl|flann|cgal|draco|boost' libraries || fail "the viewer is linked to the bake's libraries"
}

runCase "$@"
