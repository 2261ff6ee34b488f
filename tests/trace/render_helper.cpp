// SPDX-License-Identifier: Apache-2.0
#include "tests/trace/render_helper.h"

#include <gtest/gtest.h>

#include "runtime/camera.h"

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
    return settings;
}

Rendered renderFile(const std::string& path, RenderSettings settings) {
    Device& device = sharedDevice();
    settings.first_hits = true;
    Scene scene = loadScene(device, path, false);
    Rendered rendered;
    rendered.info = scene.info;
    const Vec3 lo{scene.info.bounds_min[0], scene.info.bounds_min[1], scene.info.bounds_min[2]};
    const Vec3 hi{scene.info.bounds_max[0], scene.info.bounds_max[1], scene.info.bounds_max[2]};
    rendered.camera = frameCamera(settings.camera, lo, hi, static_cast<double>(settings.width) / settings.height);
    rendered.params = makeFrameParams(scene, settings, rendered.camera, 0, settings.height);
    Tracer tracer = createTracer(device, scene, settings, rendered.camera);
    rendered.rays = renderFrame(device, tracer, {});
    rendered.film = readFilm(tracer);
    destroyTracer(device, tracer);
    destroyScene(device, scene);
    EXPECT_EQ(validationMessages(), 0u);
    return rendered;
}

float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel) {
    return film.rgba[4 * (std::size_t{y} * film.width + x) + static_cast<std::size_t>(channel)];
}

} // namespace pointrt::test
