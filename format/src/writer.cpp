// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <exception>
#include <vector>

#include "format/base/atomic_file.h"
#include "format/src/checks.h"
#include "format/src/header.h"

using namespace pointrt::format;

namespace {

struct Plan {
    std::vector<Section> sections; // in file order
    std::vector<const void*> data; // of each section
    std::uint64_t file_bytes = PRO_HEADER_BYTES;
};

std::uint64_t alignUp(std::uint64_t bytes) {
    return (bytes + PRO_SECTION_ALIGNMENT - 1) / PRO_SECTION_ALIGNMENT * PRO_SECTION_ALIGNMENT;
}

Plan planSections(const pro_info& info, const Content& content) {
    Plan plan;
    for (const KindRule& rule : kKindRules) {
        const void* data = sectionData(content, rule.kind);
        const std::uint64_t count = elementCount(rule.kind, info, content);
        const bool mandatory = rule.presence == Presence::kMandatory;
        if (!mandatory && (!data || count == 0)) continue;
        Section section;
        section.kind = rule.kind;
        section.stride = rule.stride;
        section.count = count;
        section.offset = plan.file_bytes;
        section.length = count * rule.stride;
        section.xxh3 = checksum(data, section.length);
        section.flags = mandatory ? PRO_SECTION_REQUIRED : 0;
        plan.file_bytes = alignUp(section.offset + section.length);
        plan.sections.push_back(section);
        plan.data.push_back(data);
    }
    return plan;
}

using Header = std::array<std::byte, PRO_HEADER_BYTES>;

Header makeHeader(pro_info info, const pro_index& index, const Plan& plan) {
    Header header{};
    info.file_bytes = plan.file_bytes;
    storeInfo(header.data(), info);
    storeFrame(header.data(), index);
    storeU32(header.data(), PRO_OFF_SECTION_COUNT, static_cast<std::uint32_t>(plan.sections.size()));
    storeU32(header.data(), PRO_OFF_SECTION_STRIDE, PRO_SECTION_BYTES);
    for (std::uint32_t i = 0; i < plan.sections.size(); ++i) storeSection(header.data(), i, plan.sections[i]);
    storeU64(header.data(), PRO_OFF_HEADER_XXH3, headerChecksum(header.data()));
    return header;
}

bool writePlan(AtomicFile& file, const Header& header, const Plan& plan) {
    static constexpr std::array<std::byte, PRO_SECTION_ALIGNMENT> kZeros{};
    if (!file.write(header.data(), header.size())) return false;
    for (std::size_t i = 0; i < plan.sections.size(); ++i) {
        const std::uint64_t length = plan.sections[i].length;
        if (!file.write(plan.data[i], length)) return false;
        if (!file.write(kZeros.data(), alignUp(length) - length)) return false;
    }
    return true;
}

bool missingSection(const pro_info& info, const pro_view& view) {
    if (view.metadata_bytes > 0 && !view.metadata) return true;
    return !view.nodes || !view.leaves || !view.splats || !view.materials || (!view.refs && info.ref_count > 0);
}

void keepFinding(const pro_message* finding, void* user) {
    if (auto* message = static_cast<pro_message*>(user)) *message = *finding;
}

/// Whatever is written can be opened.
bool checkInput(const pro_info& info, const Content& content, pro_message* message) {
    const pro_view& view = content.view;
    Findings findings(keepFinding, message, true);
    checkRanges(info, findings);
    if (info.flags & ~PRO_FLAGS_KNOWN) findings.add(Finding::kUnknownFlags, "unknown flags 0x%x", info.flags);
    if (view.metadata_bytes > 0 && !isUtf8({view.metadata, view.metadata_bytes}))
        findings.add(Finding::kMetadataUtf8, "META is not UTF-8");
    if (isWhole(content.index)) checkIndexFrame(content.index, findings);
    if (!findings.stopped()) checkContent(info, content, Level::kOpen, findings);
    return findings.count() == 0;
}

pro_result writeFile(const char* path, Existing existing, const pro_info& info, const Content& content,
                     pro_message* message) {
    AtomicFile file;
    const Plan plan = planSections(info, content);
    if (file.open(path, existing) && writePlan(file, makeHeader(info, content.index, plan), plan) && file.commit())
        return PRO_OK;
    if (file.nameIsTaken())
        setMessage(message, 0, "%s", file.error().c_str());
    else
        setMessage(message, 0, "cannot write: %s (%llu bytes are needed)", file.error().c_str(),
                   static_cast<unsigned long long>(plan.file_bytes));
    return PRO_CANNOT_WRITE;
}

pro_result writeAs(Existing existing, const char* path, const pro_info* info, const pro_view* view,
                   const pro_index* index, pro_message* message) {
    setMessage(message, 0, "%s", "");
    try {
        if (!path || !info || !view || missingSection(*info, *view) || (index && !isWhole(*index))) {
            setMessage(message, 0, "pro_write: null argument or section");
            return PRO_BAD_ARGUMENT;
        }
        const Content content{*view, index ? *index : pro_index{}};
        pro_info versioned = *info;
        versioned.version_major = PRO_VERSION_MAJOR;
        versioned.version_minor = index ? PRO_VERSION_MINOR : 0; // what a reader of 1.0 would miss nothing of is 1.0
        if (!checkInput(versioned, content, message)) return PRO_BAD_ARGUMENT;
        return writeFile(path, existing, versioned, content, message);
    } catch (const std::exception&) {
        setMessage(message, 0, "out of memory");
        return PRO_OUT_OF_MEMORY;
    }
}

} // namespace

pro_result pro_write(const char* path, const pro_info* info, const pro_view* view, pro_message* message) {
    return pro_write_indexed(path, info, view, nullptr, message);
}

pro_result pro_write_indexed(const char* path, const pro_info* info, const pro_view* view, const pro_index* index,
                             pro_message* message) {
    return writeAs(Existing::kReplaced, path, info, view, index, message);
}

pro_result pro_write_new(const char* path, const pro_info* info, const pro_view* view, const pro_index* index,
                         pro_message* message) {
    return writeAs(Existing::kKept, path, info, view, index, message);
}
