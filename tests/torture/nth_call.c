/* SPDX-License-Identifier: Apache-2.0
 * Runs a command and makes the N-th of its system calls that write below a folder fail.
 *     nth_call FOLDER LOG HOW N COMMAND...
 * The kernel notifies this program of each such call (seccomp), from any thread, process or library of the command:
 * preloaded functions would miss the C library's writes for stdio. LOG gets a line "NAME PATH" for each. HOW is
 *     kill    the process is killed before the call (being killed after it is being killed before the next one)
 *     tear    half of the bytes are written, then the process is killed
 *     short   one byte is written, and the call returns that
 *     halve   this call and all later ones write half of the requested bytes
 *     EIO, ENOSPC, EACCES       the call fails; with a + appended, all later calls that can fail like that do, too
 * If NTH_CALL_NAMED is set, the file system has no unnamed files. The exit status is the command's, or 125 if the
 * kernel cannot do this. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/filter.h>
#include <linux/openat2.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { CANNOT = 125 };

/* What the numbers of a call mean. */
enum Kind {
    OPEN,   /* flags stand behind the path; or in a struct open_how */
    DATA,   /* a descriptor gets bytes */
    VECTOR, /* the same of struct iovec */
    FILE_,  /* something is done to a descriptor */
    NAME    /* something is done to a path */
};

/* Which errors a call can have. */
enum { FULL = 1, DENIED = 2 }; /* all have EIO */

struct Call {
    int number;
    const char* name;
    enum Kind kind;
    int at;     /* which argument is the descriptor, or the path */
    int folder; /* which argument is the folder of the path; -1: the working directory */
    int errors;
};

static const struct Call calls[] = {
    {SYS_openat, "open", OPEN, 1, 0, FULL | DENIED},
    {SYS_openat2, "open", OPEN, 1, 0, FULL | DENIED},
    {SYS_write, "write", DATA, 0, -1, FULL},
    {SYS_pwrite64, "pwrite", DATA, 0, -1, FULL},
    {SYS_writev, "writev", VECTOR, 0, -1, FULL},
    {SYS_pwritev, "pwritev", VECTOR, 0, -1, FULL},
    {SYS_pwritev2, "pwritev2", VECTOR, 0, -1, FULL},
    {SYS_copy_file_range, "copy_file_range", FILE_, 2, -1, FULL},
    {SYS_sendfile, "sendfile", FILE_, 0, -1, FULL},
    {SYS_splice, "splice", FILE_, 2, -1, FULL},
    {SYS_fallocate, "fallocate", FILE_, 0, -1, FULL},
    {SYS_ftruncate, "ftruncate", FILE_, 0, -1, FULL},
    {SYS_truncate, "truncate", NAME, 0, -1, FULL | DENIED},
    {SYS_fsync, "fsync", FILE_, 0, -1, FULL},
    {SYS_fdatasync, "fdatasync", FILE_, 0, -1, FULL},
    {SYS_fchmod, "fchmod", FILE_, 0, -1, 0},
    {SYS_fchmodat, "fchmodat", NAME, 1, 0, DENIED},
    {SYS_fchown, "fchown", FILE_, 0, -1, 0},
    {SYS_fchownat, "fchownat", NAME, 1, 0, DENIED},
    {SYS_utimensat, "utimensat", NAME, 1, 0, DENIED},
    {SYS_linkat, "link", NAME, 3, 2, FULL | DENIED},
    {SYS_symlinkat, "symlink", NAME, 2, 1, FULL | DENIED},
    {SYS_renameat2, "rename", NAME, 3, 2, FULL | DENIED},
    {SYS_unlinkat, "unlink", NAME, 1, 0, DENIED},
    {SYS_mkdirat, "mkdir", NAME, 1, 0, FULL | DENIED},
    {SYS_mknodat, "mknod", NAME, 1, 0, FULL | DENIED},
#ifdef SYS_renameat
    {SYS_renameat, "rename", NAME, 3, 2, FULL | DENIED},
#endif
#ifdef SYS_open /* on architectures with the older calls that take no folder */
    {SYS_open, "open", OPEN, 0, -1, FULL | DENIED},
    {SYS_creat, "creat", NAME, 0, -1, FULL | DENIED},
    {SYS_link, "link", NAME, 1, -1, FULL | DENIED},
    {SYS_symlink, "symlink", NAME, 1, -1, FULL | DENIED},
    {SYS_rename, "rename", NAME, 1, -1, FULL | DENIED},
    {SYS_unlink, "unlink", NAME, 0, -1, DENIED},
    {SYS_rmdir, "rmdir", NAME, 0, -1, DENIED},
    {SYS_mkdir, "mkdir", NAME, 0, -1, FULL | DENIED},
    {SYS_chmod, "chmod", NAME, 0, -1, DENIED},
    {SYS_chown, "chown", NAME, 0, -1, DENIED},
#endif
};
enum { CALLS = sizeof calls / sizeof *calls };

/* The faults to cause, and the progress. */
static struct {
    const char* folder;
    FILE* log;
    bool kills, tears, shortens, halves, goes_on;
    int error, errors; /* errno, and which calls may have it */
    long at, count;
    bool no_nameless;
} plan;

/* The command's side. */

static void sendDescriptor(int channel, int descriptor) {
    char byte = 0, room[CMSG_SPACE(sizeof descriptor)] = {0};
    struct iovec bytes = {&byte, 1};
    struct msghdr message = {.msg_iov = &bytes, .msg_iovlen = 1, .msg_control = room, .msg_controllen = sizeof room};
    struct cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptor);
    memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
    if (sendmsg(channel, &message, 0) != 1) _exit(CANNOT);
}

static void becomeCommand(int channel, char** command) {
    struct sock_filter filter[CALLS + 3] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr))};
    for (int i = 0; i < CALLS; ++i)
        filter[1 + i] =
            (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)calls[i].number, CALLS - i, 0);
    filter[1 + CALLS] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    filter[2 + CALLS] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
    const struct sock_fprog program = {CALLS + 3, filter};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) _exit(CANNOT);
    const long listener = syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program);
    if (listener < 0) _exit(CANNOT);
    sendDescriptor(channel, (int)listener);
    execvp(command[0], command);
    _exit(127);
}

/* This process's side. */

static int receiveDescriptor(int channel) {
    int descriptor = -1;
    char byte, room[CMSG_SPACE(sizeof descriptor)];
    struct iovec bytes = {&byte, 1};
    struct msghdr message = {.msg_iov = &bytes, .msg_iovlen = 1, .msg_control = room, .msg_controllen = sizeof room};
    if (recvmsg(channel, &message, MSG_CMSG_CLOEXEC) != 1) return -1;
    const struct cmsghdr* header = CMSG_FIRSTHDR(&message);
    if (header) memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
    return descriptor;
}

/* Reads the caller's memory, possibly fewer bytes. */
static ssize_t readMemory(unsigned caller, uint64_t address, void* to, size_t bytes) {
    char path[64];
    snprintf(path, sizeof path, "/proc/%u/mem", caller);
    const int memory = open(path, O_RDONLY | O_CLOEXEC);
    if (memory < 0) return -1;
    const ssize_t got = pread(memory, to, bytes, (off_t)address);
    close(memory);
    return got;
}

/* The target of a link in /proc; "" if it is not a link. */
static void readLink(unsigned caller, const char* what, char path[PATH_MAX]) {
    char link[96];
    snprintf(link, sizeof link, "/proc/%u/%s", caller, what);
    const ssize_t length = readlink(link, path, PATH_MAX - 1);
    path[length < 0 ? 0 : length] = 0;
}

static void descriptorPath(unsigned caller, int descriptor, char path[PATH_MAX]) {
    char what[32];
    snprintf(what, sizeof what, "fd/%d", descriptor);
    readLink(caller, what, path);
}

/* The absolute path of a call. */
static void findPath(const struct seccomp_notif* notice, const struct Call* call, char path[PATH_MAX]) {
    char name[PATH_MAX] = "";
    path[0] = 0;
    const int folder = call->folder < 0 ? AT_FDCWD : (int)notice->data.args[call->folder];
    const uint64_t address = notice->data.args[call->at];
    if (address && readMemory(notice->pid, address, name, sizeof name - 1) < 0) return;
    if (name[0] != '/') {
        if (folder == AT_FDCWD)
            readLink(notice->pid, "cwd", path);
        else
            descriptorPath(notice->pid, folder, path);
        if (name[0]) strncat(path, "/", PATH_MAX - 1 - strlen(path));
    }
    strncat(path, name, PATH_MAX - 1 - strlen(path));
}

static uint64_t openFlags(const struct seccomp_notif* notice, const struct Call* call) {
    const uint64_t behind = notice->data.args[call->at + 1];
    struct open_how how = {0};
    if (call->number != SYS_openat2) return behind;
    readMemory(notice->pid, behind, &how, sizeof how);
    return how.flags;
}

/* Whether the descriptor is a file or a folder: pipes and devices are not output files. */
static bool isOnDisk(unsigned caller, int descriptor, bool* is_folder) {
    char path[64];
    struct stat status;
    snprintf(path, sizeof path, "/proc/%u/fd/%d", caller, descriptor);
    if (stat(path, &status) != 0) return false;
    *is_folder = S_ISDIR(status.st_mode);
    return *is_folder || S_ISREG(status.st_mode);
}

/* The name of the call in the log, and its path; null if it writes nothing below the folder. */
static const char* findTarget(const struct seccomp_notif* notice, const struct Call* call, char path[PATH_MAX]) {
    const char* name = call->name;
    bool is_folder = false;
    if (call->kind == OPEN) {
        const uint64_t flags = openFlags(notice, call);
        const bool is_nameless = (flags & O_TMPFILE) == O_TMPFILE;
        if (!is_nameless && !(flags & (O_CREAT | O_TRUNC))) return NULL;
        if (is_nameless) name = "open-nameless";
    }
    if (call->kind == OPEN || call->kind == NAME) {
        findPath(notice, call, path);
    } else {
        const int descriptor = (int)notice->data.args[call->at];
        if (!isOnDisk(notice->pid, descriptor, &is_folder)) return NULL;
        descriptorPath(notice->pid, descriptor, path);
    }
    if (is_folder) name = "fsync-folder";
    const size_t length = strlen(plan.folder);
    return strncmp(path, plan.folder, length) == 0 && (path[length] == '/' || !path[length]) ? name : NULL;
}

/* Duplicates a descriptor of the caller into this process: the same open file, with the same position. */
static int borrowDescriptor(unsigned caller, int descriptor) {
    char path[64], line[256];
    int process = -1, borrowed = -1;
    snprintf(path, sizeof path, "/proc/%u/status", caller);
    FILE* status = fopen(path, "re");
    while (status && fgets(line, sizeof line, status))
        if (sscanf(line, "Tgid: %d", &process) == 1) break;
    if (status) fclose(status);
    const int of_process = (int)syscall(SYS_pidfd_open, process, 0);
    if (of_process >= 0) borrowed = (int)syscall(SYS_pidfd_getfd, of_process, descriptor, 0);
    close(of_process);
    return borrowed;
}

/* Writes a part of what the call would write: one byte, or half. Returns the number of bytes; 0 if the call does not
 * write, or would not write more than that. */
static int64_t writePart(const struct seccomp_notif* notice, const struct Call* call, bool one_byte) {
    if (call->kind != DATA && call->kind != VECTOR) return 0;
    struct iovec vector = {(void*)(uintptr_t)notice->data.args[1], notice->data.args[2]};
    if (call->kind == VECTOR && readMemory(notice->pid, notice->data.args[1], &vector, sizeof vector) < 0) return 0;
    const size_t part = one_byte ? 1 : vector.iov_len / 2;
    if (vector.iov_len < 2) return 0;
    char* bytes = malloc(part);
    const int to = borrowDescriptor(notice->pid, (int)notice->data.args[0]);
    int64_t written = readMemory(notice->pid, (uint64_t)(uintptr_t)vector.iov_base, bytes, part);
    const bool has_place = strncmp(call->name, "pwrite", strlen("pwrite")) == 0;
    if (written > 0)
        written = has_place ? pwrite(to, bytes, (size_t)written, (off_t)notice->data.args[3])
                            : write(to, bytes, (size_t)written);
    if (written <= 0) {
        perror("nth_call: a part of a write");
        exit(CANNOT);
    }
    close(to);
    free(bytes);
    return written;
}

/* Decides on a call; true if the caller has been killed. */
static bool decide(const struct seccomp_notif* notice, const struct Call* call, struct seccomp_notif_resp* answer) {
    char path[PATH_MAX];
    answer->flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    const char* name = findTarget(notice, call, path);
    if (!name) return false;
    const bool is_nameless = strcmp(name, "open-nameless") == 0;
    if (is_nameless && plan.no_nameless) {
        answer->flags = 0;
        answer->error = -EOPNOTSUPP;
        return false;
    }
    fprintf(plan.log, "%s %s\n", name, path + strlen(plan.folder));
    ++plan.count;
    if (!plan.at || plan.count < plan.at || (plan.count > plan.at && !plan.goes_on)) return false;
    if (plan.kills) {
        if (plan.tears) writePart(notice, call, false);
        kill((pid_t)notice->pid, SIGKILL);
        return true;
    }
    if (plan.shortens || plan.halves) answer->val = writePart(notice, call, plan.shortens);
    const bool fails = plan.error == EIO || (call->errors & plan.errors);
    if (plan.error && fails) answer->error = -plan.error;
    if (answer->val || answer->error) answer->flags = 0;
    return false;
}

static void serve(int listener) {
    union {
        struct seccomp_notif notice;
        char room[1024]; /* future kernels may return more */
    } asked;
    union {
        struct seccomp_notif_resp answer;
        char room[1024];
    } said;
    memset(&asked, 0, sizeof asked);
    memset(&said, 0, sizeof said);
    if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &asked) != 0) return; /* killed meanwhile */
    said.answer.id = asked.notice.id;
    for (int i = 0; i < CALLS; ++i)
        if (calls[i].number == asked.notice.data.nr && decide(&asked.notice, &calls[i], &said.answer)) return;
    ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &said);
}

static bool readPlan(char** arguments) {
    static const struct {
        const char* name;
        int error, errors;
    } errors[] = {{"EIO", EIO, 0}, {"ENOSPC", ENOSPC, FULL}, {"EACCES", EACCES, DENIED}};
    char* how = arguments[3];
    plan.folder = arguments[1];
    plan.log = fopen(arguments[2], "we");
    plan.tears = strcmp(how, "tear") == 0;
    plan.kills = plan.tears || strcmp(how, "kill") == 0;
    plan.shortens = strcmp(how, "short") == 0;
    plan.halves = plan.goes_on = strcmp(how, "halve") == 0;
    plan.at = atol(arguments[4]);
    plan.no_nameless = getenv("NTH_CALL_NAMED") != NULL;
    char* plus = strchr(how, '+');
    if (plus) {
        plan.goes_on = true;
        *plus = 0;
    }
    for (size_t i = 0; i < sizeof errors / sizeof *errors; ++i)
        if (strcmp(how, errors[i].name) == 0) {
            plan.error = errors[i].error;
            plan.errors = errors[i].errors;
        }
    return plan.log && (plan.kills || plan.shortens || plan.halves || plan.error);
}

int main(int count, char** arguments) {
    int channels[2];
    if (count < 6 || !readPlan(arguments)) {
        fputs("usage: nth_call FOLDER LOG HOW N COMMAND...\n", stderr);
        return CANNOT;
    }
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channels) != 0) return CANNOT;
    const pid_t child = fork();
    if (child == 0) becomeCommand(channels[1], arguments + 5);
    close(channels[1]);
    const int listener = receiveDescriptor(channels[0]);
    if (listener < 0) return CANNOT;
    struct pollfd asked = {.fd = listener, .events = POLLIN};
    while (poll(&asked, 1, -1) >= 0 || errno == EINTR) {
        if (asked.revents & POLLIN)
            serve(listener);
        else if (asked.revents) /* no process is left */
            break;
    }
    int status;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}
