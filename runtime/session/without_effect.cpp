// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/without_effect.h"

namespace pointrt {

std::vector<std::string> optionsWithoutEffect(const Options& options, const SceneTraits& scene) {
    const RenderChoices& said = options.choices;
    const struct {
        const char* option;
        bool without_effect;
        const char* why;
    } kOptions[] = {
        {"--memory", options.memory && !scene.has_tiles, "the scene has no tile sets"},
        {"--detail", said.detail && !scene.has_tiles, "the scene has no tile sets"},
        {"--lights", said.lights && !scene.uses_lights, "the integrator uses no lights"},
        {"--bounces", said.bounces.value_or(0) > 0 && scene.uses_lights && !scene.has_secondary_rays,
         "no surface reflects or refracts; use --integrator path for global illumination"},
        {"--bounces", said.bounces && !scene.uses_lights, "the integrator uses no lights"},
    };
    std::vector<std::string> lines;
    for (const auto& [option, without_effect, why] : kOptions)
        if (without_effect) lines.push_back(std::string(option) + " has no effect: " + why);
    if (options.traversal == Traversal::kHardware && scene.has_walked)
        lines.emplace_back("--rays hardware: tile sets, Gaussians and scans too large for one buffer are walked");
    return lines;
}

} // namespace pointrt
