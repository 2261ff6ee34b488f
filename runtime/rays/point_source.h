// SPDX-License-Identifier: Apache-2.0
// The points of a study, read block by block.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "pointrt/studies.hpp"

namespace pointrt {

/// Points with their columns, and the data that rays from them need.
struct StudyBlock {
    PointBlock points;
    std::vector<float> normals, radii, noise; ///< each may be empty

    StudyPoints rows() const { return {points.positions, normals, radii, noise}; }
};

class PointSource {
public:
    /// A block is traced as one batch. It takes some 200 MB with its results.
    static constexpr std::size_t kPointsAtOnce = ScenePointReader::kPoints;

    virtual ~PointSource() = default;
    /// Includes the number of points and their bounds.
    virtual const PointOutline& outline() const = 0;
    /// Overwrites block with the next points. False at the end.
    virtual bool next(StudyBlock& block) = 0;
};

/// Whether a column is an attribute with one of these names.
bool isReplaced(const PointColumn& column, const std::vector<std::string>& names);

/// Opens the points of a .pro, tile set, scene file, LAS, LAZ or PLY file, NumPy array or text file, or those of the
/// scene if file is "". A file without a coordinate system inherits the scene's. Throws Error kBadInput "FILE: reason".
/// @param replaced columns that the results replace
std::unique_ptr<PointSource> openPoints(const std::string& file, const std::vector<std::string>& scene,
                                        const std::vector<std::string>& replaced);

} // namespace pointrt
