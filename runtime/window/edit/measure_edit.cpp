// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/measure_edit.h"

#include <utility>

namespace pointrt {

bool keepMeasurement(Workspace& work) {
    if (work.picks.size() < 2) return false;
    MeasureDescription measure;
    for (const PickedPoint& pick : work.picks) measure.points.push_back(pick.position);
    work.scene.measures.push_back(std::move(measure));
    work.picks.clear();
    return true;
}

} // namespace pointrt
