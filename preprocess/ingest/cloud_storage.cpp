// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/cloud_storage.h"

#include <algorithm>

namespace pointrt {

void CloudStorage::finishScan(CurrentScan& scan, const InputFile& input) {
    if (count() > scan.points_before) origin_.finish(cloud_);
    if (scan.colors.waits())
        scan.colors.scale(cloud_, scan.first_position, scan.colors.largest(cloud_, scan.first_position));
    if (scan.traits.colors) dropBlack(scan, input);
    scan.faces.finish(cloud_, input, scan.vertices, paint_);
}

/// A scan whose colours are all black counts as a scan without colours: its points become grey if another scan has
/// colours.
void CloudStorage::dropBlack(CurrentScan& scan, const InputFile& input) {
    const auto first = cloud_.colors.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
    const bool black = std::all_of(first, cloud_.colors.end(), [](const Rgb8& color) { return color == Rgb8{}; });
    has_colors_ = has_colors_ || !black;
    if (!black) return;
    if (cloud_.positions.size() > scan.first_position) noteBlack(cloud_, input);
    cloud_.colors.resize(has_colors_ ? scan.first_position : 0);
}

ScanBox CloudStorage::boxOf(const ScanRange& last_scan) const {
    Eigen::AlignedBox3f box;
    for (std::size_t i = last_scan.first_position; i < cloud_.positions.size(); ++i) box.extend(cloud_.positions[i]);
    return {cloud_.origin + box.center().cast<double>(), box.sizes().cast<double>()};
}

} // namespace pointrt
