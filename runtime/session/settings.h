// SPDX-License-Identifier: Apache-2.0
// Where the command line and a scene file meet.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"
#include "runtime/session/options.h"

namespace pointrt {

/// The scene that options.scene names: a scene file, or a .pro that stands alone. Throws Error as readSceneFile does.
SceneDescription describeScene(const Options& options);

/// The command line's word, else the scene file's, else the default; of the camera's parts, each by itself. Samples are
/// as many as can be where limits are given and --spp is not. Throws Error kBadUsage for a view that is not there.
RenderSettings resolveSettings(const Options& options, const SceneDescription& scene);

/// The other way round: scene with all that settings say in it, so that its file shows the same picture. scene: without
/// what addSurroundings has added for the eye staged_for.
SceneDescription describeRun(SceneDescription scene, const RenderSettings& settings, Vec3 staged_for);

/// The side of every scene that options.view names, but for a view of the scene that has that name.
std::optional<StandardView> standardView(const Options& options, const SceneDescription& scene);

/// From here on noise is hardly seen, and what the denoiser takes off is detail.
constexpr std::uint32_t kCleanSamplesOfLight = 256;

/// True where samples of a pixel differ by more than its edges.
bool isNoisy(const RenderSettings& settings, const SceneDescription& scene);

/// True where the denoiser is to run on a picture with this many samples a pixel. scene: with its surroundings.
bool wantsDenoising(const Options& options, const RenderSettings& settings, const SceneDescription& scene,
                    std::uint32_t samples);

} // namespace pointrt
