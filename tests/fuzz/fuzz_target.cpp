// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzz_target.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "format/base/error.h"

namespace pointrt::fuzz {
namespace {

std::vector<Target>& targets() {
    static std::vector<Target> all;
    return all;
}

[[noreturn]] void end(const char* why, const std::string& text) {
    std::fprintf(stderr, "%s: %s\n", why, text.c_str());
    std::abort();
}

/// Messages go to terminals, so they must not have control characters.
bool isOneLine(std::string_view message) {
    return std::none_of(message.begin(), message.end(),
                        [](unsigned char letter) { return letter < ' ' || letter == 127; });
}

} // namespace

Registered::Registered(const char* name, void (*run)(Input input)) { targets().push_back({name, run}); }

const Target* findTarget(std::string_view name) {
    for (const Target& each : targets())
        if (name == each.name) return &each;
    return nullptr;
}

const Target& onlyTarget() {
    if (targets().size() != 1) end("a program for libFuzzer has one target", std::to_string(targets().size()));
    return targets().front();
}

void expectReadOrRefused(const std::string& name, const std::function<void()>& read) {
    try {
        read();
    } catch (const Error& error) {
        const std::string message = error.what();
        if (message.find("this build has no ") != std::string::npos) return; // LAZ and E57 in builds without Rust
        if (error.code != ExitCode::kBadInput) end("not refused as bad input", message);
        if (!isOneLine(message)) end("more than a line", message);
        if (!message.starts_with(name)) end("does not say which file", message);
    } catch (const std::exception& error) {
        end("neither read nor refused", error.what());
    }
}

MemoryFile::MemoryFile(Input bytes)
    : descriptor_(memfd_create("input", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {
    const bool written = descriptor_ >= 0 && write(descriptor_, bytes.data(), bytes.size()) == ssize_t(bytes.size());
    if (!written) end("no memory for", "a file");
}

MemoryFile::~MemoryFile() { close(descriptor_); }

TwoFiles splitInTwo(Input input) {
    if (input.size() < 2) return {};
    const Input bytes = input.subspan(2);
    const std::size_t length = std::min<std::size_t>(bytes.size(), input[0] | input[1] << 8);
    return {bytes.first(length), bytes.subspan(length)};
}

} // namespace pointrt::fuzz
