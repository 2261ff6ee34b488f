// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/bucket_layout.h"

namespace pointrt {

BucketLayout::BucketLayout(const PlanSchema& schema) {
    const auto take = [this](std::size_t bytes) {
        const std::size_t at = record_bytes;
        record_bytes += bytes;
        return at;
    };
    take(sizeof(Vec3f));
    normal = take(schema.normals ? sizeof(Vec3f) : 0);
    color = take(schema.colors ? sizeof(Rgb8) : 0);
    radius = take(schema.radii ? sizeof(float) : 0);
    noise = take(schema.noise ? sizeof(float) : 0);
    silhouette = take(schema.silhouettes ? 1 : 0);
    scan = take(schema.scan_bytes);
    const std::size_t stored = schema.attributes.size() - (schema.scan_attribute ? 1 : 0);
    for (std::size_t i = 0; i < stored; ++i) attributes.push_back(take(schema.attributes[i].bytesEach()));
}

} // namespace pointrt
