// SPDX-License-Identifier: GPL-3.0-or-later
// Where a Sink stores points that passed its filter: the cloud keeps them all, or batches are handed on.
#pragma once

#include <cstdint>
#include <limits>

#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/scan_colors.h"
#include "preprocess/ingest/scan_faces.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

/// As many points as 32-bit indices distinguish beside kNoSensor.
inline constexpr std::uint64_t kMaxPoints = kNoSensor - 1;

/// The scan that is being read.
struct CurrentScan {
    std::size_t number = 0; ///< among all scans
    ScanTraits traits;
    std::uint64_t vertices = 0;      ///< read so far, including dropped ones
    std::uint64_t non_finite = 0;    ///< of them, dropped as not finite
    std::uint64_t withheld = 0;      ///< of them, dropped as withheld
    std::uint64_t no_data = 0;       ///< of them, dropped as without data
    std::size_t first_position = 0;  ///< index of the scan's first point in the cloud
    std::uint64_t points_before = 0; ///< points stored before this scan
    std::optional<Vec3d> sensor;     ///< scanner position in the scan's frame
    ScanColors colors;
    ScanFaces faces;
};

class PointStorage {
public:
    PointStorage(Cloud& cloud, const Columns& columns, MeshPaint& paint)
        : cloud_(cloud), columns_(columns), paint_(paint) {}
    PointStorage(const PointStorage&) = delete;
    PointStorage& operator=(const PointStorage&) = delete;
    virtual ~PointStorage() = default;

    /// Points stored so far, of all scans.
    virtual std::uint64_t count() const = 0;
    /// Whether the cloud keeps all points: only then may it have faces and a sensor for each point.
    virtual bool keepsPoints() const = 0;
    /// Requests to keep the points of the current scan until it is finished, because it has a grid. Returns false if
    /// they may take too much memory.
    virtual bool gatherScan(std::uint64_t cells) = 0;
    /// Whether all points of the current scan are still in the cloud.
    virtual bool holdsScan() const = 0;
    /// The array length to reserve when a scan of this many vertices begins.
    virtual std::size_t lengthFor(std::uint64_t vertices) const = 0;
    virtual void beginScan() {}
    /// Called after a position went to the cloud.
    virtual void positionAdded(const Vec3d& position) = 0;
    /// Called after all values of one or more vertices went to the cloud.
    virtual void verticesAdded(CurrentScan&) {}
    /// Completes a scan: scales its colours and converts its faces.
    virtual void finishScan(CurrentScan& scan, const InputFile& input) = 0;
    /// Called last, when the cloud has the scan with its sensor and grid.
    virtual void releaseScan(CurrentScan&, const InputFile&) {}
    /// Box of the scan finished last.
    virtual ScanBox boxOf(const ScanRange& last_scan) const = 0;

protected:
    Cloud& cloud_;
    const Columns& columns_;
    MeshPaint& paint_;
};

/// Fills arrays and attributes up to the number of positions, for points of scans without them.
void fillMissing(Cloud& cloud, const Columns& columns);

/// Adds a note that all colours of a scan are black and therefore ignored.
void noteBlack(Cloud& cloud, const InputFile& input);

} // namespace pointrt
