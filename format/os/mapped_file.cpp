// SPDX-License-Identifier: Apache-2.0
#include "format/os/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace pointrt::format {

MappedFile::~MappedFile() {
    if (data_) munmap(const_cast<std::byte*>(data_), size_);
}

bool MappedFile::fail(const std::string& reason) {
    error_ = reason;
    return false;
}

bool MappedFile::fail(int error) {
    out_of_memory_ = error == ENOMEM;
    return fail(std::generic_category().message(error));
}

void MappedFile::dropPages() const { madvise(const_cast<std::byte*>(data_), size_, MADV_DONTNEED); }

bool MappedFile::map(const char* path) {
    // O_NONBLOCK: opening a named pipe must not wait for a writer
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return fail(errno);
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
    if (stat_error != 0) return fail(stat_error);
    if (!S_ISREG(status.st_mode)) return fail("not a regular file");
    if (status.st_size == 0) return fail("the file is empty");
    if (!usable) return fail(EFBIG);
    if (mapped == MAP_FAILED) return fail(map_error);
    data_ = static_cast<const std::byte*>(mapped);
    size_ = static_cast<std::size_t>(status.st_size);
    madvise(mapped, size_, MADV_WILLNEED); // validation reads it all; failure only costs time
    return true;
}

} // namespace pointrt::format
