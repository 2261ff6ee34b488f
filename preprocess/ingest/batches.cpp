// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/batches.h"

#include <algorithm>
#include <utility>

namespace pointrt {

BatchStorage::BatchStorage(Cloud& cloud, const Columns& columns, MeshPaint& paint, BatchOptions options)
    : PointStorage(cloud, columns, paint), options_(std::move(options)), handed_on_(options_.points_before) {
    if (options_.largest_color) findings_.largest_color = *options_.largest_color;
}

void removePoints(Cloud& cloud) {
    cloud.positions.clear();
    cloud.normals.clear();
    cloud.colors.clear();
    cloud.radii.clear();
    for (Attribute& attribute : cloud.attributes) attribute.values.clear();
    cloud.grids.clear();
}

std::size_t BatchStorage::lengthFor(std::uint64_t vertices) const {
    return std::min<std::uint64_t>(vertices, options_.points);
}

void BatchStorage::verticesAdded(CurrentScan& scan) {
    if (cloud_.positions.size() < (gathers_ ? options_.most_in_grid : options_.points)) return;
    gathers_ = false;
    handOn(scan);
}

/// The first pass only measures colours that must be scaled, and drops them.
void BatchStorage::scaleColors(CurrentScan& scan) {
    if (!scan.colors.waits()) return;
    auto& largest = findings_.largest_color;
    if (options_.largest_color) return scan.colors.scale(cloud_, scan.first_position, largest.at(scan.number));
    largest.resize(scan.number + 1);
    largest[scan.number] = std::max(largest[scan.number], scan.colors.largest(cloud_, scan.first_position));
    scan.colors.clear();
}

void BatchStorage::handOn(CurrentScan& scan) {
    if (cloud_.positions.empty()) return;
    scaleColors(scan);
    fillMissing(cloud_, columns_);
    for (const Vec3d& position : positions_) scan_box_.extend(position);
    options_.take({cloud_, positions_, scan.number, columns_.untyped});
    handed_on_ += positions_.size();
    positions_.clear();
    removePoints(cloud_);
}

void BatchStorage::finishScan(CurrentScan&, const InputFile& input) {
    if (!cloud_.triangles.empty()) refuse(input, "has faces, which cannot be read in batches");
}

void BatchStorage::releaseScan(CurrentScan& scan, const InputFile& input) {
    handOn(scan);
    auto& largest = findings_.largest_color;
    largest.resize(std::max(largest.size(), scan.number + 1));
    const bool is_black =
        scan.colors.waits() && scan.colors.is16Bit() && largest[scan.number] == 0 && count() > scan.points_before;
    if (is_black) noteBlack(cloud_, input);
    findings_.colors |= scan.traits.colors && !is_black;
}

} // namespace pointrt
