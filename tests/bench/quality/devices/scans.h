// SPDX-License-Identifier: Apache-2.0
// Scans of devices, and their files.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

/// A grid of samples in the device's frame: [rows][columns], NaN without a return.
struct GridScan {
    std::size_t rows = 0, columns = 0;
    std::vector<Vec3d> samples;
    Eigen::Isometry3d world_from_device = Eigen::Isometry3d::Identity(); ///< as the device believes
};

/// Several returns of an airborne scanner's pulse.
struct Return {
    Vec3d position;
    int number = 1, of = 1;
};

/// Whether there is a return.
inline bool isTaken(const Vec3d& sample) { return sample.allFinite(); }

/// Each throws Error (kCannotWrite).
/// FOLDER/scan.conf, and a PLY with a range grid for each scan, as in the Stanford archive.
void writeConf(const std::string& folder, const std::vector<GridScan>& scans);
/// An organised PCD in the device's frame.
void writeOrganizedPcd(const std::string& path, const GridScan& scan);
/// PTX: column by column, from the lowest row up; the pose as a matrix.
void writePtx(const std::string& path, const std::vector<GridScan>& scans);
/// LAS 1.2, points of format 1, millimetres.
void writeLas(const std::string& path, const std::vector<Return>& returns);
/// Binary, positions only.
void writePly(const std::string& path, const std::vector<Vec3d>& positions);

} // namespace pointrt::quality
