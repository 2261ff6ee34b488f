// SPDX-License-Identifier: GPL-3.0-or-later
// Writes splats and octree to a .pro.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "preprocess/octree/octree.h"

namespace pointrt {

using MaterialRow = std::array<float, PRO_MATERIAL_FLOATS>;

/// The material of scans: their own colours or pale plaster, with a soft highlight.
/// @param reflectivity 0 to 1
MaterialRow scanMaterial(bool has_color, float reflectivity);

/// Content of the file besides splats and octree.
struct ProContent {
    std::vector<MaterialRow> materials; ///< 1 to 256 rows
    std::vector<Attribute> attributes;  ///< in the order of the splats, with valid names (splat_attributes.h)
    std::vector<double> sensors;        ///< PRO_SENSOR_DOUBLES per scan, or empty
    WorldFrame world;
    std::string metadata; ///< JSON
    bool pruned = false;
};

struct OctreeCounts {
    std::uint64_t nodes = 0;                                              ///< inner nodes and leaves, without padding
    std::uint64_t filled_leaves = 0, border_leaves = 0, empty_leaves = 0; ///< border leaves are filled, too
    std::uint64_t references = 0;                                         ///< including members
    std::uint32_t max_depth = 0;
    std::uint64_t file_bytes = 0;
};

/// All sections but the index, for pro_write_content. Also points into its sources.
struct ProSections {
    pro_info info{};
    pro_view view{};
    std::vector<std::uint32_t> nodes, leaves;
    pro_world world{};
    pro_sampling sampling{};
    std::vector<pro_attribute> attributes;
};
ProSections makeSections(const PackedSplats& splats, const Octree& octree, const ProContent& content);

/// Writes path atomically. Throws Error (kCannotWrite, or kBadInput if the scale of the cloud does not fit the format).
/// @param overwrite replace an existing file
/// @param index may be null
/// @param gaussians may be null; such a file has no index
OctreeCounts writePro(const std::string& path, bool overwrite, const ProSections& sections, const pro_index* index,
                      const pro_gaussians* gaussians = nullptr);

} // namespace pointrt
