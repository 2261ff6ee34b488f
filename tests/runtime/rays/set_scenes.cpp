// SPDX-License-Identifier: Apache-2.0
#include "tests/runtime/rays/set_scenes.h"

#include <cstring>
#include <numeric>

#include "tests/support/cloud_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

Attribute numbersUpTo(std::size_t count) {
    Attribute numbers{"number", Scalar::kU32, 1, std::vector<char>(count * sizeof(std::uint32_t))};
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 0u);
    std::memcpy(numbers.values.data(), values.data(), numbers.values.size());
    return numbers;
}

} // namespace

SphereInTiles::SphereInTiles() {
    Splats splats = sphereSplats(kSplats, Vec3f(0, 0, 0), static_cast<float>(kRadius));
    splats.origin = Vec3d(center.x, center.y, center.z);
    splats.input_count = kSplats;
    splat_radius = static_cast<double>(splats.radii[0]);
    for (const Vec3f& at : splats.positions) points.push_back(center + Vec3{at.x(), at.y(), at.z()});
    CloudSetOptions options;
    options.edge = 32;
    options.tiles.prune = false;
    set = writeCloudSet(tiles(), splats, {numbersUpTo(kSplats)}, options).set;
    writeScene(whole(), splats, {});
}

} // namespace pointrt::test
