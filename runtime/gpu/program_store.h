// SPDX-License-Identifier: Apache-2.0
// The programs of a device: built once, shared by all who ask for the same, and kept a while for those who ask again.
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

/// What makes two programs one: the code, and the values of the constants that it declares, by their numbers.
struct ProgramKey {
    std::string name;
    std::uint64_t code_bytes = 0, code_hash = 0; ///< XXH3
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;
    auto operator<=>(const ProgramKey&) const = default;
};

/// Threads may use it at the same time.
class ProgramStore {
public:
    /// Unused programs that are kept: a scene has up to twenty, so those of the last three.
    static constexpr std::size_t kUnusedKept = 64;

    /// The program with that key, from build where there is none. Two that ask at once may both build; one is kept.
    Program take(Device& device, const ProgramKey& key, const std::function<Program()>& build);
    /// One user less; frees what has been unused for longest where more than kUnusedKept are.
    void giveBack(Device& device, const Program& program);
    /// Frees all, in use or not.
    void clear(Device& device);
    std::size_t size();

private:
    struct Entry {
        Program program;
        std::size_t users = 0;
        std::list<ProgramKey>::iterator unused; ///< its place in unused_, where it has no users
    };
    Program use(std::map<ProgramKey, Entry>::iterator entry);
    void freeOldest(Device& device);

    std::mutex mutex_;
    std::map<ProgramKey, Entry> entries_;
    std::map<VkPipeline, ProgramKey> keys_;
    std::list<ProgramKey> unused_; ///< the longest unused first
};

/// Frees the program's objects at once, whoever uses them.
void freeProgram(Device& device, Program& program);

} // namespace pointrt
