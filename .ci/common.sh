# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Functions shared by demo.sh and test.sh. Sourced from the repository's root, after `set -euo pipefail`.

# The build and the scripts read and write plain ASCII numbers whatever the user's language is.
export LC_ALL=C.UTF-8

say() { printf '==> %s\n' "$*"; }
die() {
    printf '%s: error: %s\n' "${0##*/}" "$*" >&2
    exit 3
}

# listedPackages USE...: the packages of .ci/packages.txt for these uses, one a line.
listedPackages() {
    awk -v uses=" $* " '/^[^#]/ && index(uses, " " substr($3, 1, length($3) - 1) " ") { print $1 }' .ci/packages.txt
}

# missingPackages USE...: those of them that are not installed.
missingPackages() {
    local package
    for package in $(listedPackages "$@"); do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
    done
}

# rustUse: "rust12" or "rust13", whichever this Debian needs for LAZ and E57 files; nothing where a cargo is new enough.
rustUse() {
    local version
    version=$(cargo --version 2>/dev/null || true)
    version=$(awk '{ split($2, part, "."); print part[1] * 1000 + part[2] }' <<<"$version")
    [ "${version:-0}" -lt 1085 ] || return 0 # 1.85: format/pointio/Cargo.toml
    # shellcheck disable=SC1091
    case $(. /etc/os-release && echo "${VERSION_ID:-}") in
        12) echo rust12 ;;
        *) echo rust13 ;;
    esac
}

# installPackages USE...: installs what is missing, and touches apt only then.
installPackages() {
    local missing headers="" as_root=""
    if ! command -v dpkg-query >/dev/null; then
        say "no dpkg here: the libraries in .ci/packages.txt must be installed already"
        return
    fi
    case " $* " in
        *" bake "*)
            set -- "$@" "$(rustUse)"
            headers=$(missingHeaders)
            ;;
    esac
    missing=$(missingPackages "$@" | tr '\n' ' ')
    [ -n "$missing$headers" ] || return 0
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || die "run this as root, or install as root: $missing$headers"
        as_root="sudo"
    fi
    say "installing $missing$headers"
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q update
    # shellcheck disable=SC2086 # a list of words
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 install --no-install-recommends $missing
    # shellcheck disable=SC2086
    [ -z "$headers" ] || unpackHeaders $headers
}

# missingHeaders: the packages of which only headers are used, if they are neither installed nor unpacked.
missingHeaders() {
    local package
    for package in $(missingPackages headers); do
        [ -e "build/headers/$package.unpacked" ] || echo "$package"
    done | tr '\n' ' '
}

# unpackHeaders PACKAGE...: unpacks packages into build/headers, without those that they depend on.
unpackHeaders() {
    local package folder=$PWD/build/headers
    say "unpacking the headers of $*"
    mkdir -p "$folder"
    for package in "$@"; do
        (cd "$folder" && rm -f "$package"_*.deb && apt-get -q -o APT::Sandbox::User=root download "$package" &&
            dpkg-deb -x "$package"_*.deb . && rm "$package"_*.deb && touch "$package.unpacked")
    done
}

# memoryMiB: what can be used now, by this machine and by this container.
memoryMiB() {
    local available limit
    available=$(awk '$1 == "MemAvailable:" { print int($2 / 1024) }' /proc/meminfo 2>/dev/null || true)
    available=${available:-2048}
    limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)
    if [ "$limit" != max ] && [ $((limit / 1048576)) -lt "$available" ]; then
        available=$((limit / 1048576))
    fi
    echo "$available"
}

# buildJobs: all cores, but 1.5 GiB of memory for each compiler: what the PCL and CGAL headers take.
buildJobs() {
    local cores jobs
    cores=$(nproc)
    jobs=$(($(memoryMiB) / 1536))
    [ "$jobs" -ge 1 ] || jobs=1
    [ "$jobs" -le "$cores" ] || jobs=$cores
    echo "$jobs"
}

# buildPreset PRESET [OPTION...] [--target TARGET...]: configures, with cmake's OPTIONs, and builds into build/PRESET:
# everything, or the TARGETs.
buildPreset() {
    local started=$SECONDS preset=$1 output
    shift
    local options=()
    while [ $# -gt 0 ] && [ "$1" != --target ]; do
        options+=("$1")
        shift
    done
    say "building with the $preset preset, $(buildJobs) at a time"
    [ ! -d build/headers ] || export CMAKE_PREFIX_PATH=$PWD/build/headers/usr${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}
    output=$(cmake --preset "$preset" "${options[@]}" 2>&1) || {
        printf '%s\n' "$output" >&2
        die "cmake could not configure the build"
    }
    cmake --build --preset "$preset" --parallel "$(buildJobs)" "$@"
    say "built in $((SECONDS - started)) s"
}

# folderInMemory MIB: makes a folder in memory with room for MIB MiB that allows starting programs, and prints its
# path. Returns 1 if there is no such folder.
folderInMemory() {
    local folder
    [ "$(stat -f -c %T /dev/shm 2>/dev/null)" = tmpfs ] || return 1
    [ "$(df -Pm /dev/shm | awk 'NR == 2 { print $4 }')" -ge "$1" ] || return 1
    [ "$(memoryMiB)" -ge $(($1 + 4096)) ] || return 1 # 4 GiB: what two tests take at a time
    folder=$(mktemp -d /dev/shm/pointrt-XXXXXX) || return 1
    printf '#!/bin/sh\n' >"$folder/starts" && chmod +x "$folder/starts"
    if "$folder/starts" 2>/dev/null; then
        rm "$folder/starts"
        echo "$folder"
    else
        rm -r "$folder" # mounted without the right to execute
        return 1
    fi
}
