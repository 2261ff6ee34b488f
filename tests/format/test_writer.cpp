// SPDX-License-Identifier: Apache-2.0
// Failed writes leave nothing behind and give a reason.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_scene.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

OpenResult tryWrite(const std::string& path, Scene scene = tinyScene()) {
    OpenResult written{};
    const pro_view view = scene.view();
    written.result = pro_write(path.c_str(), &scene.info, &view, &written.message);
    return written;
}

bool mentions(const OpenResult& result, const char* words) {
    return std::string(result.message.text).find(words) != std::string::npos;
}

TEST(Writer, NoFolder) {
    const TemporaryFolder folder;
    const OpenResult written = tryWrite(folder.file("missing/a.pro"));
    EXPECT_EQ(written.result, PRO_CANNOT_WRITE);
    EXPECT_TRUE(mentions(written, "folder")) << written.message.text;
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Writer, ReplacesAFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    writeBytes(folder.file("a.pro"), Bytes(5));
    EXPECT_EQ(tryWrite(folder.file("a.pro")).result, PRO_OK);
    EXPECT_EQ(folder.entries(), 1u);
    EXPECT_EQ(ProFile(folder.file("a.pro")).info().splat_count, 5u);
}

TEST(Writer, AnOpenFileKeepsItsContent) {
    const TemporaryFolder folder;
    ASSERT_EQ(tryWrite(folder.file("a.pro")).result, PRO_OK);
    const ProFile before(folder.file("a.pro"));
    Scene other = tinyScene();
    other.metadata = "{}";
    ASSERT_EQ(tryWrite(folder.file("a.pro"), other).result, PRO_OK);
    EXPECT_EQ(before.metadata(), tinyScene().metadata);
    EXPECT_EQ(ProFile(folder.file("a.pro")).metadata(), "{}");
}

TEST(Writer, FoldersAndDevicesAreNotReplaced) {
    const TemporaryFolder folder;
    EXPECT_EQ(tryWrite(folder.path.string()).result, PRO_CANNOT_WRITE);
    EXPECT_EQ(tryWrite("/dev/null").result, PRO_CANNOT_WRITE);
    struct stat status;
    ASSERT_EQ(stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(Writer, RespectsTheUmask) {
    const TemporaryFolder folder;
    const mode_t before = umask(027);
    EXPECT_EQ(tryWrite(folder.file("a.pro")).result, PRO_OK);
    umask(before);
    struct stat status;
    ASSERT_EQ(stat((folder.file("a.pro")).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(Writer, ContentThatWouldNotOpenIsRefused) {
    const TemporaryFolder folder;
    const auto expectRefused = [&](Scene scene, std::uint32_t finding) {
        const OpenResult written = tryWrite(folder.file("a.pro"), std::move(scene));
        EXPECT_EQ(written.result, PRO_BAD_ARGUMENT);
        EXPECT_EQ(written.message.finding, finding) << written.message.text;
        EXPECT_EQ(folder.entries(), 0u);
    };
    Scene scene = tinyScene();
    scene.refs[0] = 5;
    expectRefused(scene, 4006);
    scene = tinyScene();
    scene.info.scale = 0;
    expectRefused(scene, 1013);
    scene = tinyScene();
    scene.info.flags = 64;
    expectRefused(scene, 1007);
    scene = tinyScene();
    scene.metadata = "\xFF";
    expectRefused(scene, 8001);
    EXPECT_EQ(pro_write("a.pro", nullptr, nullptr, nullptr), PRO_BAD_ARGUMENT);
}

/// Runs body with a file system of 64 KiB in a child process with its own mount namespace, so that nothing outlives the
/// test. Returns the result of body, or 77 if mounting is not allowed.
template <typename Body>
int onTinyDisk(const TemporaryFolder& folder, Body&& body) {
    const pid_t child = fork();
    if (child == 0) {
        if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
            mount("tmpfs", folder.path.c_str(), "tmpfs", 0, "size=64k") != 0)
            _exit(77);
        _exit(body());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Writer, FullDisk) {
    const TemporaryFolder folder;
    const int outcome = onTinyDisk(folder, [&] {
        Scene large = tinyScene();
        large.metadata = std::string(200000, ' ');
        if (tryWrite(folder.file("small.pro")).result != PRO_OK) return 1;
        const OpenResult written = tryWrite(folder.file("large.pro"), large);
        if (written.result != PRO_CANNOT_WRITE) return 2;
        if (!mentions(written, "full")) return 3;
        if (folder.entries() != 1) return 4;
        return 0;
    });
    if (outcome == 77) GTEST_SKIP() << "NOT TESTED: mounting a full disk needs root";
    EXPECT_EQ(outcome, 0);
}

TEST(Writer, FileSizeLimit) {
    // like a full disk, but without root privileges: the kernel stops the file at the limit
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit = {20000, 20000};
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &limit);
        const OpenResult written = tryWrite(folder.file("a.pro"));
        _exit(written.result == PRO_CANNOT_WRITE && mentions(written, "too large") ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Writer, KilledLeavesNothing) {
    // the signal for the limit kills the writer half way; only an unnamed file disappears in that case
    const TemporaryFolder folder;
    const int probe = open(folder.path.c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (probe < 0) GTEST_SKIP() << "NOT TESTED: this file system has no unnamed files";
    close(probe);
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit = {20000, 20000}, no_core = {0, 0};
        setrlimit(RLIMIT_FSIZE, &limit);
        setrlimit(RLIMIT_CORE, &no_core);
        signal(SIGXFSZ, SIG_DFL);
        tryWrite(folder.file("a.pro"));
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
