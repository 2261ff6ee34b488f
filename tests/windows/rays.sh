#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-rays for Windows: the output files of all commands, reports, file names with any characters, long paths,
# standard streams, and bad input.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needsDisplay
needs pointrt-rays

alike pointrt-rays --help
alike pointrt-rays --version
for command in cast compare contours lidar measure profile section sun viewshed; do alike pointrt-rays $command --help; done

sphere 3000 >sphere.xyz
"$bin/pointrt-bake" -q sphere.xyz -o sphere.pro
sphere 2000 | awk '{ $1 *= 1.01; print }' >other.xyz
"$bin/pointrt-bake" -q other.xyz -o other.pro
"$bin/pointrt-bake" -q sphere.xyz -o set.proset --tile-splats 1000
awk 'BEGIN { for (i = 0; i < 400; i++) print i % 20 / 10 - 1, int(i / 20) / 10 - 1, 5, 0.01, 0.02, -1 }' >rays.txt

for suffix in csv npy npz ply; do written hits.$suffix pointrt-rays cast sphere.pro --rays rays.txt; done
written occluded.csv pointrt-rays cast sphere.pro --rays rays.txt --any
written set.csv pointrt-rays cast set.proset sphere.pro --rays rays.txt
written compared.ply pointrt-rays compare sphere.pro other.pro
sensor=$repository/docs/sensors/street.toml
scan=(lidar sphere.pro --sensor "$sensor" --pose 3,0,0 --duration 0.05 --metres-per-unit 1 -q)
"$bin/pointrt-rays" "${scan[@]}" -o here.csv
wine "$build/bin/pointrt-rays.exe" "${scan[@]}" -o windows.csv
# except incidence_deg, an arccosine in single precision, whose last digit depends on the C library
for system in here windows; do cut -d, -f11 --complement $system.csv >$system.columns; done
head -1 here.csv | cut -d, -f11 | grep incidence_deg >/dev/null
cmp here.columns windows.columns || fail "pointrt-rays ${scan[*]}: other points in Windows"
paste -d, <(cut -d, -f11 here.csv) <(cut -d, -f11 windows.csv) |
    awk -F, 'NR > 1 && ($1 - $2) ^ 2 > 3e-5 ^ 2 { bad = 1 } END { exit bad }' || # two steps of a float of 90
    fail "incidence_deg differs"
for kind in angle polyline volume; do
    for suffix in csv geojson dxf json; do
        [ $kind.$suffix != volume.json ] || continue
        written $kind.$suffix pointrt-rays measure sphere.pro --kind $kind --points "0.5,0,2 0,0.5,2 -0.5,-0.5,2" --up 0,0,1
    done
done
for suffix in csv svg dxf; do
    written profile.$suffix pointrt-rays profile sphere.pro --line "-1.1,0.1 1.1,0.2" --step 0.05 --up 0,0,1
done
written sun.csv pointrt-rays sun sphere.pro --at 48.2,16.4 --date 2026-06-21 --every 120 --north 0,1,0 --up 0,0,1 --sky
written seen.ply pointrt-rays viewshed sphere.pro --from 3,0,0 --from 0,3,1 --up 0,0,1

# standard streams carry bytes
"$bin/pointrt-rays" cast sphere.pro -q --rays rays.txt -o rays.npy
"$bin/pointrt-rays" cast sphere.pro -q --rays - -o - <rays.txt >here.out
wine "$build/bin/pointrt-rays.exe" cast sphere.pro -q --rays - -o - <rays.txt >windows.out
cmp here.out windows.out

for name in "${names[@]}"; do
    cp sphere.pro "$name.pro"
    cp rays.txt "$name.txt"
    written "$name.csv" pointrt-rays cast "$name.pro" --rays "$name.txt"
    written "$name.npz" pointrt-rays cast "$name.pro" --rays "$name.txt"
done

# bad input: both print the same lines
mkdir folder
: >empty.pro
echo '1 2 3 4 5' >short.txt
echo '0 0 0 0 0 0' >still.txt
head -c 3000 sphere.pro >cut.pro
for words in 'cast none.pro --rays rays.txt' 'cast folder --rays rays.txt' 'cast empty.pro --rays rays.txt' \
    'cast cut.pro --rays rays.txt' 'cast sphere.pro --rays none.txt' 'cast sphere.pro --rays short.txt' \
    'cast sphere.pro --rays still.txt' 'cast sphere.pro' 'cast sphere.pro --rays rays.txt -o none/a.csv' \
    'cast sphere.pro --rays rays.txt -o a.jpg' 'cast sphere.pro --rays rays.txt --device 99' 'cost sphere.pro' \
    'lidar sphere.pro --sensor rays.txt' 'measure sphere.pro --kind area --points 1,2' 'sun sphere.pro --at 99,0' \
    'viewshed sphere.pro --from 1,2' 'compare sphere.pro none.pro' 'profile sphere.pro --line 1'; do
    refused pointrt-rays ${words%% *} -o a.csv ${words#* } # of two -o the last counts
done
echo "the same in Windows"
