// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/study/point_source.h"

#include "format/base/require_pro.h"
#include "runtime/rays/study/listed_points.h"
#include "runtime/rays/study/scene_points.h"

namespace pointrt {

std::unique_ptr<PointSource> openPoints(const std::string& file, const std::vector<std::string>& scene,
                                        const std::vector<std::string>& left_out) {
    if (file.empty()) return scenePoints(scene, left_out);
    if (file != "-" && beginsAsPro(file)) return scenePoints({file}, left_out);
    return listedPoints(file, scene.front());
}

} // namespace pointrt
