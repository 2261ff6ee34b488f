// SPDX-License-Identifier: Apache-2.0
// What a fuzz target is: a function that reads hostile bytes. libFuzzer calls it a million times, the ordinary tests
// once for each file of corpus/ and findings/.
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

/// Called once for each target of a program, before main.
struct Registered {
    Registered(const char* name, void (*run)(Input input));
};

/// The target of that name; null where this program has none.
const Target* findTarget(std::string_view name);
/// The only one of a program that libFuzzer runs.
const Target& onlyTarget();

/// Calls read. What readers of hostile files may do is return, or throw Error with the code of bad input and one line
/// that begins with the name of what is read. Anything else ends the process, which is a finding.
/// @param name "": messages begin as they like
void expectReadOrRefused(const std::string& name, const std::function<void()>& read);

inline std::string_view textOf(Input input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

/// Bytes as a file that lies in memory, for readers that take a path.
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

/// An input of two files: the first one's bytes, its length in two bytes ahead of them (the first the lower), then the
/// second's.
struct TwoFiles {
    Input first, second;
};
TwoFiles splitInTwo(Input input);

} // namespace pointrt::fuzz

/// POINTRT_FUZZ_TARGET(name) { reads input; }. The second macro is there for a name that is a macro itself.
#define POINTRT_FUZZ_TARGET(name) POINTRT_FUZZ_TARGET_NAMED(name)
#define POINTRT_FUZZ_TARGET_NAMED(name)                                                                                \
    static void run_##name(pointrt::fuzz::Input input);                                                                \
    static const pointrt::fuzz::Registered registered_##name(#name, run_##name);                                       \
    static void run_##name(pointrt::fuzz::Input input)
