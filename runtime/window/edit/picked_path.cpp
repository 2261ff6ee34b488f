// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/picked_path.h"

#include "runtime/util/vec_array.h"

namespace pointrt {

MeasuredPath pickedPath(const std::vector<PickedPoint>& picks, Vec3 up) {
    MeasuredPath path;
    for (const PickedPoint& pick : picks) path.points.push_back(arrayOf(pick.position));
    path.measures = measurePath(path.points, arrayOf(up));
    return path;
}

} // namespace pointrt
