// SPDX-License-Identifier: Apache-2.0
// The programs of a device: each is built once, shared by all its users, and kept for a while after the last one.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "runtime/gpu/program.h"

namespace pointrt {

/// Identifies a program: its code, and the numbers and values of the constants that the code declares.
struct ProgramKey {
    std::string name;
    std::uint64_t code_bytes = 0, code_hash = 0; ///< XXH3
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;
    auto operator<=>(const ProgramKey&) const = default;
};

/// Thread-safe.
class ProgramStore {
public:
    /// Limit for unused programs that are kept: a scene has up to twenty, so this keeps those of the last three scenes.
    static constexpr std::size_t kUnusedKept = 64;

    /// The program with this key, built on first use. If two threads build the same program at once, one copy is kept.
    Program take(Device& device, const ProgramKey& key, const std::function<Program()>& build);
    /// Ends one use of a program. If more than kUnusedKept are then unused, frees the least recently used of them.
    void release(Device& device, const Program& program);
    /// Frees all programs, used or not.
    void clear(Device& device);
    std::size_t size();

private:
    struct Entry {
        Program program;
        std::size_t users = 0;
        std::list<ProgramKey>::iterator unused; ///< its position in unused_ if it has no users
    };
    Program use(std::map<ProgramKey, Entry>::iterator entry);
    void freeOldest(Device& device);

    std::mutex mutex_;
    std::map<ProgramKey, Entry> entries_;
    std::map<VkPipeline, ProgramKey> keys_;
    std::list<ProgramKey> unused_; ///< least recently used first
};

/// Frees the program's Vulkan objects, used or not.
void freeProgram(Device& device, Program& program);

} // namespace pointrt
