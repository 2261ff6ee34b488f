// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "runtime/scene_file/read_parts.h"

namespace pointrt {
namespace {

template <typename Number>
void takeOptional(const SceneValue& table, std::string_view key, Range range, std::optional<Number>& number) {
    if (const auto value = find(table, key)) number = static_cast<Number>(numberOf(*value, range));
}

void takeOptional(const SceneValue& table, std::string_view key, std::optional<bool>& flag) {
    if (const auto value = find(table, key)) flag = flagOf(*value);
}

void readSize(const SceneValue& size, SceneDescription& scene) {
    if (!size.node->is_array() || size.node->as_array()->size() != 2) refuse(size, "must be [width, height]");
    const std::vector<SceneValue> sides = elementsOf(size);
    scene.width = wholeNumberOf(sides[0], 1, 16384);
    scene.height = wholeNumberOf(sides[1], 1, 16384);
}

/// How much is traced.
void readEffort(const SceneValue& table, SceneDescription& scene) {
    constexpr Integrator integrators[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath,
                                          Integrator::kNormal, Integrator::kDepth};
    if (const auto name = find(table, "integrator"))
        scene.integrator = integrators[choiceOf(*name, {"phong", "whitted", "path", "normal", "depth"})];
    if (const auto bounces = find(table, "bounces")) scene.bounces = wholeNumberOf(*bounces, 0, 64);
    if (const auto spp = find(table, "spp")) scene.spp = wholeNumberOf(*spp, 1, 65536);
    if (const auto size = find(table, "size")) readSize(*size, scene);
    if (const auto seed = find(table, "seed"))
        scene.seed = wholeNumberOf(*seed, 0, std::numeric_limits<std::uint32_t>::max());
}

/// What is seen of it.
void readLook(const SceneValue& table, SceneDescription& scene) {
    constexpr DenoiseChoice choices[] = {DenoiseChoice::kOn, DenoiseChoice::kOff, DenoiseChoice::kAuto};
    if (const auto denoise = find(table, "denoise")) scene.denoise = choices[choiceOf(*denoise, {"on", "off", "auto"})];
    if (const auto lights = find(table, "lights")) scene.ring_lights = wholeNumberOf(*lights, 0, 16);
    takeOptional(table, "exposure", {-20, 20}, scene.exposure);
    takeOptional(table, "reflectivity", kShare, scene.reflectivity);
    takeOptional(table, "shadows", scene.shadows);
    takeOptional(table, "caustics", scene.caustics);
    takeOptional(table, "blend", scene.blend);
}

} // namespace

// within the limits of the command line (options.cpp)
void readRender(const SceneValue& file, SceneDescription& scene) {
    const auto table = findTable(file, "render");
    if (!table) return;
    requireKnownKeys(*table, "render",
                     {"integrator", "bounces", "spp", "size", "seed", "denoise", "exposure", "lights", "shadows",
                      "caustics", "blend", "reflectivity"});
    readEffort(*table, scene);
    readLook(*table, scene);
}

} // namespace pointrt
