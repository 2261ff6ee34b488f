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
        {"--memory", options.memory && !scene.has_tiles, "there are no tiles, of which it says how many may be held"},
        {"--detail", said.detail && !scene.has_tiles, "there are no tiles to be coarser"},
        {"--lights", said.lights && !scene.shows_light, "the picture shows no light"},
        {"--bounces", said.bounces.value_or(0) > 0 && scene.shows_light && !scene.sends_on,
         "nothing here reflects or refracts; --integrator path lets all surfaces light each other"},
        {"--bounces", said.bounces && !scene.shows_light, "the picture shows no light"},
    };
    std::vector<std::string> lines;
    for (const auto& [option, without_effect, why] : kOptions)
        if (without_effect) lines.push_back(std::string(option) + " changes nothing: " + why);
    return lines;
}

} // namespace pointrt
