// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/byte_input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "format/base/error.h"
#include "format/os/descriptor.h"

namespace pointrt {
namespace {

[[noreturn]] void failReading(const std::string& name) {
    throw Error(ExitCode::kBadInput, name + ": " + std::strerror(errno));
}

} // namespace

ByteInput::ByteInput(std::string path) : owned_(path != "-") {
    name_ = owned_ ? std::move(path) : "standard input";
    descriptor_ = owned_ ? openFile(name_, Opening::kRead) : kStandardInput;
    if (descriptor_ < 0) failReading(name_);
}

ByteInput::~ByteInput() {
    if (owned_ && descriptor_ >= 0) closeFile(descriptor_);
}

std::size_t ByteInput::read(void* to, std::size_t bytes) {
    const std::size_t ready = std::min(bytes, peeked_.size());
    if (ready > 0) {
        std::memcpy(to, peeked_.data(), ready);
        peeked_.erase(peeked_.begin(), peeked_.begin() + static_cast<std::ptrdiff_t>(ready));
    }
    return ready + fill(static_cast<std::uint8_t*>(to) + ready, bytes - ready);
}

bool ByteInput::beginsWith(const std::string& start) {
    peeked_.resize(start.size());
    peeked_.resize(fill(peeked_.data(), peeked_.size()));
    return peeked_.size() == start.size() &&
           std::equal(start.begin(), start.end(), peeked_.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

std::size_t ByteInput::fill(void* to, std::size_t bytes) {
    std::size_t done = 0;
    while (done < bytes) {
        const std::ptrdiff_t got = readSome(descriptor_, static_cast<std::uint8_t*>(to) + done, bytes - done);
        if (got < 0) failReading(name_);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

} // namespace pointrt
