// SPDX-License-Identifier: Apache-2.0
#include "pointrt/studies.hpp"
#include "runtime/cast/translated.h"
#include "runtime/studies/instance_points.h"

namespace pointrt {

ScanPoints scanPoints(const std::string& path) {
    return translated([&] {
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        ScanPoints points;
        points.oriented = (file.info().flags & PRO_FLAG_ORIENTED) != 0;
        for (std::size_t i = 0; i < file.info().splat_count; ++i) addPoint(file, i, {}, points);
        return points;
    });
}

} // namespace pointrt
