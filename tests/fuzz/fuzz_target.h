// SPDX-License-Identifier: Apache-2.0
// A fuzz target is a function that reads hostile bytes. libFuzzer calls it millions of times, the ordinary tests once
// for each file in corpus/ and findings/.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace pointrt::fuzz {

using Input = std::span<const std::uint8_t>;

struct Target {
    const char* name;
    void (*run)(Input input);
};

/// Registers a target before main.
struct Registered {
    Registered(const char* name, void (*run)(Input input));
};

/// The target of this name, or null.
const Target* findTarget(std::string_view name);
/// The single target of a libFuzzer program.
const Target& onlyTarget();

/// Calls read, which may return, or throw Error with kBadInput and a one-line message that starts with the name of the
/// input. Aborts otherwise, which is a finding.
/// @param name "": messages may start with anything
void expectReadOrRefused(const std::string& name, const std::function<void()>& read);

inline std::string_view textOf(Input input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

/// Bytes as a file in memory, for readers that take a path.
class MemoryFile {
public:
    explicit MemoryFile(Input bytes);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    const std::string& path() const { return path_; }

private:
    int descriptor_;
    std::string path_;
};

/// An input of two files: the length of the first in two bytes (little-endian), its bytes, then the second's.
struct TwoFiles {
    Input first, second;
};
TwoFiles splitInTwo(Input input);

} // namespace pointrt::fuzz

/// POINTRT_FUZZ_TARGET(name) { reads input; }. The second macro expands a name that is a macro itself.
#define POINTRT_FUZZ_TARGET(name) POINTRT_FUZZ_TARGET_NAMED(name)
#define POINTRT_FUZZ_TARGET_NAMED(name)                                                                                \
    static void run_##name(pointrt::fuzz::Input input);                                                                \
    static const pointrt::fuzz::Registered registered_##name(#name, run_##name);                                       \
    static void run_##name(pointrt::fuzz::Input input)
