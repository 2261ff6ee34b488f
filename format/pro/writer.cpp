// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <exception>
#include <vector>

#include "format/os/atomic_file.h"
#include "format/pro/attributes.h"
#include "format/pro/checks.h"
#include "format/pro/header.h"
#include "format/pro/sampling.h"

using namespace pointrt::format;

namespace {

struct FileLayout {
    std::vector<Section> sections; // in file order
    std::vector<const void*> data; // one per section
    std::uint64_t file_bytes = PRO_HEADER_BYTES;
};

std::uint64_t alignUp(std::uint64_t bytes) {
    return (bytes + PRO_SECTION_ALIGNMENT - 1) / PRO_SECTION_ALIGNMENT * PRO_SECTION_ALIGNMENT;
}

/// Appends a section to the file.
void addSection(FileLayout& layout, std::uint32_t kind, std::uint32_t stride, std::uint64_t count, const void* data) {
    Section section;
    section.kind = kind;
    section.stride = stride;
    section.count = count;
    section.offset = layout.file_bytes;
    section.length = count * stride;
    section.xxh3 = checksum(data, section.length);
    layout.file_bytes = alignUp(section.offset + section.length);
    layout.sections.push_back(section);
    layout.data.push_back(data);
}

FileLayout layOut(const pro_info& info, const Content& content) {
    FileLayout layout;
    for (const SectionRule& rule : kSectionRules) {
        const void* data = rule.data.get(content);
        const std::uint64_t count = rule.count.get(info, content);
        const bool mandatory = rule.presence == Presence::kMandatory;
        const bool may_be_empty = mandatory || rule.presence == Presence::kGaussians;
        if ((!mandatory && !data) || (!may_be_empty && count == 0)) continue;
        addSection(layout, rule.kind, strideOf(rule, content), count, data);
        layout.sections.back().flags = mandatory ? PRO_SECTION_REQUIRED : 0;
    }
    for (std::size_t i = 0; i < content.attribute_count; ++i) {
        const pro_attribute attribute = loadAttribute(content, i);
        addSection(layout, PRO_KIND_ATTR, attribute.components * pro_type_bytes(attribute.type), info.splat_count,
                   attribute.values);
    }
    return layout;
}

using Header = std::array<std::byte, PRO_HEADER_BYTES>;

Header makeHeader(pro_info info, const Content& content, const FileLayout& layout) {
    Header header{};
    info.file_bytes = layout.file_bytes;
    storeInfo(header.data(), info);
    storeFrame(header.data(), content.index);
    storeGaussianCoding(header.data(), content.gaussians);
    storeWorld(header.data(), content.world);
    storeSampling(header.data(), content.sampling);
    storeU32(header.data(), PRO_OFF_SECTION_COUNT, static_cast<std::uint32_t>(layout.sections.size()));
    storeU32(header.data(), PRO_OFF_SECTION_STRIDE, PRO_SECTION_BYTES);
    for (std::uint32_t i = 0; i < layout.sections.size(); ++i) storeSection(header.data(), i, layout.sections[i]);
    storeU64(header.data(), PRO_OFF_HEADER_XXH3, headerChecksum(header.data()));
    return header;
}

bool writeSections(AtomicFile& file, const Header& header, const FileLayout& layout) {
    static constexpr std::array<std::byte, PRO_SECTION_ALIGNMENT> kZeros{};
    if (!file.write(header.data(), header.size())) return false;
    for (std::size_t i = 0; i < layout.sections.size(); ++i) {
        const std::uint64_t length = layout.sections[i].length;
        if (!file.write(layout.data[i], length)) return false;
        if (!file.write(kZeros.data(), alignUp(length) - length)) return false;
    }
    return true;
}

bool missingSection(const pro_info& info, const pro_view& view) {
    if (view.metadata_bytes > 0 && !view.metadata) return true;
    return !view.nodes || !view.leaves || !view.splats || !view.materials || (!view.refs && info.ref_count > 0);
}

void keepFindingIfWanted(const pro_message* finding, void* user) {
    if (auto* message = static_cast<pro_message*>(user)) *message = *finding;
}

/// Refuses content that pro_open would refuse.
bool checkInput(const pro_info& info, const Content& content, pro_message* message) {
    const pro_view& view = content.view;
    Findings findings(keepFindingIfWanted, message, true);
    checkRanges(info, findings);
    if (info.flags & ~PRO_FLAGS_KNOWN) findings.add(Finding::kUnknownFlags, "unknown flags 0x%x", info.flags);
    if (view.metadata_bytes > 0 && !isUtf8({view.metadata, view.metadata_bytes}))
        findings.add(Finding::kMetadataUtf8, "META is not UTF-8");
    if (isComplete(content.index)) checkIndexFrame(content.index, findings);
    if (isComplete(content.gaussians)) checkGaussianCoding(content.gaussians, findings);
    checkWorld(content.world, findings);
    checkSampling(info, content.sampling, findings);
    for (std::size_t i = 0; i < content.attribute_count; ++i) checkAttributeRecord(content, i, findings);
    checkAttributeNames(content, findings);
    if (!findings.stopped()) checkContent(info, content, Level::kOpen, findings);
    return findings.count() == 0;
}

pro_result writeFile(const char* path, Existing existing, const pro_info& info, const Content& content,
                     pro_message* message) {
    AtomicFile file;
    const FileLayout layout = layOut(info, content);
    if (file.open(path, existing) && writeSections(file, makeHeader(info, content, layout), layout) && file.commit())
        return PRO_OK;
    if (file.nameIsTaken())
        setMessage(message, 0, "%s", file.error().c_str());
    else
        setMessage(message, 0, "cannot write: %s (needs %llu bytes)", file.error().c_str(),
                   static_cast<unsigned long long>(layout.file_bytes));
    return PRO_CANNOT_WRITE;
}

bool hasNulls(const pro_content& content) {
    if (!content.info || !content.view || missingSection(*content.info, *content.view)) return true;
    if (content.index && !isComplete(*content.index)) return true;
    if (content.world && content.world->sensor_count > 0 && !content.world->sensors) return true;
    if (content.attribute_count > PRO_ATTRIBUTE_MAX || (content.attribute_count > 0 && !content.attributes))
        return true;
    return std::any_of(content.attributes, content.attributes + content.attribute_count,
                       [](const pro_attribute& attribute) { return !attribute.values; });
}

bool hasNulls(const pro_gaussians& gaussians) {
    return !gaussians.words || !gaussians.nodes || (!gaussians.lists && gaussians.list_count > 0) ||
           (!gaussians.harmonics && gaussians.degree > 0) || (!gaussians.exact && gaussians.exact_count > 0);
}

/// The Gaussians as a reader would set them: GLST is there even if it is empty, GHRM only with a degree, GEXA only if
/// it is not empty.
pro_gaussians normalized(pro_gaussians gaussians) {
    if (gaussians.list_count == 0) gaussians.lists = gaussians.nodes;
    if (gaussians.degree == 0) gaussians.harmonics = nullptr;
    if (gaussians.exact_count == 0) gaussians.exact = nullptr;
    return gaussians;
}

bool hasWorld(const pro_world& world) {
    return world.up[0] != 0 || world.up[1] != 0 || world.up[2] != 0 || world.metres_per_unit != 0 ||
           world.sensor_count > 0;
}

/// Sets the sections of the attributes; records receives ATTD.
void setAttributes(Content& to, const pro_content& from, std::vector<std::byte>& records) {
    records.resize(from.attribute_count * std::size_t{PRO_ATTRIBUTE_BYTES});
    for (std::size_t i = 0; i < from.attribute_count; ++i) {
        pro_attribute attribute = from.attributes[i];
        attribute.name[PRO_ATTRIBUTE_NAME_MAX] = 0;
        if (attribute.components <= PRO_ATTRIBUTE_COMPONENTS_MAX && pro_type_bytes(attribute.type) > 0)
            findRange(attribute, std::size_t{from.info->splat_count} * attribute.components);
        storeAttribute(records.data() + i * PRO_ATTRIBUTE_BYTES, attribute);
        to.attribute_values.push_back(static_cast<const std::byte*>(attribute.values));
    }
    to.attribute_records = records.data();
    to.attribute_count = from.attribute_count;
}

bool hasSampling(const pro_sampling& sampling) { return sampling.noise || sampling.filled_count > 0; }

/// The first minor version that had all of the content. Files without an index (pointrt-bake --compact) have been
/// stamped so since release 0.1.0; readers do not use the number.
std::uint32_t minorVersionOf(const pro_content& content, const pro_gaussians* gaussians) {
    if (gaussians || (content.info->flags & PRO_FLAG_BALLS)) return 5;
    if (content.index) return 4;
    if (content.sampling && hasSampling(*content.sampling)) return 3;
    if (content.attribute_count > 0 || (content.world && hasWorld(*content.world))) return 2;
    return 0;
}

pro_result writeAs(Existing existing, const char* path, const pro_content& given, const pro_gaussians* gaussians,
                   pro_message* message) {
    setMessage(message, 0, "%s", "");
    try {
        if (!path || hasNulls(given) || (gaussians && hasNulls(*gaussians))) {
            setMessage(message, 0, "pro_write: null argument or section, or more than %u attributes",
                       PRO_ATTRIBUTE_MAX);
            return PRO_BAD_ARGUMENT;
        }
        Content content;
        std::vector<std::byte> records;
        content.view = *given.view;
        if (given.index) content.index = *given.index;
        if (gaussians) content.gaussians = normalized(*gaussians);
        if (given.world) content.world = *given.world;
        if (given.sampling && hasSampling(*given.sampling)) content.sampling = *given.sampling;
        setAttributes(content, given, records);
        pro_info versioned = *given.info;
        versioned.version_major = PRO_VERSION_MAJOR;
        versioned.version_minor = minorVersionOf(given, gaussians);
        content.sampling.noise_median = 0; // computed below, from radii and a scale that have been checked
        if (!checkInput(versioned, content, message)) return PRO_BAD_ARGUMENT;
        content.sampling.noise_median = medianNoise(versioned, content);
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
    return writeAs(Existing::kReplaced, path, {info, view, index, nullptr, nullptr, 0, nullptr}, nullptr, message);
}

pro_result pro_write_new(const char* path, const pro_info* info, const pro_view* view, const pro_index* index,
                         pro_message* message) {
    return writeAs(Existing::kKept, path, {info, view, index, nullptr, nullptr, 0, nullptr}, nullptr, message);
}

pro_result pro_write_content(const char* path, const pro_content* content, int replace, pro_message* message) {
    return pro_write_gaussians(path, content, nullptr, replace, message);
}

pro_result pro_write_gaussians(const char* path, const pro_content* content, const pro_gaussians* gaussians,
                               int replace, pro_message* message) {
    return writeAs(replace ? Existing::kReplaced : Existing::kKept, path, content ? *content : pro_content{}, gaussians,
                   message);
}
