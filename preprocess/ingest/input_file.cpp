// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "format/base/printable.h"
#include "preprocess/ingest/gzip.h"

namespace pointrt {
namespace {

struct Descriptor {
    int number;
    bool owned;
    ~Descriptor() {
        if (owned && number >= 0) ::close(number);
    }
};

std::string systemReason(int error) {
    if (error == ENOENT) return "no such file";
    if (error == EACCES) return "no permission to read it";
    return std::strerror(error);
}

bool mapFile(int descriptor, std::size_t size, InputFile& input) {
    void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address == MAP_FAILED) return false;
    input.owner =
        std::shared_ptr<const void>(address, [size](const void* at) { ::munmap(const_cast<void*>(at), size); });
    input.bytes = {static_cast<const char*>(address), size};
    input.mapped = true;
    return true;
}

void readStream(int descriptor, InputFile& input) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    auto text = std::make_shared<std::string>();
    for (;;) {
        const std::size_t used = text->size();
        text->resize(used + kBlock);
        const ssize_t got = ::read(descriptor, text->data() + used, kBlock);
        text->resize(used + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        if (got == 0) break;
        if (got < 0 && errno != EINTR) refuse(input, systemReason(errno));
    }
    input.bytes = *text;
    input.owner = std::move(text);
}

/// Refuses devices, which have no end, but for terminals, whose user ends the input.
bool isReadable(int descriptor, mode_t mode, NamedBy named_by) {
    if (S_ISREG(mode)) return true;
    if (named_by == NamedBy::kFile) return false;
    return S_ISFIFO(mode) || S_ISSOCK(mode) || (S_ISCHR(mode) && ::isatty(descriptor) == 1);
}

void loadBytes(const Descriptor& file, NamedBy named_by, InputFile& input) {
    struct stat status {};
    if (file.number < 0 || ::fstat(file.number, &status) != 0) refuse(input, systemReason(errno));
    if (S_ISDIR(status.st_mode)) refuse(input, "is a directory");
    if (!isReadable(file.number, status.st_mode, named_by)) refuse(input, "is not a regular file");
    const bool mapped = S_ISREG(status.st_mode) && status.st_size > 0 &&
                        mapFile(file.number, static_cast<std::size_t>(status.st_size), input);
    if (!mapped) readStream(file.number, input);
}

} // namespace

InputFile openInputFile(const std::string& path, NamedBy named_by) {
    InputFile input;
    const bool standard_input = path == "-" && named_by == NamedBy::kUser;
    input.name = standard_input ? "standard input" : path;
    // Opening a pipe waits for a writer; only a pipe named by the user can be expected to have one.
    const int flags = O_RDONLY | O_CLOEXEC | (named_by == NamedBy::kFile ? O_NONBLOCK : 0);
    const Descriptor file{standard_input ? STDIN_FILENO : ::open(path.c_str(), flags), !standard_input};
    loadBytes(file, named_by, input);
    if (isGzip(input.bytes)) unpackGzip(input);
    if (input.bytes.empty()) refuse(input, "the file is empty");
    return input;
}

void releasePages(const InputFile& input, std::uint64_t bytes) {
    if (!input.mapped) return;
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t whole_pages = std::min<std::uint64_t>(bytes, input.bytes.size()) / page * page;
    if (whole_pages > 0) ::madvise(const_cast<char*>(input.bytes.data()), whole_pages, MADV_DONTNEED);
}

void refuse(const InputFile& input, const std::string& reason) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}", input.name, reason));
}

void refuseAt(const InputFile& input, const std::string& place, const std::string& reason) {
    throw Error(ExitCode::kBadInput, fmt::format("{}:{}: {}", input.name, place, reason));
}

void refuseLine(const InputFile& input, const char* at, const std::string& reason) {
    const auto line = 1 + std::count(input.begin(), at, '\n');
    refuseAt(input, std::to_string(line), reason);
}

std::string inQuotes(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    return "'" + printable(text, kLongest) + "'";
}

void addQuoted(std::string_view name, std::string& list) {
    constexpr std::size_t kLine = 80;
    if (list.size() < kLine) list += (list.empty() ? "" : ", ") + inQuotes(name);
}

} // namespace pointrt
