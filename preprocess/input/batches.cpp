// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/batches.h"

namespace pointrt {

void Batches::empty(Cloud& cloud) {
    positions.clear();
    cloud.positions.clear();
    cloud.normals.clear();
    cloud.colors.clear();
    cloud.radii.clear();
    for (Attribute& attribute : cloud.attributes) attribute.values.clear();
}

} // namespace pointrt
