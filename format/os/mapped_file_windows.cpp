// SPDX-License-Identifier: Apache-2.0
#include "format/os/mapped_file.h"
#include "format/os/wide_path_windows.h"

namespace pointrt::format {

MappedFile::~MappedFile() {
    if (data_) UnmapViewOfFile(data_);
}

bool MappedFile::fail(const std::string& reason) {
    error_ = reason;
    return false;
}

bool MappedFile::fail(int error) {
    out_of_memory_ = error == ERROR_NOT_ENOUGH_MEMORY || error == ERROR_COMMITMENT_LIMIT;
    return fail(windowsReason(static_cast<DWORD>(error)));
}

void MappedFile::dropPages() const {
    VirtualUnlock(const_cast<std::byte*>(data_), size_);
} // for pages that are not locked, this removes them from the working set

bool MappedFile::map(const char* path) {
    const DWORD sharing = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE file = CreateFileW(widePath(path).c_str(), GENERIC_READ, sharing, nullptr, OPEN_EXISTING,
                                    FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) return fail(static_cast<int>(GetLastError()));
    LARGE_INTEGER bytes{};
    const bool regular = GetFileType(file) == FILE_TYPE_DISK && GetFileSizeEx(file, &bytes) != 0;
    HANDLE mapping = nullptr;
    if (regular && bytes.QuadPart > 0) mapping = CreateFileMappingW(file, nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (mapping) data_ = static_cast<const std::byte*>(MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0));
    const auto error = static_cast<int>(GetLastError());
    if (mapping) CloseHandle(mapping); // the view keeps the mapping alive
    CloseHandle(file);
    if (!regular) return fail("not a regular file");
    if (bytes.QuadPart == 0) return fail("the file is empty");
    if (!data_) return fail(error);
    size_ = static_cast<std::size_t>(bytes.QuadPart);
    return true;
}

} // namespace pointrt::format
