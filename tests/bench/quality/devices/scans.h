// SPDX-License-Identifier: Apache-2.0
// What devices deliver, and the files it comes in.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

/// Samples as they lie beside each other: [rows][columns], NaN where nothing came back. In the device's own frame.
struct GridScan {
    std::size_t rows = 0, columns = 0;
    std::vector<Vec3d> samples;
    Eigen::Isometry3d world_from_device = Eigen::Isometry3d::Identity(); ///< as the device believes it stood
};

/// An airborne scanner's pulse came back as several.
struct Return {
    Vec3d position;
    int number = 1, of = 1;
};

/// Whether a sample is there.
inline bool isTaken(const Vec3d& sample) { return sample.allFinite(); }

/// Each throws Error (kCannotWrite).
/// FOLDER/scan.conf, and beside it a PLY with a range grid for each scan, as the Stanford archive has them.
void writeConf(const std::string& folder, const std::vector<GridScan>& scans);
/// An organized PCD with the device's frame as world.
void writeOrganizedPcd(const std::string& path, const GridScan& scan);
/// Column after column, from the lowest row up, as PTX files have them; the pose as matrix.
void writePtx(const std::string& path, const std::vector<GridScan>& scans);
/// LAS 1.2, points of format 1, millimetres.
void writeLas(const std::string& path, const std::vector<Return>& returns);
/// Binary, positions alone.
void writePly(const std::string& path, const std::vector<Vec3d>& positions);

} // namespace pointrt::quality
