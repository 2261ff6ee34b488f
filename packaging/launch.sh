#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# In the bin folder of an archive for Linux (tarball.sh): starts the program of its own name from lib/programs. Where the
# system's C library is older than the one that the programs were built with, by the loader, C and C++ runtimes of the
# archive; else by the system's, since a newer driver needs those.
here=$(readlink -f "$0")
root=${here%/bin/*}
program=$root/lib/programs/${here##*/}
built_with=@GLIBC_MINOR@                             # 36 of glibc 2.36
system=$(getconf GNU_LIBC_VERSION 2>/dev/null)       # "glibc 2.31"; nothing where there is another C library
system=${system#glibc 2.}
case $system in '' | *[!0-9]*) system=0 ;; esac
[ "$system" -lt "$built_with" ] || exec "$program" "$@"
exec "$root/lib/runtime/@LOADER@" --argv0 "$here" --library-path "$root/lib/runtime${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" \
    "$program" "$@"
