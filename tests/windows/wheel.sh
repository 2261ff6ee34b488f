#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The wheel of the Python package for Windows: pip installs it into a Python for Windows in Wine, where the package's
# tests must pass and wheel.py must compute the same numbers and pictures as here. Skips, with the reason, if something
# cannot be downloaded.
#   wheel.sh REPOSITORY BIN BUILD WHEELS   WHEELS: the folder with the wheel for this system, which python.wheel makes
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
linux_wheel=$(echo "$4"/pointrt-*.whl)
[ -e "$linux_wheel" ] || skip "python.wheel made no wheel for this system"
command -v mvn >/dev/null || skip "no mvn here: install maven"
needsDisplay
needs pointrt-bake # starts Wine's services, too, which would keep pipes of later commands open

python3 -m venv linux
linux/bin/pip -q install "$linux_wheel" 2>log || skip "NumPy cannot be downloaded: $(tail -1 log)"
linux/bin/pip -q download --platform win_amd64 --python-version 3.13 --only-binary=:all: -d packages \
    numpy pytest colorama 2>log || skip "NumPy for Windows cannot be downloaded: $(tail -1 log)"
"$repository/packaging/windows/python.sh" "$build/python" 2>log || skip "Python for Windows cannot be downloaded: $(tail -1 log)"
# Wine 8's own C library lacks functions that NumPy calls.
mvn -q -B dependency:unpack -Dartifact=org.bytedeco:javacpp:1.5.12:jar:windows-x86_64 -DoutputDirectory="$work/javacpp" \
    -Dmdep.unpack.includes='**/ucrtbase.dll' >log || skip "Windows's C library cannot be downloaded: $(tail -1 log)"

# JavaCPP's Python has no python3.dll, which is another name of python313.dll's stable interface. Wine 8 has no WMI.
cp -r "$build/python" python
rm python/lib/_wmi.pyd
find javacpp -name ucrtbase.dll -exec cp {} python \;
x86_64-w64-mingw32-nm python/libs/python3.lib 2>/dev/null | sed -n 's/.* I __imp_//p' | sort -u |
    awk 'BEGIN { print "LIBRARY python3\nEXPORTS" } { print $1 " = python313." $1 }' >python3.def
x86_64-w64-mingw32-gcc-posix -shared -nostdlib -Wl,--entry=0 python3.def -o python/python3.dll
for package in packages/*.whl; do python3 -m zipfile -e "$package" python/lib/site-packages; done
# here, there ARGUMENT...: runs Python of this system or of Windows. In Wine 8, Python accepts pipes as standard
# streams, but not files.
export PYTHONDONTWRITEBYTECODE=1
here() { linux/bin/python "$@"; }
there() { WINEDLLOVERRIDES='ucrtbase=n,b;winedbg.exe=d' wine python/python.exe "$@" </dev/null 2>&1 | cat; }

# -O1: the calls into the libraries need not be fast here
"$repository/packaging/windows/wheel.sh" "$linux_wheel" "$build" "$build/python" \
    -C cmake.define.CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG"
wheel=$(echo "$build"/packages/pointrt-*-cp312-abi3-win_amd64.whl)
unzip -q "$wheel" -d files
for file in _core.pyd _core.pyi py.typed; do [ -e files/pointrt/$file ] || fail "the wheel lacks $file"; done
libraries=$(x86_64-w64-mingw32-objdump -p files/pointrt/_core.pyd | sed -n 's/.*DLL Name: //p' | sort | tr '\n' ' ')
[ "$libraries" = "KERNEL32.dll msvcrt.dll python3.dll " ] || fail "the module needs $libraries"

there -m pip install --no-index --no-deps --disable-pip-version-check "$wheel" >log || fail "pip: $(cat log)"
export POINTRT_BAKE=$build/bin/pointrt-bake.exe
# Not run: a test that hides drivers through the environment, which programs in Wine do not pass on to the Vulkan loader
# of Linux. --basetemp: in Wine links look like folders, so pytest would follow links left by tests of this system when
# it deletes old temporary folders. TMPDIR must stay the same, because it contains Wine's socket.
there -m pytest -q -p no:cacheprovider --basetemp="$work/temporary" -k "not test_no_device" "$repository/python/tests" >log || fail "$(cat log)"
tail -1 log

cp "$golden/tiny_v1_5.pro" tiny.pro
for name in "${names[@]}"; do printf '%s\n' "$name"; done >names.txt
awk '/^```python/ { on = 1; next } /^```/ { on = 0 } on' "$repository/python/README.md" >example.py
for system in here there; do
    [ $system = there ] || export POINTRT_BAKE=$bin/pointrt-bake
    [ $system = here ] || export POINTRT_BAKE=$build/bin/pointrt-bake.exe
    mkdir -p "$system.files"
    $system "$repository/tests/windows/wheel.py" $system.files >$system.out || fail "$system: $(cat $system.out)"
    { $system example.py && $system "$repository/docs/examples/minimal.py" ground.pro 500005 4500005 150 \
        $system.files/picture.npy; } | tr -d '\r' >$system.files/examples.txt
done
diff -r here.files there.files || fail "other numbers in Windows"
grep -q '^picture (240, 320, 3) uint8: ' there.files/examples.txt
echo "the same in Windows: $(ls there.files | wc -l) files"
