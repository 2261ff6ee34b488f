// SPDX-License-Identifier: Apache-2.0
#include "format/info/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace pointrt {

namespace {

std::vector<LevelSummary> countLevels(std::span<const std::uint32_t> nodes) {
    std::vector<LevelSummary> levels;
    std::size_t first = 0, end = 1; // the words of one depth; the group of the root holds only the root
    while (first < end) {
        LevelSummary level;
        for (std::size_t i = first; i < end; ++i) {
            if (nodes[i] & PRO_NODE_INNER)
                ++level.inner;
            else
                ++(nodes[i] == PRO_NODE_EMPTY ? level.empty : level.filled);
        }
        levels.push_back(level);
        first = levels.size() == 1 ? PRO_GROUP_SIZE : end;
        end = first + PRO_GROUP_SIZE * level.inner;
    }
    return levels;
}

template <typename T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

std::vector<SectionSummary> listSections(std::span<const std::byte> bytes) {
    std::vector<SectionSummary> sections(load<std::uint32_t>(bytes.data() + PRO_OFF_SECTION_COUNT));
    const std::byte* record = bytes.data() + PRO_TABLE_OFFSET;
    for (SectionSummary& section : sections) {
        section.kind.assign(reinterpret_cast<const char*>(record + PRO_SEC_OFF_KIND), 4);
        for (char& c : section.kind)
            if (c < ' ' || c > '~') c = '?'; // an unknown kind may have any bytes
        section.stride = load<std::uint32_t>(record + PRO_SEC_OFF_STRIDE);
        section.count = load<std::uint64_t>(record + PRO_SEC_OFF_COUNT);
        section.offset = load<std::uint64_t>(record + PRO_SEC_OFF_OFFSET);
        section.bytes = load<std::uint64_t>(record + PRO_SEC_OFF_LENGTH);
        section.required = (load<std::uint32_t>(record + PRO_SEC_OFF_FLAGS) & PRO_SECTION_REQUIRED) != 0;
        record += PRO_SECTION_BYTES;
    }
    return sections;
}

/// A valid file has all of these sections or none.
std::uint64_t indexBytes(const std::vector<SectionSummary>& sections) {
    constexpr std::array<std::string_view, 7> kKinds = {"ENTR", "BRKS", "CELS", "SLBS", "DSCS", "DSPL", "BLDS"};
    std::uint64_t bytes = 0;
    for (const SectionSummary& section : sections)
        if (std::find(kKinds.begin(), kKinds.end(), section.kind) != kKinds.end()) bytes += section.bytes;
    return bytes;
}

GaussianSummary summarizeGaussians(const std::vector<SectionSummary>& sections) {
    constexpr std::array<std::string_view, 5> kKinds = {"GAUS", "GHRM", "GNOD", "GLST", "GEXA"};
    GaussianSummary summary;
    for (const SectionSummary& section : sections) {
        if (std::find(kKinds.begin(), kKinds.end(), section.kind) == kKinds.end()) continue;
        summary.sections.push_back(section);
        summary.bytes += section.bytes;
    }
    return summary;
}

std::uint64_t countBorderLeaves(std::span<const std::uint32_t> leaves) {
    std::uint64_t count = 0;
    for (std::size_t i = PRO_LEAF_COUNTS; i < leaves.size(); i += PRO_LEAF_WORDS)
        if ((leaves[i] & PRO_LEAF_MEMBER_MASK) == 0) ++count;
    return count;
}

NoiseSummary summarizeNoise(const ProFile& file) {
    NoiseSummary summary;
    std::array<std::uint64_t, PRO_NOISE_CODE_MAX + 1> counts{};
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (std::size_t i = 0; i < file.noise().size(); ++i) {
        const double sigma = file.noise()[i] / double{PRO_NOISE_STEPS} * double{file.splat(i).radius};
        low = std::min(low, sigma);
        high = std::max(high, sigma);
        ++counts[file.noise()[i]];
    }
    if (file.noise().empty()) return summary;
    // the code at this rank among all splats
    const auto codeAt = [&](std::uint64_t place) {
        std::size_t code = 0;
        for (std::uint64_t before = counts[0]; before <= place; before += counts[++code]) {
        }
        return static_cast<double>(code) / double{PRO_NOISE_STEPS};
    };
    const std::uint64_t count = file.noise().size();
    return {codeAt(0), codeAt(count / 2), codeAt(count - 1), low * file.info().scale, high * file.info().scale};
}

} // namespace

Summary summarize(const ProFile& file) {
    Summary summary;
    const pro_info& info = summary.info = file.info();
    summary.levels = countLevels(file.nodes());
    summary.sections = listSections(file.bytes());
    if (file.index()) summary.index_bytes = indexBytes(summary.sections);
    summary.noise = summarizeNoise(file);
    if (file.gaussians()) summary.gaussians = summarizeGaussians(summary.sections);
    if (info.flags & PRO_FLAG_BALLS)
        for (std::size_t i = 0; i < info.splat_count; ++i) summary.balls += file.isBall(i);
    summary.nodes = 1;
    for (const LevelSummary& level : summary.levels) {
        summary.nodes += PRO_GROUP_SIZE * level.inner;
        summary.empty_leaves += level.empty;
    }
    summary.border_leaves = countBorderLeaves(file.leaves());
    summary.references = std::uint64_t{info.splat_count} + info.ref_count;
    summary.references_per_splat = static_cast<double>(summary.references) / info.splat_count;
    summary.bytes_per_splat = static_cast<double>(info.file_bytes) / info.splat_count;
    summary.position_error = std::sqrt(3.0) / 2 * info.scale * double{PRO_POSITION_STEP};
    summary.radius_error = std::exp2(double{info.radius_step}) - 1;
    return summary;
}

} // namespace pointrt
