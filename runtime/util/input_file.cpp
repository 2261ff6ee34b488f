// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/input_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "format/base/error.h"

namespace pointrt {

std::vector<std::uint8_t> readFileBytes(const std::string& path, std::size_t padding) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(path, failure);
    if (failure) throw Error{ExitCode::kBadInput, path + ": " + failure.message()};
    std::vector<std::uint8_t> bytes(size + padding);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!file) throw Error{ExitCode::kBadInput, path + ": " + (errno ? std::strerror(errno) : "cannot be read")};
    return bytes;
}

} // namespace pointrt
