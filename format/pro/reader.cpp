// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "format/os/mapped_file.h"
#include "format/pro/attributes.h"
#include "format/pro/validate.h"

using namespace pointrt::format;

struct pro_file {
    MappedFile mapped; // unused by pro_open_memory
    std::span<const std::byte> bytes;
    Parsed parsed;
};

namespace {

void keepFinding(const pro_message* finding, void* user) { *static_cast<pro_message*>(user) = *finding; }

pro_result resultOf(std::uint32_t finding) {
    const auto number = static_cast<Finding>(finding);
    const bool newer = number == Finding::kMajorVersion || number == Finding::kRequiredUnknown;
    return newer ? PRO_UNSUPPORTED : PRO_INVALID;
}

/// Validates file->bytes.
pro_result parse(pro_file& file, std::uint32_t open_flags, pro_message* message) {
    pro_message first{};
    Findings findings(keepFinding, &first, true);
    const Level level = open_flags & PRO_OPEN_TRACE ? Level::kTrace : Level::kOpen;
    file.parsed = validate(file.bytes, level, !(open_flags & PRO_OPEN_SKIP_CHECKSUMS), findings);
    if (findings.count() == 0) return PRO_OK;
    if (message) *message = first;
    return resultOf(first.finding);
}

bool aligned(const void* data) { return reinterpret_cast<std::uintptr_t>(data) % alignof(std::uint64_t) == 0; }

pro_result badArgument(pro_message* message, const char* text) {
    setMessage(message, 0, "%s", text);
    return PRO_BAD_ARGUMENT;
}

pro_result map(MappedFile& mapped, const char* path, pro_message* message) {
    if (mapped.map(path)) return PRO_OK;
    setMessage(message, 0, "%s", mapped.error().c_str());
    return mapped.outOfMemory() ? PRO_OUT_OF_MEMORY : PRO_CANNOT_READ;
}

/// Turns exceptions into results. The only one that the body throws is std::bad_alloc.
template <typename Body>
pro_result guarded(pro_message* message, Body&& body) noexcept {
    try {
        setMessage(message, 0, "%s", "");
        return body();
    } catch (const std::exception&) {
        setMessage(message, 0, "out of memory");
        return PRO_OUT_OF_MEMORY;
    }
}

} // namespace

pro_result pro_open(const char* path, uint32_t open_flags, pro_file** file, pro_message* message) {
    return guarded(message, [&]() -> pro_result {
        if (!path || !file) return badArgument(message, "pro_open: null path or file");
        *file = nullptr;
        auto opened = std::make_unique<pro_file>();
        if (const pro_result result = map(opened->mapped, path, message)) return result;
        opened->bytes = opened->mapped.bytes();
        if (const pro_result result = parse(*opened, open_flags, message)) return result;
        if (open_flags & PRO_OPEN_TRACE) opened->mapped.dropPages(); // rays read less than half of a scan
        *file = opened.release();
        return PRO_OK;
    });
}

pro_result pro_open_memory(const void* data, size_t bytes, uint32_t open_flags, pro_file** file, pro_message* message) {
    return guarded(message, [&]() -> pro_result {
        if (!data || !file) return badArgument(message, "pro_open_memory: null data or file");
        *file = nullptr;
        if (!aligned(data)) return badArgument(message, "pro_open_memory: data is not 8-byte aligned");
        auto opened = std::make_unique<pro_file>();
        opened->bytes = {static_cast<const std::byte*>(data), bytes};
        if (const pro_result result = parse(*opened, open_flags, message)) return result;
        *file = opened.release();
        return PRO_OK;
    });
}

void pro_close(pro_file* file) { delete file; }

void pro_get_info(const pro_file* file, pro_info* info) { *info = file->parsed.info; }

void pro_get_view(const pro_file* file, pro_view* view) { *view = file->parsed.content.view; }

int pro_get_index(const pro_file* file, pro_index* index) {
    *index = file->parsed.content.index;
    return file->parsed.indexed ? 1 : 0;
}

int pro_get_gaussians(const pro_file* file, pro_gaussians* gaussians) {
    *gaussians = file->parsed.content.gaussians;
    return isComplete(*gaussians) ? 1 : 0;
}

void pro_get_world(const pro_file* file, pro_world* world) { *world = file->parsed.content.world; }

void pro_get_sampling(const pro_file* file, pro_sampling* sampling) { *sampling = file->parsed.content.sampling; }

uint32_t pro_attribute_count(const pro_file* file) {
    return static_cast<uint32_t>(file->parsed.content.attribute_count);
}

int pro_get_attribute(const pro_file* file, uint32_t number, pro_attribute* attribute) {
    const bool there = number < pro_attribute_count(file);
    *attribute = there ? loadAttribute(file->parsed.content, number) : pro_attribute{};
    return there ? 1 : 0;
}

int pro_find_attribute(const pro_file* file, const char* name, pro_attribute* attribute) {
    for (uint32_t i = 0; pro_get_attribute(file, i, attribute) == 1; ++i)
        if (std::strcmp(attribute->name, name) == 0) return 1;
    return 0;
}

const void* pro_bytes(const pro_file* file, size_t* bytes) {
    if (bytes) *bytes = file->bytes.size();
    return file->bytes.data();
}

size_t pro_verify_memory(const void* data, size_t bytes, pro_report report, void* user) {
    Findings findings(report, user, false);
    try {
        validate({static_cast<const std::byte*>(data), bytes}, Level::kVerify, true, findings);
    } catch (const std::exception&) {
        findings.add(Finding::kOutOfMemory, "not enough memory to run every check");
    }
    return findings.count();
}

pro_result pro_verify(const char* path, pro_report report, void* user, size_t* findings, pro_message* message) {
    return guarded(message, [&]() -> pro_result {
        if (!path || !findings) return badArgument(message, "pro_verify: null path or findings");
        *findings = 0;
        MappedFile mapped;
        if (const pro_result result = map(mapped, path, message)) return result;
        Findings sink(report, user, false);
        validate(mapped.bytes(), Level::kVerify, true, sink);
        *findings = sink.count();
        return PRO_OK;
    });
}

const char* pro_result_name(pro_result result) {
    switch (result) {
    case PRO_OK:
        return "done";
    case PRO_CANNOT_READ:
        return "cannot read the file";
    case PRO_INVALID:
        return "not a valid .pro file";
    case PRO_UNSUPPORTED:
        return "needs a newer version of pointrt";
    case PRO_CANNOT_WRITE:
        return "cannot write the file";
    case PRO_OUT_OF_MEMORY:
        return "out of memory";
    case PRO_BAD_ARGUMENT:
        return "invalid argument";
    }
    return "unknown result";
}
