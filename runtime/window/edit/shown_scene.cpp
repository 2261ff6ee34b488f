// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/shown_scene.h"

#include <algorithm>
#include <utility>

#include "runtime/scene/default_lighting.h"
#include "runtime/session/settings.h"

namespace pointrt {
namespace {

/// "view 1", with the first unused number.
std::string freeViewName(const std::vector<NamedView>& views) {
    for (int number = 1;; ++number) {
        const std::string name = "view " + std::to_string(number);
        if (std::none_of(views.begin(), views.end(), [&](const NamedView& view) { return view.name == name; }))
            return name;
    }
}

/// The choice to save. With kAuto, pictures with enough samples are not denoised, as in the window.
DenoiseChoice denoiseChoice(const Workspace& work) {
    StudioSubject subject;
    subject.only_gaussians = work.only_gaussians;
    if (!work.denoise) return DenoiseChoice::kOff;
    return isNoisy(work.settings, work.scene, subject) ? DenoiseChoice::kAuto : DenoiseChoice::kOn;
}

} // namespace

SceneDescription sceneAsShown(const Workspace& work, PixelSize size) {
    RenderSettings settings = work.settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.spp = work.target_samples;
    settings.denoise = denoiseChoice(work);
    settings.exposure = work.look.exposure;
    settings.camera = requestOf(work.camera);
    SceneDescription scene = work.scene;
    scene.up = sceneUp(work.scene, work.settings); // not the current camera's
    ownSurroundings(scene, settings);
    return describeRun(std::move(scene), settings, settings.camera.eye.value());
}

void saveView(Workspace& work) {
    std::vector<NamedView>& views = work.scene.views;
    const std::string name = work.view_name.empty() ? freeViewName(views) : work.view_name;
    std::erase_if(views, [&](const NamedView& view) { return view.name == name; });
    views.push_back({name, requestOf(work.camera)});
    work.view_name.clear();
}

} // namespace pointrt
