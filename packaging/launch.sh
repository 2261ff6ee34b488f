#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# In the bin folder of an archive for Linux (tarball.sh): starts the program of its own name from lib/programs. If the
# system's C library is older than the one that the programs were built with, it uses the loader and the C and C++
# runtimes of the archive; otherwise those of the system, because a newer driver needs them.
here=$(readlink -f "$0")
root=${here%/bin/*}
program=$root/lib/programs/${here##*/}
built_with=@GLIBC_MINOR@                             # 36 for glibc 2.36
system=$(getconf GNU_LIBC_VERSION 2>/dev/null)       # "glibc 2.31"; empty with another C library
system=${system#glibc 2.}
case $system in '' | *[!0-9]*) system=0 ;; esac
[ "$system" -lt "$built_with" ] || exec "$program" "$@"
exec "$root/lib/runtime/@LOADER@" --argv0 "$here" --library-path "$root/lib/runtime${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
    "$program" "$@"
