// SPDX-License-Identifier: Apache-2.0
// The points that a study is made of, block by block.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "pointrt/studies.hpp"

namespace pointrt {

/// Points with their own columns, and what the study has to know of them.
struct StudyBlock {
    PointBlock points;
    std::vector<float> normals, radii, noise; ///< each may be empty

    StudyPoints rows() const { return {points.positions, normals, radii, noise}; }
};

class PointSource {
public:
    /// A block is traced as one batch; some 200 MB with all that is made of it.
    static constexpr std::size_t kPointsAtOnce = ScenePointReader::kPoints;

    virtual ~PointSource() = default;
    /// With the number of points; positions are in the bounds.
    virtual const PointOutline& outline() const = 0;
    /// The next points in place of those in block; false where there are none any more.
    virtual bool next(StudyBlock& block) = 0;
};

/// Whether a column is an attribute of one of these names.
bool isLeftOut(const PointColumn& column, const std::vector<std::string>& names);

/// The points of file: a .pro, a tile set, a scene file, LAS, LAZ, PLY, a list of text or an array; of the scene where
/// it is "". What a file does not say of its coordinates is as in the scene. Throws Error kBadInput "FILE: reason".
/// @param left_out columns that the results bring anew
std::unique_ptr<PointSource> openPoints(const std::string& file, const std::vector<std::string>& scene,
                                        const std::vector<std::string>& left_out);

} // namespace pointrt
