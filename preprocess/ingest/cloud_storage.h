// SPDX-License-Identifier: GPL-3.0-or-later
// Storage of a Sink whose cloud keeps all points.
#pragma once

#include "preprocess/ingest/cloud_origin.h"
#include "preprocess/ingest/point_storage.h"

namespace pointrt {

class CloudStorage : public PointStorage {
public:
    using PointStorage::PointStorage;

    std::uint64_t count() const override { return cloud_.positions.size(); }
    bool keepsPoints() const override { return true; }
    bool gatherScan(std::uint64_t) override { return true; }
    bool holdsScan() const override { return true; }
    std::size_t lengthFor(std::uint64_t vertices) const override { return cloud_.positions.size() + vertices; }
    void positionAdded(const Vec3d& position) override { origin_.add(cloud_, position); }
    void finishScan(CurrentScan& scan, const InputFile& input) override;
    ScanBox boxOf(const ScanRange& last_scan) const override;

private:
    OriginChooser origin_;

    bool has_colors_ = false; ///< some scan so far has colours that are not all black

    void dropBlack(CurrentScan& scan, const InputFile& input);
};

} // namespace pointrt
