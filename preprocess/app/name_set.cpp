// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/name_set.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "format/base/error.h"
#include "format/os/folder.h"
#include "format/os/swap_names.h"
#include "format/set/set_words.h"
#include "format/set/tile_set.h"
#include "preprocess/tiles/checksum.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// A mark file that exists from just before the set gets its name until the work folder is clean. Its name has the
/// checksum of set.json, which covers all tiles: so it distinguishes the finished set from an older one that it is to
/// replace.
std::string namedMark(const std::string& work, const std::string& set) {
    std::ifstream stream(setFileOf(set), std::ios::binary);
    const std::string json{std::istreambuf_iterator<char>(stream), {}};
    return work + "/named-" + checksumWord(XXH3_64bits(json.data(), json.size()));
}

std::string replacedFolder(const std::string& work) { return work + "/replaced"; }

/// If something cannot be deleted, the mark stays too.
void clear(const std::string& work, const std::string& mark, bool keep_work) {
    std::error_code failure;
    const std::vector<std::string> paths = listFolder(work, failure);
    for (const std::string& path : paths) {
        const bool is_of_set = path == finishedFolder(work) || path == replacedFolder(work);
        if (path != mark && (is_of_set || !keep_work)) removeAll(path, failure);
        if (failure) return;
    }
    fs::remove(mark, failure);
    if (!keep_work) fs::remove(work, failure);
}

/// For file systems that cannot exchange names; for a moment neither set has the name.
bool moveAway(const std::string& finished, const std::string& output, const std::string& replaced) {
    std::error_code failure;
    removeAll(replaced, failure);
    if (!renameFolder(output, replaced)) return false;
    if (renameFolder(finished, output)) return true;
    const int reason = errno;
    renameFolder(replaced, output);
    errno = reason;
    return false;
}

bool rename(const std::string& finished, const std::string& output, const std::string& replaced) {
    if (renameFolder(finished, output)) return true;
    if (errno != ENOTEMPTY && errno != EEXIST && errno != ENOTDIR) return false;
    if (swapNames(finished, output)) return true;
    return (errno == EINVAL || errno == ENOSYS) && moveAway(finished, output, replaced);
}

} // namespace

void nameSet(const SetPlan& plan, bool keep_work) {
    const std::string finished = finishedFolder(plan.work), mark = namedMark(plan.work, finished);
    writeMark(mark);
    if (!rename(finished, plan.output, replacedFolder(plan.work)))
        throw Error(ExitCode::kCannotWrite, plan.output + ": " + std::strerror(errno));
    clear(plan.work, mark, keep_work);
}

void clearNamed(const std::string& output, const std::string& work, bool keep_work) {
    const std::string mark = namedMark(work, output);
    std::error_code failure;
    if (fs::exists(mark, failure)) clear(work, mark, keep_work);
    if (fs::exists(output, failure)) fs::remove(work, failure); // only if empty
}

} // namespace pointrt
