// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/scan_transform.h"

#include <cmath>

namespace pointrt {

void ScanTransform::update() {
    world_from_scan_ = world_from_input.value_or(Eigen::Affine3d::Identity());
    if (input_from_scan) {
        Eigen::Affine3d pose(input_from_scan->linear);
        pose.translation() = input_from_scan->translation;
        world_from_scan_ = world_from_scan_ * pose;
    }
    // Normals transform by the inverse transpose, which for a rotation is the rotation itself; using it keeps every
    // bit.
    const Eigen::Matrix3d linear = world_from_scan_.linear();
    mirrors_ = linear.determinant() < 0;
    const bool rigid = (linear * linear.transpose()).isIdentity(1e-9);
    normal_from_scan_ = rigid ? linear : Eigen::Matrix3d(linear.inverse().transpose());
}

Vec3f ScanTransform::normal(const Row& row) const {
    const Vec3d normal(row[kNormalX], row[kNormalY], row[kNormalZ]);
    if (!normal.allFinite()) return Vec3f::Zero();
    // Without a transform, normals are not multiplied, since that could change the sign of a zero.
    const bool moves = input_from_scan || world_from_input;
    const Vec3f rounded = (moves ? Vec3d(normal_from_scan_ * normal) : normal).cast<float>();
    return rounded.allFinite() ? rounded : Vec3f(Vec3f::Zero());
}

float ScanTransform::radius(const Row& row) const {
    const auto radius = static_cast<float>(row[kRadius] * std::cbrt(std::abs(world_from_scan_.linear().determinant())));
    return std::isfinite(radius) && radius > 0 ? radius : 0.0f;
}

} // namespace pointrt
