// SPDX-License-Identifier: Apache-2.0
#include "validate.h"

#include <algorithm>
#include <vector>

#include "header.h"

namespace pointrt::format {

namespace {

using Bytes = std::span<const std::byte>;

bool allZero(Bytes bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte value) { return value == std::byte{0}; });
}

/// False where nothing further can be told.
bool checkIdentity(Bytes bytes, Findings& findings) {
    if (bytes.size() < PRO_HEADER_BYTES) {
        const bool magic = bytes.size() >= 8 && loadU32(bytes.data(), PRO_OFF_MAGIC) == PRO_MAGIC_WORD0;
        findings.add(Finding::kShorterThanHeader, "%zu bytes, %s", bytes.size(),
                     magic ? "cut off inside its header" : "not a .pro file");
        return false;
    }
    if (loadU32(bytes.data(), PRO_OFF_MAGIC) != PRO_MAGIC_WORD0 ||
        loadU32(bytes.data(), PRO_OFF_MAGIC + 4) != PRO_MAGIC_WORD1) {
        findings.add(Finding::kMagic, "not a .pro file");
        return false;
    }
    const std::uint32_t major = loadU32(bytes.data(), PRO_OFF_VERSION_MAJOR);
    if (major != PRO_VERSION_MAJOR)
        findings.add(Finding::kMajorVersion, "version %u, this reader knows %u", major, PRO_VERSION_MAJOR);
    return major == PRO_VERSION_MAJOR;
}

void checkHeader(Bytes bytes, const pro_info& info, Findings& findings) {
    if (info.file_bytes != bytes.size())
        findings.add(Finding::kFileSize, "%zu bytes, the header says %llu", bytes.size(),
                     static_cast<unsigned long long>(info.file_bytes));
    if (loadU64(bytes.data(), PRO_OFF_HEADER_XXH3) != headerChecksum(bytes.data()))
        findings.add(Finding::kHeaderChecksum, "the header's checksum does not match");
    checkRanges(info, findings);
    if (info.version_minor > PRO_VERSION_MINOR) return; // later minors may use reserved bytes and flags
    if (!allZero(bytes.subspan(PRO_FIELDS_END, PRO_TABLE_OFFSET - PRO_FIELDS_END)))
        findings.add(Finding::kHeaderReserved, "reserved header bytes are not 0");
    if (info.flags & ~PRO_FLAGS_KNOWN) findings.add(Finding::kUnknownFlags, "unknown flags 0x%x", info.flags);
}

/// The records, none where the table itself is not usable.
std::vector<Section> loadTable(Bytes bytes, Findings& findings) {
    const std::uint32_t count = loadU32(bytes.data(), PRO_OFF_SECTION_COUNT);
    const std::uint32_t stride = loadU32(bytes.data(), PRO_OFF_SECTION_STRIDE);
    std::vector<Section> sections;
    if (count > PRO_SECTION_MAX || stride != PRO_SECTION_BYTES) {
        findings.add(Finding::kTableShape, "%u sections of %u bytes each, not up to %u of %u", count, stride,
                     PRO_SECTION_MAX, PRO_SECTION_BYTES);
        return sections;
    }
    for (std::uint32_t i = 0; i < count; ++i) sections.push_back(loadSection(bytes.data(), i));
    return sections;
}

void checkTableReserved(Bytes bytes, const std::vector<Section>& sections, Findings& findings) {
    constexpr std::size_t kUsed = PRO_SEC_OFF_FLAGS + 4;
    for (std::size_t i = 0; i < PRO_SECTION_MAX; ++i) {
        const Bytes record = bytes.subspan(PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES, PRO_SECTION_BYTES);
        const bool used = i < sections.size();
        if (!allZero(used ? record.subspan(kUsed) : record) ||
            (used && (sections[i].flags & ~PRO_SECTION_REQUIRED) != 0))
            findings.add(Finding::kTableReserved, "section record %zu: reserved bytes are not 0", i);
    }
}

/// Where the section lies; false when its bytes must not be touched.
bool checkPlace(const Section& section, std::uint64_t file_bytes, Findings& findings) {
    const std::size_t before = findings.count();
    const auto kind = kindName(section.kind);
    const char* name = kind.data();
    const bool fits = section.stride == 0
                          ? section.length == 0
                          : section.length % section.stride == 0 && section.length / section.stride == section.count;
    if (!fits) findings.add(Finding::kSectionLength, "%s: its length is not count times stride", name);
    if (section.offset < PRO_HEADER_BYTES || section.offset > file_bytes ||
        section.length > file_bytes - section.offset)
        findings.add(Finding::kSectionOutside, "%s: not inside the file", name);
    if (section.offset % PRO_SECTION_ALIGNMENT != 0)
        findings.add(Finding::kSectionAlignment, "%s: not on a multiple of %u bytes", name, PRO_SECTION_ALIGNMENT);
    return findings.count() == before;
}

/// Sorts by offset; sections must have passed checkPlace.
void checkOverlap(std::vector<Section>& sections, Findings& findings) {
    std::sort(sections.begin(), sections.end(), [](const Section& a, const Section& b) {
        return a.offset != b.offset ? a.offset < b.offset : a.length < b.length;
    });
    for (std::size_t i = 1; i < sections.size(); ++i)
        if (sections[i].offset < sections[i - 1].offset + sections[i - 1].length)
            findings.add(Finding::kSectionOverlap, "%s overlaps %s", kindName(sections[i].kind).data(),
                         kindName(sections[i - 1].kind).data());
}

void checkPadding(Bytes bytes, const std::vector<Section>& sorted, Findings& findings) {
    std::size_t end = PRO_HEADER_BYTES;
    Tally places;
    const auto checkGap = [&](std::size_t gap_end) {
        if (gap_end > end && !allZero(bytes.subspan(end, gap_end - end))) places.hit(end);
    };
    for (const Section& section : sorted) {
        checkGap(section.offset);
        end = section.offset + section.length;
    }
    checkGap(bytes.size());
    places.addTo(findings, Finding::kPadding, "the padding from byte", "not all 0");
}

/// Whether a section of a kind in kKindRules may be used.
bool checkKnown(const Section& section, const KindRule& rule, const Parsed& parsed, Findings& findings) {
    const bool counted = section.kind == PRO_KIND_META || section.count == promisedCount(section.kind, parsed.info, {});
    if (section.stride == rule.stride && counted) return true;
    findings.add(Finding::kSectionCount, "%s: %llu elements of %u bytes, not what the header promises",
                 kindName(section.kind).data(), static_cast<unsigned long long>(section.count), section.stride);
    return false;
}

/// Points view at the known sections and returns those whose bytes may be read, sorted by offset.
std::vector<Section> checkSections(Bytes bytes, const std::vector<Section>& table, Parsed& parsed, Findings& findings) {
    std::vector<Section> placed;
    for (const Section& section : table) {
        const KindRule* rule = findRule(section.kind);
        const auto name = kindName(section.kind);
        if (!rule && (section.flags & PRO_SECTION_REQUIRED))
            findings.add(Finding::kRequiredUnknown, "needs a section %s that this reader does not know", name.data());
        if (!checkPlace(section, bytes.size(), findings)) continue;
        placed.push_back(section);
        if (!rule || !checkKnown(section, *rule, parsed, findings)) continue;
        if (sectionData(parsed.view, section.kind))
            findings.add(Finding::kSectionTwice, "section %s stands twice", name.data());
        setSection(parsed.view, section.kind, bytes.data() + section.offset, section.count);
    }
    for (const KindRule& rule : kKindRules) {
        const bool listed =
            std::any_of(table.begin(), table.end(), [&](const Section& s) { return s.kind == rule.kind; });
        if (rule.mandatory && !listed)
            findings.add(Finding::kSectionMissing, "section %s is missing", kindName(rule.kind).data());
    }
    checkOverlap(placed, findings);
    return placed;
}

void checkChecksums(Bytes bytes, const std::vector<Section>& sections, Level level, Findings& findings) {
    for (const Section& section : sections) {
        if (level == Level::kOpen && !findRule(section.kind)) continue; // skipped sections are not read at all
        if (checksum(bytes.data() + section.offset, section.length) != section.xxh3)
            findings.add(Finding::kSectionChecksum, "%s: its checksum does not match", kindName(section.kind).data());
    }
}

} // namespace

Parsed validate(Bytes bytes, Level level, bool checksums, Findings& findings) {
    Parsed parsed;
    if (!checkIdentity(bytes, findings)) return parsed;
    parsed.info = loadInfo(bytes.data());
    checkHeader(bytes, parsed.info, findings);
    if (findings.stopped()) return parsed;
    const std::vector<Section> table = loadTable(bytes, findings);
    if (parsed.info.version_minor <= PRO_VERSION_MINOR) checkTableReserved(bytes, table, findings);
    if (findings.stopped()) return parsed;
    const std::size_t before = findings.count();
    const std::vector<Section> placed = checkSections(bytes, table, parsed, findings);
    if (findings.stopped()) return parsed;
    if (checksums) checkChecksums(bytes, placed, level, findings);
    if (findings.stopped()) return parsed;
    if (level == Level::kVerify && findings.count() == before) checkPadding(bytes, placed, findings);
    checkContent(parsed.info, parsed.view, level, findings);
    return parsed;
}

} // namespace pointrt::format
