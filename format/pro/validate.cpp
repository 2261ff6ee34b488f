// SPDX-License-Identifier: Apache-2.0
#include "format/pro/validate.h"

#include <algorithm>
#include <vector>

#include "format/base/parallel.h"
#include "format/pro/attributes.h"
#include "format/pro/header.h"
#include "format/pro/sections.h"

namespace pointrt::format {

namespace {

using Bytes = std::span<const std::byte>;

/// Checking a smaller file takes less time than starting threads.
constexpr std::size_t kThreadsBytes = std::size_t{1} << 20;

bool allZero(Bytes bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte value) { return value == std::byte{0}; });
}

/// False if the bytes are no header that this reader can check further.
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
        findings.add(Finding::kMajorVersion, "format version %u; this reader supports version %u", major,
                     PRO_VERSION_MAJOR);
    return major == PRO_VERSION_MAJOR;
}

void checkHeader(Bytes bytes, const pro_info& info, Findings& findings) {
    if (info.file_bytes != bytes.size())
        findings.add(Finding::kFileSize, "%zu bytes; the header says %llu", bytes.size(),
                     static_cast<unsigned long long>(info.file_bytes));
    if (loadU64(bytes.data(), PRO_OFF_HEADER_XXH3) != headerChecksum(bytes.data()))
        findings.add(Finding::kHeaderChecksum, "the header's checksum does not match");
    checkRanges(info, findings);
    if (info.version_minor > PRO_VERSION_MINOR) return; // later minors may use reserved bytes and flags
    if (!allZero(bytes.subspan(PRO_OFF_OLD_GRID, PRO_OFF_UP - PRO_OFF_OLD_GRID)))
        findings.add(Finding::kHeaderReserved, "written before pointrt 0.1.0 (format %u.%u); bake the scan again",
                     info.version_major, info.version_minor);
    if (!allZero(bytes.subspan(PRO_FIELDS_END, PRO_TABLE_OFFSET - PRO_FIELDS_END)))
        findings.add(Finding::kHeaderReserved, "reserved header bytes are not 0");
    if (info.flags & ~PRO_FLAGS_KNOWN) findings.add(Finding::kUnknownFlags, "unknown flags 0x%x", info.flags);
}

/// The records; none if the table itself is malformed.
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

/// Checks where the section lies. False if its bytes must not be read.
bool checkPlace(const Section& section, std::uint64_t file_bytes, Findings& findings) {
    const auto kind = kindName(section.kind);
    const char* name = kind.data();
    const bool adds_up = section.stride == 0
                             ? section.length == 0
                             : section.length % section.stride == 0 && section.length / section.stride == section.count;
    if (!adds_up) findings.add(Finding::kSectionLength, "%s: its length is not count times stride", name);
    const bool inside = section.offset >= PRO_HEADER_BYTES && section.offset <= file_bytes &&
                        section.length <= file_bytes - section.offset;
    if (!inside) findings.add(Finding::kSectionOutside, "%s: not inside the file", name);
    const bool aligned = section.offset % PRO_SECTION_ALIGNMENT == 0;
    if (!aligned)
        findings.add(Finding::kSectionAlignment, "%s: not on a multiple of %u bytes", name, PRO_SECTION_ALIGNMENT);
    return adds_up && inside && aligned; // findings may have stopped counting, so they are not compared
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

/// Checks the stride and the count of a section of a known kind. Counts that the header does not have are only bounded
/// here; checkIndexSections compares them.
bool checkShape(const Section& section, const SectionRule& rule, const Parsed& parsed, Findings& findings) {
    const bool count_fits = rule.count.limit > 0 ? section.count <= rule.count.limit
                                                 : section.count == rule.count.get(parsed.info, parsed.content);
    if (section.stride == strideOf(rule, parsed.content) && count_fits) return true;
    findings.add(Finding::kSectionCount, "%s: %llu elements of %u bytes do not match the header",
                 kindName(section.kind).data(), static_cast<unsigned long long>(section.count), section.stride);
    return false;
}

/// Sets the known sections in parsed and returns those whose bytes may be read, sorted by offset.
std::vector<Section> checkSections(Bytes bytes, const std::vector<Section>& table, Parsed& parsed, Findings& findings) {
    std::vector<Section> placed;
    for (const Section& section : table) {
        const SectionRule* rule = findRule(section.kind);
        const auto name = kindName(section.kind);
        if (!rule && (section.flags & PRO_SECTION_REQUIRED))
            findings.add(Finding::kRequiredUnknown, "requires a section %s that this reader does not support",
                         name.data());
        if (!checkPlace(section, bytes.size(), findings)) continue;
        placed.push_back(section);
        if (!rule || !checkShape(section, *rule, parsed, findings)) continue;
        if (rule->data.get(parsed.content))
            findings.add(Finding::kSectionTwice, "section %s appears twice", name.data());
        setSection(parsed.content, *rule, bytes.data() + section.offset, section.count);
    }
    for (const SectionRule& rule : kSectionRules) {
        const bool listed =
            std::any_of(table.begin(), table.end(), [&](const Section& s) { return s.kind == rule.kind; });
        if (rule.presence == Presence::kMandatory && !listed)
            findings.add(Finding::kSectionMissing, "section %s is missing", kindName(rule.kind).data());
    }
    checkOverlap(placed, findings);
    return placed;
}

/// Sets the values of the attributes and checks their sections against ATTD. Sets all attributes or none.
void checkAttributes(Bytes bytes, const std::vector<Section>& table, Parsed& parsed, Findings& findings) {
    Content& content = parsed.content;
    const std::size_t before = findings.count();
    for (std::size_t i = 0; i < content.attribute_count; ++i) checkAttributeRecord(content, i, findings);
    for (const Section& section : table) {
        if (section.kind != PRO_KIND_ATTR || findings.count() != before) continue;
        const std::size_t i = content.attribute_values.size();
        const pro_attribute attribute = i < content.attribute_count ? loadAttribute(content, i) : pro_attribute{};
        if (section.stride != attribute.components * pro_type_bytes(attribute.type) || section.stride == 0 ||
            section.count != parsed.info.splat_count)
            findings.add(Finding::kAttributeSections, "ATTR: %llu elements of %u bytes do not match ATTD",
                         static_cast<unsigned long long>(section.count), section.stride);
        content.attribute_values.push_back(bytes.data() + section.offset);
    }
    if (findings.count() == before && content.attribute_values.size() != content.attribute_count)
        findings.add(Finding::kAttributeSections, "%zu ATTR sections for %zu records in ATTD",
                     content.attribute_values.size(), content.attribute_count);
    if (findings.count() == before) checkAttributeNames(content, findings);
    if (findings.count() == before) return;
    content.attribute_count = 0;
    content.attribute_values.clear();
}

/// Checks the sections of the index against one another and against the grid frame; placed ones must have been set.
/// Keeps a complete index or none.
void checkIndexSections(Bytes bytes, const std::vector<Section>& placed, Parsed& parsed, Findings& findings) {
    pro_index& index = parsed.content.index;
    const auto indexRule = [](const Section& section) -> const SectionRule* {
        const SectionRule* rule = findRule(section.kind);
        return rule && rule->presence == Presence::kIndex ? rule : nullptr;
    };
    const bool listed = std::any_of(placed.begin(), placed.end(), indexRule);
    const std::size_t before = findings.count();
    if (!listed) {
        if (!allZero(bytes.subspan(PRO_OFF_GRID_SHIFT, PRO_GRID_FIELDS_END - PRO_OFF_GRID_SHIFT)))
            findings.add(Finding::kGridFrame, "an entry grid without its sections");
    } else if (!isComplete(index)) {
        findings.add(Finding::kIndexIncomplete, "the tracing index is incomplete");
    } else if (checkIndexFrame(index, findings)) {
        for (const Section& section : placed) {
            const SectionRule* rule = indexRule(section);
            if (rule && section.count != rule->count.get(parsed.info, parsed.content))
                findings.add(Finding::kSectionCount, "%s: %llu elements do not match the rest of the index",
                             kindName(section.kind).data(), static_cast<unsigned long long>(section.count));
        }
    }
    parsed.indexed = listed && findings.count() == before;
    if (!parsed.indexed) index = {};
}

bool isOfGaussians(const Section& section) {
    const SectionRule* rule = findRule(section.kind);
    if (!rule) return false;
    return rule->presence == Presence::kGaussians || rule->presence == Presence::kHarmonics ||
           rule->presence == Presence::kExactGaussians;
}

/// Checks the sections of the Gaussians against one another and against the header; placed ones must have been set.
/// Keeps complete Gaussians or none.
void checkGaussianSections(Bytes bytes, const std::vector<Section>& placed, Parsed& parsed, Findings& findings) {
    pro_gaussians& gaussians = parsed.content.gaussians;
    const bool listed = std::any_of(placed.begin(), placed.end(), isOfGaussians);
    const std::size_t before = findings.count();
    if (!listed) {
        if (!allZero(bytes.subspan(PRO_OFF_HARMONICS_DEGREE, PRO_FIELDS_END - PRO_OFF_HARMONICS_DEGREE)))
            findings.add(Finding::kGaussianCoding, "a coding of Gaussians without their sections");
    } else if (!isComplete(gaussians)) {
        findings.add(Finding::kGaussiansIncomplete, "the sections of the Gaussians are incomplete");
    } else {
        checkGaussianCoding(gaussians, findings);
    }
    if (!listed || findings.count() != before) gaussians = {};
}

/// Drops the sections that PRO_OPEN_TRACE does not read.
void dropUntraced(std::vector<Section>& placed, Content& content) {
    std::erase_if(placed, [](const Section& section) {
        const SectionRule* rule = findRule(section.kind);
        return !rule || !rule->traced;
    });
    for (const SectionRule& rule : kSectionRules)
        if (!rule.traced) setSection(content, rule, nullptr, 0);
}

void checkChecksums(Bytes bytes, std::vector<Section> sections, Level level, Findings& findings) {
    // sections of unknown kinds are not read
    if (level != Level::kVerify)
        std::erase_if(sections,
                      [](const Section& section) { return !findRule(section.kind) && section.kind != PRO_KIND_ATTR; });
    std::vector<char> wrong(sections.size());
    const auto compare = [&](std::size_t k) {
        wrong[k] = checksum(bytes.data() + sections[k].offset, sections[k].length) != sections[k].xxh3;
    };
    forAll(sections.size(), compare, bytes.size() < kThreadsBytes ? 1 : 0);
    for (std::size_t k = 0; k < sections.size(); ++k)
        if (wrong[k])
            findings.add(Finding::kSectionChecksum, "%s: its checksum does not match",
                         kindName(sections[k].kind).data());
}

} // namespace

Parsed validate(Bytes bytes, Level level, bool checksums, Findings& findings) {
    Parsed parsed;
    if (!checkIdentity(bytes, findings)) return parsed;
    parsed.info = loadInfo(bytes.data());
    parsed.content.world = loadWorld(bytes.data());
    parsed.content.sampling = loadSampling(bytes.data());
    parsed.content.index = loadFrame(bytes.data());
    parsed.content.gaussians = loadGaussianCoding(bytes.data());
    checkHeader(bytes, parsed.info, findings);
    checkWorld(parsed.content.world, findings);
    checkSampling(parsed.info, parsed.content.sampling, findings);
    if (findings.stopped()) return parsed;
    const std::vector<Section> table = loadTable(bytes, findings);
    if (parsed.info.version_minor <= PRO_VERSION_MINOR) checkTableReserved(bytes, table, findings);
    if (findings.stopped()) return parsed;
    const std::size_t before = findings.count();
    std::vector<Section> placed = checkSections(bytes, table, parsed, findings);
    if (findings.stopped()) return parsed;
    checkIndexSections(bytes, placed, parsed, findings);
    if (findings.stopped()) return parsed;
    checkGaussianSections(bytes, placed, parsed, findings);
    if (findings.stopped()) return parsed;
    if (findings.count() == before) checkAttributes(bytes, table, parsed, findings);
    if (findings.stopped()) return parsed;
    if (level == Level::kTrace && parsed.indexed) dropUntraced(placed, parsed.content);
    if (checksums) checkChecksums(bytes, placed, level, findings);
    if (findings.stopped()) return parsed;
    if (level == Level::kVerify && findings.count() == before) checkPadding(bytes, placed, findings);
    checkContent(parsed.info, parsed.content, level, findings);
    return parsed;
}

} // namespace pointrt::format
