// SPDX-License-Identifier: Apache-2.0
#include "format/src/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

#include "format/src/findings.h"

namespace pointrt::format {

namespace {

pro_result cannotRead(pro_message* message, const char* reason) {
    setMessage(message, 0, "%s", reason);
    return PRO_CANNOT_READ;
}

pro_result cannotRead(pro_message* message, int error) {
    return cannotRead(message, std::generic_category().message(error).c_str());
}

} // namespace

MappedFile::~MappedFile() {
    if (data_) munmap(const_cast<std::byte*>(data_), size_);
}

void MappedFile::letGo() const { madvise(const_cast<std::byte*>(data_), size_, MADV_DONTNEED); }

pro_result MappedFile::map(const char* path, pro_message* message) {
    // O_NONBLOCK: a named pipe must be refused, not waited for
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return cannotRead(message, errno);
    struct stat status;
    const int stat_error = fstat(descriptor, &status) == 0 ? 0 : errno;
    void* mapped = MAP_FAILED;
    int map_error = 0;
    const bool usable = stat_error == 0 && S_ISREG(status.st_mode) && status.st_size > 0 &&
                        static_cast<std::uint64_t>(status.st_size) <= SIZE_MAX;
    if (usable) {
        mapped = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
        if (mapped == MAP_FAILED) map_error = errno;
    }
    close(descriptor);
    if (stat_error != 0) return cannotRead(message, stat_error);
    if (!S_ISREG(status.st_mode)) return cannotRead(message, "not a regular file");
    if (status.st_size == 0) return cannotRead(message, "the file is empty");
    if (!usable) return cannotRead(message, EFBIG);
    if (mapped == MAP_FAILED) return cannotRead(message, map_error);
    data_ = static_cast<const std::byte*>(mapped);
    size_ = static_cast<std::size_t>(status.st_size);
    madvise(mapped, size_, MADV_WILLNEED); // validation reads all of it; a refusal only costs time
    return PRO_OK;
}

} // namespace pointrt::format
