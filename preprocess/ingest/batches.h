// SPDX-License-Identifier: GPL-3.0-or-later
// Points handed on in batches while files are read, which bounds memory whatever their size. Properties of a whole
// scan, such as the scale of its colours, are found in a first pass over the files and used in a second.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/point_storage.h"

namespace pointrt {

/// Points of one scan.
struct PointBatch {
    /// Arrays shorter than `positions` are absent: normals, colours and radii if the file has none, attributes if all
    /// of their values are 0. If the cloud has a grid, the batch is a whole scan, the last of Cloud::scans; otherwise
    /// Cloud::positions must not be used.
    const Cloud& cloud;
    const std::vector<Vec3d>& positions; ///< input coordinates
    std::size_t scan = 0;                ///< its number
    /// Names of attributes for which no file has declared a type so far: Columns::untyped.
    const std::vector<std::string>& untyped;
};

/// The size of batches, and their receiver.
struct BatchOptions {
    std::size_t points = std::size_t{1} << 20; ///< a batch is handed on once it has this many points
    std::function<void(const PointBatch&)> take;
    /// The largest colour value of each scan, as a first pass found it; 0 for scans with 8-bit colours. Null in the
    /// first pass, whose batches have no colours but 8-bit ones.
    const std::vector<float>* largest_color = nullptr;
    std::uint64_t points_before = 0; ///< points handed on by an interrupted reading that this one resumes
    /// A scan with a grid is handed on as one batch if neither its cells nor its points exceed this number.
    std::uint64_t most_in_grid = std::uint64_t{1} << 24;
};

/// What a pass over the files finds about colours.
struct BatchFindings {
    std::vector<float> largest_color; ///< by scan, see BatchOptions
    bool colors = false;              ///< some scan has colours
};

/// Removes the points and grids; arrays keep their memory, and attributes their types.
void removePoints(Cloud& cloud);

/// Storage of a Sink that hands its points on.
class BatchStorage : public PointStorage {
public:
    BatchStorage(Cloud& cloud, const Columns& columns, MeshPaint& paint, BatchOptions options);

    std::uint64_t count() const override { return handed_on_ + cloud_.positions.size(); }
    bool keepsPoints() const override { return false; }
    bool gatherScan(std::uint64_t cells) override { return gathers_ = cells <= options_.most_in_grid; }
    bool holdsScan() const override { return gathers_; }
    std::size_t lengthFor(std::uint64_t vertices) const override;
    void beginScan() override {
        scan_box_.setEmpty();
        gathers_ = false;
    }
    void positionAdded(const Vec3d& position) override { positions_.push_back(position); }
    void verticesAdded(CurrentScan& scan) override;
    void finishScan(CurrentScan& scan, const InputFile& input) override;
    void releaseScan(CurrentScan& scan, const InputFile& input) override;
    ScanBox boxOf(const ScanRange&) const override { return {scan_box_.center(), scan_box_.sizes()}; }

    const BatchFindings& findings() const { return findings_; }

private:
    BatchOptions options_;
    BatchFindings findings_;
    std::vector<Vec3d> positions_; ///< of the next batch's points
    std::uint64_t handed_on_ = 0;  ///< points
    Eigen::AlignedBox3d scan_box_; ///< of the scan's points that were handed on
    bool gathers_ = false;         ///< the scan has a grid, and none of its points were handed on

    void scaleColors(CurrentScan& scan);
    void handOn(CurrentScan& scan);
};

} // namespace pointrt
