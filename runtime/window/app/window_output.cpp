// SPDX-License-Identifier: Apache-2.0
// Files that the window writes.
#include <imgui.h>

#include <filesystem>

#include "format/base/error.h"
#include "runtime/film/film_signature.h"
#include "runtime/image/image_png.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene_file/scene_write.h"
#include "runtime/session/settings.h"
#include "runtime/window/app/window_state.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxNumber = 9999;

/// "statue-1", the first number for which there is no file with one of the endings in the working directory.
std::string freeName(const std::string& stem, const std::vector<std::string>& endings) {
    for (int number = 1; number <= kMaxNumber; ++number) {
        const std::string name = stem + "-" + std::to_string(number);
        bool taken = false;
        std::error_code ignored; // what cannot even be looked for will not be written, which says why
        for (const std::string& ending : endings) taken |= fs::exists(name + ending, ignored);
        if (!taken) return name;
    }
    throw Error{ExitCode::kCannotWrite, stem + "-1 to " + stem + "-" + std::to_string(kMaxNumber) + " are all taken"};
}

std::string stemOf(const std::string& path) {
    const std::string stem = fs::path(path).stem().string();
    return stem.empty() ? "picture" : stem;
}

} // namespace

/// What renders the picture on the screen, headless.
SceneDescription Window::sceneAsShown() const {
    RenderSettings settings = work_.settings;
    settings.width = host_.pixels().width;
    settings.height = host_.pixels().height;
    settings.spp = work_.samples_wanted;
    const bool filtered = work_.denoise && work_.samples_wanted < kCleanSamplesOfLight;
    settings.denoise = filtered ? DenoiseChoice::kOn : DenoiseChoice::kOff;
    settings.exposure = work_.look.exposure;
    settings.camera = requestOf(work_.camera);
    SceneDescription scene = work_.scene;
    scene.up = sceneUp(work_.scene, work_.settings); // not that of the camera as it is now
    ownSurroundings(scene, settings);
    return describeRun(std::move(scene), settings, settings.camera.eye.value());
}

void Window::takeScreenshot() {
    screenshot_wanted_ = false;
    try {
        const std::string name = freeName(stemOf(work_.scene.path), {".png", ".exr"});
        const std::uint32_t samples = live_->progress().samples;
        const std::string signature = filmSignature(loaded_->scene, live_->view().settings, live_->view().camera);
        save_ = std::make_unique<SaveJob>(
            host_.device(), name, SavedFilm{live_->readFilm(), samples, work_.settings.seed, signature},
            SaveLook{work_.look.exposure, work_.denoise && samples < kCleanSamplesOfLight});
    } catch (const Error& error) {
        tell(error.what(), true);
    }
}

/// The window as it is, with its interface.
void Window::takeFrame(const std::string& name) {
    writePng(name + ".png", readFrame(host_.device(), host_.presenter(), ImGui::GetDrawData()));
}

void Window::saveScene() {
    try {
        const std::string path = freeName(stemOf(work_.scene.path), {".toml"}) + ".toml";
        writeSceneFile(path, sceneAsShown());
        tell("saved " + path + "; pointrt-view " + path + " -o picture.png renders it");
    } catch (const Error& error) {
        tell(error.what(), true);
    }
}

void Window::saveView() {
    std::string name = work_.view_name;
    for (int number = 1; name.empty(); ++number) {
        name = "view " + std::to_string(number);
        for (const NamedView& view : work_.scene.views)
            if (view.name == name) name.clear();
    }
    std::erase_if(work_.scene.views, [&](const NamedView& view) { return view.name == name; });
    work_.scene.views.push_back({name, requestOf(work_.camera)});
    work_.view_name.clear();
}

void Window::startTurntable(std::uint32_t pictures) {
    if (turntable_) return;
    try {
        turntable_ = std::make_unique<TurntableJob>(sceneAsShown(), work_.turntable_path, pictures, options_.device);
    } catch (const Error& error) {
        tell(error.what(), true);
    }
}

} // namespace pointrt
