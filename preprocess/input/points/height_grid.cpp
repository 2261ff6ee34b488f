// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/height_grid.h"

#include <utility>

namespace pointrt {

void finishHeights(const InputFile& input, std::uint64_t missing, std::uint64_t cells, WorldFrame frame, Sink& sink) {
    if (missing > 0) sink.note(input, fmt::format("{} of {} cells have no data and are left out", missing, cells));
    sink.finishScan(input);
    frame.up = Vec3d::UnitZ();
    frame.from_above = true; // heights show surfaces from above, however they were measured
    sink.setWorldFrame(input, std::move(frame));
}

} // namespace pointrt
