// SPDX-License-Identifier: GPL-3.0-or-later
// The transform of a scan's vertices to the world: the scan's pose, then the transform of all inputs.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

class ScanTransform {
public:
    std::optional<Eigen::Affine3d> world_from_input; ///< of all files; applied after their poses
    std::optional<Pose> input_from_scan;             ///< of the scan to be read next

    /// Combines the two transforms; called when a scan begins.
    void update();

    Vec3d position(const Vec3d& in_scan) const { return world_from_scan_ * in_scan; }
    Vec3d position(const Row& row) const { return position(Vec3d(row[kX], row[kY], row[kZ])); }
    /// The linear part of the transform, without the translation.
    Eigen::Matrix3d linear() const { return world_from_scan_.linear(); }
    /// Whether it turns left hands into right ones.
    bool mirrors() const { return mirrors_; }
    Eigen::Affine3d scanFromWorld() const { return world_from_scan_.inverse(); }
    /// Zero if the normal is not finite.
    Vec3f normal(const Row& row) const;
    /// Zero, which marks a missing radius, unless it is finite and above 0.
    float radius(const Row& row) const;

private:
    Eigen::Affine3d world_from_scan_ = Eigen::Affine3d::Identity();
    bool mirrors_ = false;
    Eigen::Matrix3d normal_from_scan_ = Eigen::Matrix3d::Identity();
};

} // namespace pointrt
