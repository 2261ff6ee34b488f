// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "format/base/error.h"
#include "format/os/descriptor.h"

namespace pointrt {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error{ExitCode::kBadInput, path + ": " + reason};
}

struct OpenFile {
    const std::string& path;
    Descriptor descriptor;
    std::size_t size = 0;

    explicit OpenFile(const std::string& name) : path(name), descriptor(openFile(name, Opening::kReadNoWait)) {
        if (!descriptor.isOpen()) fail(path, std::strerror(errno));
    }

    void measure() {
        const auto status = statusOf(descriptor.number());
        if (!status) fail(path, std::strerror(errno));
        if (status->kind == FileKind::kFolder) fail(path, std::strerror(EISDIR));
        if (status->kind != FileKind::kRegular) fail(path, "not a regular file");
        size = static_cast<std::size_t>(status->bytes);
    }

    void fill(std::uint8_t* bytes, std::size_t count) const {
        for (std::size_t done = 0; done < count;) {
            const std::ptrdiff_t got = readSome(descriptor.number(), bytes + done, count - done);
            if (got <= 0) fail(path, got < 0 ? std::strerror(errno) : "the file was truncated while it was read");
            done += static_cast<std::size_t>(got);
        }
    }
};

} // namespace

std::vector<std::uint8_t> readFileBytes(const std::string& path, std::size_t padding) {
    OpenFile file(path);
    file.measure();
    std::vector<std::uint8_t> bytes(file.size + padding);
    file.fill(bytes.data(), file.size);
    return bytes;
}

std::vector<std::uint8_t> readFileStart(const std::string& path, std::size_t most) {
    OpenFile file(path);
    file.measure();
    std::vector<std::uint8_t> bytes(std::min(file.size, most));
    file.fill(bytes.data(), bytes.size());
    return bytes;
}

} // namespace pointrt
