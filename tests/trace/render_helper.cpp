// SPDX-License-Identifier: Apache-2.0
#include "tests/trace/render_helper.h"

#include <gtest/gtest.h>

#include "runtime/camera.h"
#include "runtime/staging.h"
#include "shaders/brick_layout.h"

/// Read by AddressSanitizer where it is linked in: drivers and layers keep memory when they are unloaded, and then the
/// leak checker has no name to suppress them by.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

namespace pointrt::test {

namespace {

/// One device for the whole program: creating one takes longer than most frames here.
Device& sharedDevice() {
    static struct Owner {
        Device device = createDevice({});
        ~Owner() { destroyDevice(device); }
    } owner;
    return owner.device;
}

} // namespace

RenderSettings square(std::uint32_t size) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.spp = 1;
    settings.lights = 3;
    return settings;
}

Rendered renderScene(SceneDescription description, RenderSettings settings) {
    Device& device = sharedDevice();
    settings.first_hits = true;
    StagedScene scene = openScene(device, std::move(description), false);
    Rendered rendered;
    rendered.camera = frameCamera(settings.camera, scene.bounds.lo, scene.bounds.hi,
                                  static_cast<double>(settings.width) / settings.height);
    addSurroundings(scene.description, settings, rendered.camera, scene.bounds.lo, scene.bounds.hi);
    furnishScene(device, scene, settings);
    rendered.scene = scene.description;
    if (!scene.instances.empty()) {
        rendered.info = scene.files[0].info;
        rendered.cell_edge = 1 / (BRICK_SIDE * double{scene.instances[0].params.grid_scale.x});
    }
    rendered.params = makeFrameParams(scene, settings, rendered.camera, 0, settings.height);
    Tracer tracer = createTracer(device, scene, settings, rendered.camera);
    rendered.rays = renderFrame(device, tracer, {});
    rendered.film = readFilm(tracer);
    destroyTracer(device, tracer);
    destroyStagedScene(device, scene);
    EXPECT_EQ(validationMessages(), 0u);
    return rendered;
}

Rendered renderFile(const std::string& path, RenderSettings settings) {
    SceneDescription scene;
    scene.instances.push_back({path, {}, {}, {}});
    return renderScene(std::move(scene), settings);
}

float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel) {
    return film.rgba[4 * (std::size_t{y} * film.width + x) + static_cast<std::size_t>(channel)];
}

} // namespace pointrt::test
