#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the targets for OSS-Fuzz, which gives CC, CXX, CFLAGS, CXXFLAGS, LIB_FUZZING_ENGINE, SRC, WORK and OUT.
set -euo pipefail
cmake -S "$SRC/pointrt" -B "$WORK/build" -G Ninja -D CMAKE_BUILD_TYPE=None \
    -D CMAKE_C_FLAGS="$CFLAGS" -D CMAKE_CXX_FLAGS="$CXXFLAGS" -D POINTRT_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" \
    -D POINTRT_BUILD_FUZZERS=ON -D POINTRT_BUILD_TESTS=OFF -D POINTRT_WINDOW=OFF -D POINTRT_PRECOMPILE=OFF \
    -D CMAKE_BUILD_RPATH="\$ORIGIN/lib" -D CMAKE_BUILD_RPATH_USE_ORIGIN=ON
cmake --build "$WORK/build" --target fuzzers

fuzz=$SRC/pointrt/tests/fuzz
mkdir -p "$OUT/lib"
for program in "$WORK"/build/bin/fuzz_*; do
    name=${program##*/fuzz_}
    cp "$program" "$OUT/"
    # the image that runs the targets has none of these libraries
    ldd "$program" | awk '$3 ~ /^\/(usr\/)?lib/ { print $3 }' | grep -vE '/(libc|libm|libdl|libpthread|librt)\.so' |
        xargs -r cp -n -t "$OUT/lib"
    folders=()
    for folder in "$fuzz/corpus/$name" "$fuzz/findings/$name"; do [ ! -d "$folder" ] || folders+=("$folder"); done
    [ "$name" != pro ] || folders+=("$SRC/pointrt/tests/format/golden")
    find "${folders[@]}" -type f -print0 | xargs -0 zip -qj "$OUT/fuzz_${name}_seed_corpus.zip"
    [ ! -f "$fuzz/dictionaries/$name.dict" ] || cp "$fuzz/dictionaries/$name.dict" "$OUT/fuzz_$name.dict"
done
