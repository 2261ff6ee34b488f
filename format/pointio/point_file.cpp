// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/point_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "format/base/error.h"

namespace pointrt {

PointFile::PointFile(std::string path, format::Existing existing) : name_(std::move(path)) {
    if (name_ == "-") {
        name_ = "standard output";
        return;
    }
    file_ = std::make_unique<format::AtomicFile>();
    require(file_->open(name_, existing));
}

void PointFile::append(const void* data, std::size_t bytes) {
    errno = 0;
    require(file_ ? file_->write(data, bytes) : std::fwrite(data, 1, bytes, stdout) == bytes);
}

void PointFile::overwrite(std::uint64_t offset, const void* data, std::size_t bytes) {
    require(file_->overwrite(offset, data, bytes));
}

void PointFile::commit() {
    errno = 0;
    require(file_ ? file_->commit() : std::fflush(stdout) == 0);
}

void PointFile::require(bool done) const {
    if (done) return;
    const std::string reason = file_ ? file_->error() : std::strerror(errno);
    throw Error(ExitCode::kCannotWrite,
                name_ + ": " + reason + (file_ && file_->nameIsTaken() ? "; --force overwrites it" : ""));
}

} // namespace pointrt
