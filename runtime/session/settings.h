// SPDX-License-Identifier: Apache-2.0
// Merges the command line with the scene file.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/image/tonemap.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"
#include "runtime/session/options.h"

namespace pointrt {

/// The scene of options.scene: a scene file, or a single scan. Throws Error as readSceneFile does.
SceneDescription describeScene(const Options& options);

/// Each setting, and each part of the camera, from the command line, else from the scene file, else its default. With
/// --time-limit or --noise and without --spp the number of samples is kMaxSpp. Throws Error kBadUsage for an unknown
/// view, and as requireColored does unless colours are left to the scan.
RenderSettings resolveSettings(const Options& options, const SceneDescription& scene);

/// The first option for colours by value, see requireColored; null if there is none.
const char* colorOption(const RenderChoices& said);

/// Whether scans without colours are coloured by default (defaultColors): neither a scene file nor an option decides.
bool leavesColors(const Options& options);

/// The reverse: scene with these settings, so that its scene file gives the same picture. scene: without the additions
/// of addSurroundings; staged_for: the eye for which the surroundings were placed
SceneDescription describeRun(SceneDescription scene, const RenderSettings& settings, Vec3 staged_for);

/// The standard view of options.view, unless the scene has a view of that name.
std::optional<StandardView> standardView(const Options& options, const SceneDescription& scene);

/// With this many samples or more, noise is hardly visible and the denoiser would remove detail.
constexpr std::uint32_t kCleanSamplesOfLight = 256;

/// True if samples of a pixel differ by more than antialiasing: random light paths, soft shadows. Samples of Gaussian
/// captures do not: their radiance is stored, and nothing else scatters light.
bool isNoisy(const RenderSettings& settings, const SceneDescription& scene, const StudioSubject& subject = {});

/// True if a picture with this many samples per pixel is to be denoised. scene: with its surroundings
bool wantsDenoising(const Options& options, const RenderSettings& settings, const SceneDescription& scene,
                    std::uint32_t samples, const StudioSubject& subject = {});

/// How PNGs and the window show the scene's light. scene: with its surroundings. Pictures with a plain background get
/// no tone curve: a capture's colours come from photographs, to which a curve has already been applied.
ToneMapping toneMapping(const SceneDescription& scene, float stops);

} // namespace pointrt
