// SPDX-License-Identifier: GPL-3.0-or-later
// Splats and octree to a .pro.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "preprocess/octree/octree.h"

namespace pointrt {

using MaterialRow = std::array<float, PRO_MATERIAL_FLOATS>;

/// What scans are made of: their own colours or a pale plaster, with a soft highlight.
/// @param reflectivity 0 to 1
MaterialRow scanMaterial(bool has_color, float reflectivity);

/// What the file holds besides splats and octree.
struct ProContent {
    std::vector<MaterialRow> materials; ///< 1 to 256 rows; splats name theirs
    std::vector<Attribute> attributes;  ///< of the splats; names that fit (carry_attributes.h)
    std::vector<double> sensors;        ///< PRO_SENSOR_DOUBLES a scan, or empty
    WorldFrame world;
    std::string metadata; ///< JSON
    bool pruned = false;
};

struct OctreeCounts {
    std::uint64_t nodes = 0;                                              ///< inner nodes and leaves, padding left out
    std::uint64_t filled_leaves = 0, border_leaves = 0, empty_leaves = 0; ///< border leaves are filled ones
    std::uint64_t references = 0;                                         ///< members included
    std::uint32_t max_depth = 0;
    std::uint64_t file_bytes = 0;
};

/// All sections but the index, for pro_write; points into what it was made of, too.
struct ProSections {
    pro_info info{};
    pro_view view{};
    std::vector<std::uint32_t> nodes, leaves;
    pro_world world{};
    pro_sampling sampling{};
    std::vector<pro_attribute> attributes;
};
ProSections makeSections(const PackedSplats& splats, const Octree& octree, const ProContent& content);

/// Writes path, with overwrite over what is there. Throws Error (kCannotWrite, or kBadInput where the cloud's scale
/// does not fit the format) and leaves nothing behind on failure.
/// @param index may be null
OctreeCounts writePro(const std::string& path, bool overwrite, const ProSections& sections, const pro_index* index);

} // namespace pointrt
