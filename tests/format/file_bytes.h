// SPDX-License-Identifier: Apache-2.0
// Reads and modifies the bytes of files.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointrt::test {

using Bytes = std::vector<std::byte>;

inline Bytes readBytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
}

inline void writeBytes(const std::string& path, const Bytes& bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out) throw std::runtime_error("cannot write " + path);
}

template <typename T = std::uint32_t>
T loadAt(const Bytes& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <typename T>
void storeAt(Bytes& bytes, std::size_t offset, const T& value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// Offset of the record of a kind in the section table.
inline std::size_t recordOf(const Bytes& bytes, std::uint32_t kind) {
    for (std::size_t i = 0; i < loadAt(bytes, PRO_OFF_SECTION_COUNT); ++i) {
        const std::size_t record = PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES;
        if (loadAt(bytes, record + PRO_SEC_OFF_KIND) == kind) return record;
    }
    throw std::runtime_error("no such section");
}

inline std::size_t sectionOf(const Bytes& bytes, std::uint32_t kind) {
    return loadAt<std::uint64_t>(bytes, recordOf(bytes, kind) + PRO_SEC_OFF_OFFSET);
}

inline void fixHeaderChecksum(Bytes& bytes) {
    storeAt(bytes, PRO_OFF_HEADER_XXH3,
            XXH3_64bits(bytes.data() + PRO_OFF_SECTION_COUNT, PRO_HEADER_BYTES - PRO_OFF_SECTION_COUNT));
}

/// Corrects all checksums, so that later checks are reached. The section table must be intact.
inline void fixChecksums(Bytes& bytes) {
    for (std::size_t i = 0; i < loadAt(bytes, PRO_OFF_SECTION_COUNT); ++i) {
        const std::size_t record = PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES;
        const auto offset = loadAt<std::uint64_t>(bytes, record + PRO_SEC_OFF_OFFSET);
        const auto length = loadAt<std::uint64_t>(bytes, record + PRO_SEC_OFF_LENGTH);
        storeAt(bytes, record + PRO_SEC_OFF_XXH3, XXH3_64bits(bytes.data() + offset, length));
    }
    fixHeaderChecksum(bytes);
}

struct OpenResult {
    pro_result result;
    pro_message message;
};

/// Follows a word of a brick to its cells, as a tracer would.
inline std::uint64_t touchWord(const pro_index& index, std::uint32_t word, std::uint64_t& walked) {
    if (++walked > 1000000) throw std::logic_error("a walk without end");
    if ((word & PRO_SKIP_MASK) != 0) return 0;
    std::uint64_t sum = 0;
    if (word & PRO_CELL_INNER) {
        const std::size_t first = std::size_t{word >> PRO_CELL_INDEX_SHIFT} * PRO_GROUP_WORDS;
        for (std::size_t k = 0; k < PRO_GROUP_WORDS; ++k) sum += touchWord(index, index.bricks[first + k], walked);
        return sum;
    }
    const std::size_t at = word >> PRO_CELL_INDEX_SHIFT;
    const std::uint32_t* cell = index.cells + at * PRO_CELL_WORDS;
    const std::uint32_t first = cell[PRO_CELL_FIRST] & ~1u;
    const std::uint32_t end = cell[PRO_CELL_FIRST] + (cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK);
    for (std::uint32_t k = first; k < (end + 1) / 2 * 2; ++k)
        sum += index.near_splats[std::size_t{k} * PRO_NEAR_WORDS + 1] + index.listed[k];
    for (std::uint32_t k = 0; k < (cell[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK); ++k) {
        const std::size_t i = std::size_t{cell[PRO_CELL_BLENDING]} + k;
        const auto number = static_cast<std::int16_t>(index.blending[i / 2] >> (i % 2 * 16));
        sum += index.listed[static_cast<std::size_t>(std::int64_t{cell[PRO_CELL_FIRST]} + number)];
    }
    return sum + index.slabs[at];
}

/// Follows every index of a tracing index.
inline std::uint64_t touchIndex(const pro_info& info, const pro_view& view, const pro_index& index) {
    std::uint64_t sum = 0, walked = 0;
    for (std::size_t i = 0; i < std::size_t{index.size[0]} * index.size[1] * index.size[2]; ++i) {
        const std::uint32_t word = index.grid[i];
        for (std::size_t k = 0; k < PRO_BRICK_WORDS && (word & PRO_SKIP_MASK) == 0; ++k)
            sum +=
                touchWord(index, index.bricks[std::size_t{word >> PRO_GRID_BRICK_SHIFT} * PRO_BRICK_WORDS + k], walked);
    }
    for (std::size_t i = 0; i < index.near_count; ++i)
        sum += view.splats[std::size_t{index.listed[i]} * PRO_SPLAT_WORDS];
    return sum + info.splat_count;
}

/// Follows every index in a view, as a renderer would, so that a sanitizer detects those out of range.
inline std::uint64_t touchEverything(const pro_info& info, const pro_view& view) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < info.node_count && view.nodes; ++i) {
        const std::uint32_t node = view.nodes[i];
        if (node & PRO_NODE_INNER)
            sum += view.nodes[(node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + 7];
        else if (node != PRO_NODE_EMPTY)
            sum += view.leaves[(node - 1) * PRO_LEAF_WORDS + 3];
    }
    for (std::size_t i = 0; i < info.leaf_count && view.leaves; ++i) {
        const std::uint32_t* leaf = view.leaves + i * PRO_LEAF_WORDS;
        const std::uint32_t members = leaf[2] & PRO_LEAF_MEMBER_MASK, references = leaf[2] >> PRO_LEAF_REF_SHIFT;
        for (std::uint32_t k = 0; k < members; ++k) sum += view.splats[(leaf[0] + k) * PRO_SPLAT_WORDS];
        for (std::uint32_t k = 0; k < references; ++k) sum += view.splats[view.refs[leaf[1] + k] * PRO_SPLAT_WORDS + 3];
    }
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        sum += view.order ? view.order[i] : 0;
        const std::uint32_t material = view.splats[i * PRO_SPLAT_WORDS + 2] >> PRO_MATERIAL_SHIFT;
        sum += view.materials[material * PRO_MATERIAL_FLOATS + 15] != 0;
    }
    for (std::size_t i = 0; i < view.metadata_bytes; ++i) sum += static_cast<unsigned char>(view.metadata[i]);
    return sum;
}

/// Reads every value of the attributes and sensors.
inline std::uint64_t touchSaid(const pro_info& info, const pro_file* file) {
    double sum = 0;
    pro_attribute attribute;
    for (std::uint32_t i = 0; pro_get_attribute(file, i, &attribute); ++i)
        for (std::size_t k = 0; k < std::size_t{info.splat_count} * attribute.components; ++k)
            sum += pro_attribute_value(&attribute, k) > 0;
    pro_world world;
    pro_get_world(file, &world);
    for (std::size_t i = 0; i < std::size_t{world.sensor_count} * PRO_SENSOR_DOUBLES; ++i) sum += world.sensors[i] > 0;
    pro_sampling sampling;
    pro_get_sampling(file, &sampling);
    for (std::size_t i = 0; i < info.splat_count && sampling.noise; ++i) sum += sampling.noise[i];
    return static_cast<std::uint64_t>(sum);
}

/// Follows every index of the Gaussians and decodes them; throws if a number is not finite or a walk does not end.
inline std::uint64_t touchGaussians(const pro_info& info, const pro_view& view, const pro_gaussians& gaussians) {
    std::uint64_t sum = 0, walked = 0;
    std::vector<std::uint32_t> pending{0};
    while (!pending.empty()) {
        const std::size_t node = pending.back();
        pending.pop_back();
        if (++walked > gaussians.node_count) throw std::logic_error("a walk without end");
        const std::uint32_t* words = gaussians.nodes + node * PRO_GAUSSIAN_NODE_WORDS;
        const bool last = node + 1 == gaussians.node_count;
        const std::uint32_t end =
            last ? gaussians.list_count : words[PRO_GAUSSIAN_NODE_WORDS + PRO_GAUSSIAN_NODE_FIRST];
        for (std::uint32_t i = words[PRO_GAUSSIAN_NODE_FIRST]; i < end; ++i)
            sum += gaussians.words[std::size_t{gaussians.lists[i]} * PRO_GAUSSIAN_WORDS];
        const std::uint32_t children = words[PRO_GAUSSIAN_NODE_CHILDREN];
        for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE && children != 0; ++slot)
            pending.push_back(children * PRO_GROUP_SIZE + slot);
    }
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        pro_gaussian each;
        pro_gaussian_at(&gaussians, view.splats, static_cast<std::uint32_t>(i), &each);
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(each.color[k]) || !(each.deviation[k] > 0) || !std::isfinite(each.deviation[k]))
                throw std::logic_error("a Gaussian that is not finite");
    }
    const std::size_t codes = std::size_t{info.splat_count} * 3 * pro_harmonic_count(gaussians.degree);
    for (std::size_t i = 0; i < codes; ++i) sum += static_cast<std::uint8_t>(gaussians.harmonics[i]);
    return sum;
}

/// Opens a copy in a heap block of the exact size, so that AddressSanitizer detects reads past the end; also verifies
/// it.
inline OpenResult openCopy(const Bytes& bytes, std::uint32_t open_flags = 0) {
    const std::unique_ptr<std::byte[]> copy(new std::byte[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    pro_file* file = nullptr;
    OpenResult opened{};
    opened.result = pro_open_memory(copy.get(), bytes.size(), open_flags, &file, &opened.message);
    const std::size_t findings = pro_verify_memory(copy.get(), bytes.size(), nullptr, nullptr);
    if (opened.result == PRO_OK) {
        pro_info info;
        pro_view view;
        pro_get_info(file, &info);
        pro_get_view(file, &view);
        [[maybe_unused]] static volatile std::uint64_t sink;
        sink = touchEverything(info, view);
        pro_index index;
        if (pro_get_index(file, &index)) sink = touchIndex(info, view, index);
        pro_gaussians gaussians;
        if (pro_get_gaussians(file, &gaussians)) sink = touchGaussians(info, view, gaussians);
        sink = touchSaid(info, file);
        pro_close(file);
    } else if (findings == 0) {
        throw std::logic_error("refused, yet without findings");
    }
    return opened;
}

/// Numbers of all findings of a verification, in order.
inline std::vector<std::uint32_t> findingsOf(const Bytes& bytes) {
    std::vector<std::uint32_t> numbers;
    const auto report = [](const pro_message* finding, void* user) {
        static_cast<std::vector<std::uint32_t>*>(user)->push_back(finding->finding);
    };
    pro_verify_memory(bytes.data(), bytes.size(), report, &numbers);
    return numbers;
}

inline bool has(const std::vector<std::uint32_t>& findings, std::uint32_t number) {
    return std::find(findings.begin(), findings.end(), number) != findings.end();
}

} // namespace pointrt::test
