#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-bake for Windows writes the same bytes and prints the same text as here: scans of many formats, options, tile
# sets, file names with any characters, long paths, Ctrl-C, hostile files, and bakes started by pointrt-view.
#   POINTRT_DATA: a folder with real scans; those below 300 kB are baked
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needs pointrt-bake

alike pointrt-bake --help
alike pointrt-bake --version

sphere 3000 >sphere.xyz
written sphere.pro pointrt-bake -q sphere.xyz
suffixes="ply pcd las"
if ! grep -q 'Without LAZ and E57' "$build/log"; then suffixes+=" laz e57"; fi
mkdir scans
for suffix in $suffixes; do "$bin/pointrt-info" sphere.pro --export "scans/sphere.$suffix"; done
gzip -c sphere.xyz >scans/sphere.xyz.gz
writeGaussians
"$bin/pointrt-bake" -q row.splat -o row.pro
"$bin/pointrt-info" row.pro --export scans/row.spz
mv row.splat scans
python3 "$repository/tests/windows/bake_inputs.py" "$bin" "$build" scans/*

# every stage that rounds: cleaning, orientation, filling, Gaussians. Paths in Windows syntax among several scans
for options in '--clean 2' '--clean off --orient up' '--orient mst' '--splat ball' '--normals estimate --neighbors 24' \
    '--thin 0.1' '--bounds -1,-1,-1,1,1,0.5' '--every 3 --attributes none' '--compact' '--prune off --up y' '--threads 1'; do
    # shellcheck disable=SC2086 # a list of words
    written options.pro pointrt-bake -q sphere.xyz $options
    rm -f options.pro here.options.pro
done
written two.pro pointrt-bake -q sphere.xyz scans/sphere.ply
wine "$build/bin/pointrt-bake.exe" -q 'scans\sphere.ply' -o 'scans\slashes.pro'
wine "$build/bin/pointrt-bake.exe" -q "$PWD/scans/sphere.ply" -o "$PWD/scans/absolute.pro"
cmp scans/slashes.pro scans/absolute.pro
there=$(winepath -w "$PWD/scans")
wine "$build/bin/pointrt-bake.exe" -q "\\\\?\\$there\\sphere.ply" -o "\\\\?\\$there\\prefixed.proset" --tile-splats 1000
"$bin/pointrt-bake" -q scans/sphere.ply -o here.prefixed.proset --tile-splats 1000
diff -r here.prefixed.proset scans/prefixed.proset
rm -r here.prefixed.proset
# a network share: Wine looks for them there
mkdir -p "$WINEPREFIX/dosdevices/unc/server"
ln -sfn "$PWD/scans" "$WINEPREFIX/dosdevices/unc/server/share"
wine "$build/bin/pointrt-bake.exe" -q '\\server\share\sphere.ply' -o '\\server\share\share.pro'
cmp scans/slashes.pro scans/share.pro
wine "$build/bin/pointrt-info.exe" '\\server\share\share.pro' --verify >windows.out
mkdir "${long}folder" # whose path takes 400 characters
cp sphere.xyz scans/sphere.ply "${long}folder"
written folder.pro pointrt-bake -q "${long}folder"
rm -r "${long}folder"
cp sphere.xyz 'each 1.txt'
cp sphere.xyz 'each 2.txt'
"$bin/pointrt-bake" -q each*.txt -o here.each.pro
wine "$build/bin/pointrt-bake.exe" -q 'each*.txt' -o each.pro # which no shell of Windows expands
cmp here.each.pro each.pro
"$bin/pointrt-bake" -q - -o here.stdin.pro <sphere.xyz
wine "$build/bin/pointrt-bake.exe" -q - -o stdin.pro <sphere.xyz
cmp here.stdin.pro stdin.pro
wine "$build/bin/pointrt-bake.exe" -q sphere.xyz -o stats.pro --stats stats.json
grep -q '"input_points": 3000' stats.json || fail "no statistics: $(cat stats.json)"

# tile sets: in one run, step by step, and replaced
set_options=(--tile-splats 1000 --max-memory 512M)
"$bin/pointrt-bake" -q sphere.xyz -o here.proset "${set_options[@]}"
wine "$build/bin/pointrt-bake.exe" -q sphere.xyz -o set.proset "${set_options[@]}" 2>windows.err || fail "$(cat windows.err)"
diff -r here.proset set.proset || fail "tile sets differ"
for step in plan split block:0 levels tile:0 top; do
    wine "$build/bin/pointrt-bake.exe" -q sphere.xyz -o steps.proset "${set_options[@]}" --step $step 2>windows.err ||
        fail "step $step: $(cat windows.err)"
done
diff -r here.proset steps.proset || fail "a tile set made in steps differs"
refused pointrt-bake -q sphere.xyz -o set.proset "${set_options[@]}" # it exists
wine "$build/bin/pointrt-bake.exe" -q scans/sphere.ply -o set.proset "${set_options[@]}" --force 2>windows.err ||
    fail "a set is not replaced: $(cat windows.err)"
"$bin/pointrt-bake" -q scans/sphere.ply -o here.proset "${set_options[@]}" --force
diff -r here.proset set.proset || fail "the set that replaced another differs"
[ "$(ls -d ./*.proset*)" = "$(printf '%s\n' ./here.proset ./set.proset ./steps.proset)" ] || fail "left: $(ls -d ./*.proset*)"

for name in "${names[@]}"; do
    cp sphere.xyz "$name.xyz"
    written "$name.pro" pointrt-bake -q "$name.xyz"
    wine "$build/bin/pointrt-bake.exe" -q "$name.xyz" -o "$name.proset" "${set_options[@]}" || fail "no $name.proset"
    rm -f "$name.pro"
done

# hostile files and bad command lines: the same lines
mkdir folder corpus
for file in "$repository"/tests/fuzz/corpus/scan*/[0-3]* "$repository"/tests/fuzz/findings/scan*/*; do
    cp "$file" "corpus/$(basename "$(dirname "$file")")-$(basename "$file")"
done
python3 "$repository/tests/windows/bake_inputs.py" "$bin" "$build" corpus/*
for arguments in '' 'none.ply -o a.pro' 'sphere.xyz' 'sphere.xyz -o a.png' 'sphere.xyz -o none/a.pro' 'folder -o a.pro' \
    'sphere.xyz -o sphere.pro' 'sphere.xyz -o a.pro --neighbors many' 'sphere.xyz -o a.pro --classes 2' '/none.ply -o a.pro' \
    'sphere.xyz -o a.pro --transform none.txt' 'sphere.xyz -o a.pro --no-such-option' 'sphere.xyz -o folder'; do
    # shellcheck disable=SC2086
    refused pointrt-bake $arguments
    tr '\\' / <windows.err | cmp here.err - || fail "$arguments: complains otherwise in Windows: $(cat windows.err)"
done

# interrupted OUTPUT WORDS OPTION...: Ctrl-C at the bake's third progress line ends it with 0xC000013A, of which a shell sees the
# lowest byte, and these words
interrupted() {
    local bake status=0 output=$1 words=$2
    shift 2
    : >progress
    (exec wine "$build/bin/pointrt-bake.exe" large.xyz -o "$output" "$@" --progress lines 2>progress) &
    bake=$!
    for _ in $(seq 600); do
        [ "$(grep -c '^progress' progress)" -lt 3 ] || break
        sleep 0.05
    done
    kill -INT $bake
    wait $bake || status=$?
    [ $status = $((0x3A)) ] || fail "$output: exit status $status after Ctrl-C: $(tail -3 progress)"
    grep -q "interrupted$words" progress || fail "$output: not interrupted: $(tail -1 progress)"
}
sphere 200000 >large.xyz
interrupted large.pro ', nothing was written'
[ ! -e large.pro ] || fail "Ctrl-C left a file"
interrupted large.proset '; run the same command to resume' --tile-splats 20000
wine "$build/bin/pointrt-bake.exe" -q large.xyz -o large.proset --tile-splats 20000 || fail "not resumed"
"$bin/pointrt-bake" -q large.xyz -o here.large.proset --tile-splats 20000
diff -r here.large.proset large.proset || fail "a resumed tile set differs"

if [ -n "${POINTRT_DATA:-}" ]; then
    cd "$POINTRT_DATA"
    find . -size -300k -regex '.*\.\(ply\|las\|laz\|e57\|pcd\|drc\|xyz\|txt\|pts\|ptx\|csv\|obj\|spz\|splat\|asc\)' | sort >"$work/list"
    cd "$work"
    ln -s "$POINTRT_DATA" data
    sed 's|^\.|data|' list | xargs -d '\n' python3 "$repository/tests/windows/bake_inputs.py" "$bin" "$build"
fi
if [ -e "$build/bin/pointrt-view.exe" ]; then
    needsDisplay
    written view.png pointrt-view scans/sphere.ply --size 40x30 # baked behind
fi
echo "the same in Windows"
