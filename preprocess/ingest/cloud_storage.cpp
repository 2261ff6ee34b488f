// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/cloud_storage.h"

namespace pointrt {

void CloudStorage::finishScan(CurrentScan& scan, const InputFile& input) {
    if (count() > scan.points_before) origin_.finish(cloud_);
    scaleColors(scan, input);
    scan.faces.finish(cloud_, input, scan.vertices);
}

void CloudStorage::scaleColors(CurrentScan& scan, const InputFile& input) {
    if (!scan.colors.waits()) return;
    const float largest = scan.colors.largest(cloud_, scan.first_position);
    // Points without colours become grey if another scan has some.
    const bool is_black = scan.colors.is16Bit() && largest == 0;
    if (is_black && cloud_.positions.size() > scan.first_position) noteBlack(cloud_, input);
    scan.colors.scale(cloud_, scan.first_position, largest);
}

ScanBox CloudStorage::boxOf(const ScanRange& last_scan) const {
    Eigen::AlignedBox3f box;
    for (std::size_t i = last_scan.first_position; i < cloud_.positions.size(); ++i) box.extend(cloud_.positions[i]);
    return {cloud_.origin + box.center().cast<double>(), box.sizes().cast<double>()};
}

} // namespace pointrt
