#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-view for Windows without a window: pictures of all kinds, file names with any characters, long paths, bad
# input, and Ctrl-C.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needsDisplay
needs pointrt-view

alike pointrt-view --help
alike pointrt-view --version
alike pointrt-view --device list

sphere 3000 >sphere.xyz
"$bin/pointrt-bake" -q sphere.xyz -o sphere.pro
"$bin/pointrt-bake" -q sphere.xyz -o set.proset --tile-splats 1000
writeScene
writeGaussians
"$bin/pointrt-bake" -q row.splat -o row.pro 2>log
writeCameras

small="--size 80x60"
written phong.png pointrt-view sphere.pro $small
written whitted.png pointrt-view scene.toml --integrator whitted $small
written path.exr pointrt-view scene.toml --integrator path --spp 9 $small
written no_caustics.png pointrt-view scene.toml --integrator path --caustics off --spp 4 --denoise on $small
written room.png pointrt-view sphere.pro --room mirror --lights 3 --seed 7 $small
written height.png pointrt-view sphere.pro --color-by height --color-map turbo --legend on --size 200x160
written set.png pointrt-view set.proset $small
written gaussians.png pointrt-view row.pro --up y $small
written section.tif pointrt-view sphere.pro --section z=0 --size 100x100
written plan.png pointrt-view sphere.pro --plan 0.05
written plan.tif pointrt-view sphere.pro --plan 0.05
wine "$build/bin/pointrt-view.exe" sphere.pro --thumbnail 64 -o small.png # takes what samples a second allows
[ "$(od -An -tx1 -j16 -N8 small.png | tr -d ' \n')" = 0000004000000040 ] || fail "a thumbnail is not 64x64"

# each system continues a film of the other
cp path.exr continued.exr
"$bin/pointrt-view" scene.toml -q --integrator path --spp 12 $small --resume -o path.exr
wine "$build/bin/pointrt-view.exe" scene.toml -q --integrator path --spp 12 $small --resume -o continued.exr
cmp path.exr continued.exr

# pictures of cameras and turntables, with the lists of their cameras
"$bin/pointrt-view" sphere.pro -q --cameras cameras.json --spp 2 -o here.cameras
wine "$build/bin/pointrt-view.exe" sphere.pro -q --cameras cameras.json --spp 2 -o cameras
diff -r here.cameras cameras || fail "pictures of cameras differ"
mkdir here windows
"$bin/pointrt-view" sphere.pro -q --turntable 3 --size 20x20 --spp 1 -o here/%d.png
wine "$build/bin/pointrt-view.exe" sphere.pro -q --turntable 3 --size 20x20 --spp 1 -o windows/%d.png
diff -r here windows || fail "turntables differ"

for name in "${names[@]}"; do
    cp sphere.pro "$name.pro"
    sed "s|file = .*|file = \"$(basename "$name").pro\"|" scene.toml >"$name.toml"
    written "$name.png" pointrt-view "$name.toml" --size 20x16 --spp 1
    wine "$build/bin/pointrt-view.exe" "$name.pro" -q --size 8x8 --spp 1 -o a.png --stats "$name.json"
    [ -s "$name.json" ] || fail "no $name.json"
done

# bad input: both print the same lines
mkdir folder
: >empty.pro
sed 's/eye = .*/eye = [0, 2]/' scene.toml >eye.toml
sed 's/kind = "glass"/kind = "glas"/' scene.toml >kind.toml
sed 's/sphere.pro/none.pro/' scene.toml >missing.toml
sed 's/type = "plane"/typ = "plane"/' scene.toml >key.toml
echo 'not toml' >words.toml
for input in none.pro empty.pro eye.toml kind.toml missing.toml key.toml words.toml none.toml; do
    refused pointrt-view "$input" -o a.png
done
for options in '--size 0x9' '--spp many' '--eye 1,2' '--no-such-option' '-o a.jpg' '-o none/a.png' '-o folder' '--device 99' \
    '--color-by nothing' '--plan 0' '--clip 1,2,3' '--turntable 0' '--cameras none.json' '--resume'; do
    refused pointrt-view sphere.pro -o a.png $options
    cmp here.err windows.err || fail "$options: complains otherwise in Windows: $(cat windows.err)"
done
size=$(stat -c %s sphere.pro)
for bytes in 0 64 511 $((size / 2)) $((size - 1)); do
    head -c "$bytes" sphere.pro >cut.pro
    refused pointrt-view cut.pro -o a.png
done
DISPLAY='' run pointrt-view sphere.pro -o a.png --device 99 # no driver

# Ctrl-C saves the samples so far. Windows ends the program with 0xC000013A, of which a shell sees the lowest byte.
(exec wine "$build/bin/pointrt-view.exe" scene.toml --size 200x150 --spp 60000 --progress lines -o stopped.exr 2>progress) &
viewer=$!
for _ in $(seq 600); do
    ! grep -q '^progress .* samples' progress || break
    sleep 0.1
done
kill -INT $viewer
status=0
wait $viewer || status=$?
[ $status = $((0x3A)) ] || fail "exit status $status after Ctrl-C: $(cat progress)"
grep -q 'interrupted at .* of 60000 samples' progress || fail "not interrupted: $(tail -1 progress)"
[ -s stopped.exr ] || fail "Ctrl-C left no picture"
echo "the same in Windows"
