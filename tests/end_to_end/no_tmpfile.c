/* SPDX-License-Identifier: Apache-2.0
 * Preloaded: simulates a file system without unnamed files; if KILL_AT_SYNC is set, the process is killed when it first
 * syncs a file. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

int open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const int mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, int) : 0;
    va_end(arguments);
    if ((flags & O_TMPFILE) == O_TMPFILE) {
        errno = EOPNOTSUPP;
        return -1;
    }
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int fsync(int descriptor) {
    if (getenv("KILL_AT_SYNC")) raise(SIGKILL);
    return (int)syscall(SYS_fsync, descriptor);
}
