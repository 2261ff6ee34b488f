// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "format/base/printable.h"
#include "format/os/descriptor.h"
#include "format/os/pages.h"
#include "format/os/terminal.h"
#include "preprocess/ingest/gzip.h"

namespace pointrt {
namespace {

std::string systemReason(int error) {
    if (error == ENOENT) return "no such file";
    if (error == EACCES) return "no permission to read it";
    return std::strerror(error);
}

bool mapBytes(int descriptor, std::size_t size, InputFile& input) {
    const void* const address = mapFile(descriptor, size);
    if (!address) return false;
    input.owner = std::shared_ptr<const void>(address, [size](const void* at) { unmapFile(at, size); });
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
        const std::ptrdiff_t got = readSome(descriptor, text->data() + used, kBlock);
        text->resize(used + static_cast<std::size_t>(std::max<std::ptrdiff_t>(got, 0)));
        if (got == 0) break;
        if (got < 0) refuse(input, systemReason(errno));
    }
    input.bytes = *text;
    input.owner = std::move(text);
}

/// Refuses devices, which have no end, except terminals, where the user ends the input.
bool isReadable(int descriptor, FileKind kind, NamedBy named_by) {
    if (kind == FileKind::kRegular) return true;
    if (named_by == NamedBy::kFile) return false;
    return kind == FileKind::kPipe || (kind == FileKind::kCharacters && isTerminal(descriptor));
}

void loadBytes(const Descriptor& file, NamedBy named_by, InputFile& input) {
    const auto status = file.isOpen() ? statusOf(file.number()) : std::nullopt;
    if (!status) refuse(input, systemReason(errno));
    if (status->kind == FileKind::kFolder) refuse(input, "is a directory");
    if (!isReadable(file.number(), status->kind, named_by)) refuse(input, "is not a regular file");
    const bool mapped = status->kind == FileKind::kRegular && status->bytes > 0 &&
                        mapBytes(file.number(), static_cast<std::size_t>(status->bytes), input);
    if (!mapped) readStream(file.number(), input);
}

} // namespace

InputFile openInputFile(const std::string& path, NamedBy named_by) {
    InputFile input;
    const bool standard_input = path == "-" && named_by == NamedBy::kUser;
    input.name = standard_input ? "standard input" : path;
    // Opening a pipe waits for a writer; only a pipe named by the user can be expected to have one.
    const Opening opening = named_by == NamedBy::kFile ? Opening::kReadNoWait : Opening::kRead;
    const Descriptor file(standard_input ? kStandardInput : openFile(path, opening), !standard_input);
    loadBytes(file, named_by, input);
    if (isGzip(input.bytes)) unpackGzip(input);
    if (input.bytes.empty()) refuse(input, "the file is empty");
    return input;
}

void releasePages(const InputFile& input, std::uint64_t bytes) {
    if (input.mapped) dropPages(input.bytes.data(), std::min<std::uint64_t>(bytes, input.bytes.size()));
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
