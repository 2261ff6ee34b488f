// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/point_storage.h"

#include "preprocess/ingest/notes.h"

namespace pointrt {

void fillMissing(Cloud& cloud, const Columns& columns) {
    const std::size_t count = cloud.positions.size();
    if (!cloud.normals.empty()) cloud.normals.resize(count, Vec3f::Zero());
    if (!cloud.colors.empty()) cloud.colors.resize(count, kGreyColor);
    if (!cloud.radii.empty()) cloud.radii.resize(count, 0.0f);
    fillAttributes(cloud, columns);
    if (!cloud.sensor_of_point.empty()) cloud.sensor_of_point.resize(count, kNoSensor);
}

void noteBlack(Cloud& cloud, const InputFile& input) {
    addNote(cloud, input.name, "has colour fields, but all are black: it is read without colours");
}

} // namespace pointrt
