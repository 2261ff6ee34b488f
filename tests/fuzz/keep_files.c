/* SPDX-License-Identifier: Apache-2.0
 * Preloaded into tests: copies small files to the folder KEEP_FILES before the tests remove them, for corpora. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { LARGEST = 64 * 1024 };

static void keep(int folder, const char* name) {
    static atomic_int number;
    static char bytes[LARGEST];
    const char* kept = getenv("KEEP_FILES");
    struct stat status;
    if (!kept || fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) != 0) return;
    if (!S_ISREG(status.st_mode) || status.st_size == 0 || status.st_size > LARGEST) return;
    const char* slash = strrchr(name, '/');
    char path[4096];
    snprintf(path, sizeof path, "%s/%d_%d_%s", kept, (int)getpid(), atomic_fetch_add(&number, 1),
             slash ? slash + 1 : name);
    const int from = openat(folder, name, O_RDONLY), to = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const ssize_t size = from < 0 ? -1 : read(from, bytes, sizeof bytes);
    if (size > 0 && to >= 0 && write(to, bytes, (size_t)size) != size) unlink(path);
    close(from);
    close(to);
}

int unlinkat(int folder, const char* name, int flags) {
    if (!(flags & AT_REMOVEDIR)) keep(folder, name);
    return (int)syscall(SYS_unlinkat, folder, name, flags);
}
