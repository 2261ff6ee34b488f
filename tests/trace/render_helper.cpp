// SPDX-License-Identifier: Apache-2.0
#include "tests/trace/render_helper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <optional>

#include "pointrt/pro_index_layout.h"
#include "runtime/image/image_exr.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "tests/support/splat_scenes.h"

/// Options of AddressSanitizer, if it is linked in: drivers and layers leak memory and are unloaded, so that no
/// suppression can name them.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

namespace pointrt::test {

namespace {

/// One device for all tests, as creating one takes longer than most frames here. It is destroyed after the last test,
/// not when the program exits: by then the validation layer may have destroyed its own objects.
class SharedDevice : public testing::Environment {
public:
    void TearDown() override {
        if (device_) destroyDevice(*device_);
        device_.reset();
    }
    Device& get() {
        if (!device_) device_.emplace(createDevice({}));
        return *device_;
    }

private:
    std::optional<Device> device_;
};

/// Owned by GoogleTest.
auto* const shared_device = static_cast<SharedDevice*>(testing::AddGlobalTestEnvironment(new SharedDevice));

} // namespace

RenderSettings square(std::uint32_t size) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.spp = 1;
    settings.lights = 3;
    return settings;
}

Rendered renderScene(SceneDescription description, RenderSettings settings, FormRequest form,
                     std::uint32_t strip_rows) {
    Device& device = shared_device->get();
    settings.first_hits = true;
    LoadRequest request;
    request.scene = std::move(description);
    request.settings = settings;
    request.staging = settings.camera;
    request.form = form;
    const std::unique_ptr<LoadedScene> loaded = loadScene(device, device, request, {});
    const DeviceScene& scene = loaded->scene;
    Rendered rendered;
    rendered.form = loaded->tracer.programs.form;
    rendered.camera = loaded->camera;
    rendered.scene = scene.description;
    if (!scene.instances.empty()) {
        rendered.info = (*scene.files.begin()).info;
        rendered.cell_edge = 1 / (PRO_BRICK_SIDE * double{scene.instances[0].params.grid_scale.x});
    }
    rendered.params = makeFrameParams(scene, settings, rendered.camera, 0, settings.height);
    ProgressiveRenderer renderer(device, loaded->tracer);
    FrameJob job;
    job.samples = settings.spp;
    renderer.begin({settings, rendered.camera, tilingFor(device, settings.width, settings.height)}, job);
    while (strip_rows > 0 && renderer.openStrip(strip_rows))
        for (std::uint32_t passes = 0; !renderer.traceStrip(passes); passes = 1) continue;
    renderer.run();
    rendered.rays = renderer.takeRays();
    rendered.film = renderer.takeFilm();
    EXPECT_EQ(validationMessages(), 0u);
    return rendered;
}

Rendered renderFile(const std::string& path, RenderSettings settings) {
    SceneDescription scene;
    scene.instances.push_back({path, {}, {}, {}});
    return renderScene(std::move(scene), settings);
}

SphereFile::SphereFile(std::size_t splats) : path(temporaryPath("sphere.pro")) {
    writeScene(path, sphereSplats(splats, Vec3f(0, 0, 0), 1.0f), {});
}

SphereFile::~SphereFile() { std::remove(path.c_str()); }

SkyDescription evenSky(float radiance, float ambient) {
    SkyDescription sky;
    sky.zenith = sky.horizon = sky.ground = {radiance, radiance, radiance};
    sky.ambient = ambient;
    return sky;
}

SceneDescription splatBody(const std::string& path, const MaterialDescription& material) {
    SceneDescription scene;
    scene.materials = {material};
    scene.instances.push_back({path, {}, 0u, {}});
    scene.sky = evenSky(0);
    return scene;
}

SceneDescription analyticSphere(const MaterialDescription& material) {
    SceneDescription scene;
    scene.materials = {material};
    scene.shapes.push_back({ShapeKind::kSphere, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    scene.sky = evenSky(0);
    return scene;
}

std::string writeSky(const std::string& name, std::uint32_t height, const std::function<Color(Vec3)>& radiance) {
    const std::uint32_t width = 2 * height;
    std::vector<float> texels;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) { // shaders/shared/environment_layout.h
            const double theta = std::numbers::pi * (y + 0.5) / height,
                         phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
            const Color c =
                radiance({std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
            texels.insert(texels.end(), c.begin(), c.end());
        }
    const std::string path = temporaryPath(name);
    const std::array<ExrChannel, 3> channels{ExrChannel{"R", texels.data(), 3}, ExrChannel{"G", texels.data() + 1, 3},
                                             ExrChannel{"B", texels.data() + 2, 3}};
    writeExr(path, ExrSize{width, height}, channels);
    return path;
}

Color directionColor(Vec3 direction) {
    const auto half = [](double v) { return static_cast<float>(0.5 + 0.5 * v); };
    return {half(direction.x), half(direction.y), half(direction.z)};
}

Vec3 colorDirection(const Film& film, std::size_t i) {
    const float* c = film.rgba.data() + 4 * i;
    return {2.0 * c[0] - 1, 2.0 * c[1] - 1, 2.0 * c[2] - 1};
}

std::optional<double> meetSphere(Vec3 start, Vec3 direction) {
    const double along = dot(start, direction), half2 = along * along - dot(start, start) + 1;
    if (half2 < 0) return {};
    for (const double t : {-along - std::sqrt(half2), -along + std::sqrt(half2)})
        if (t > 0) return t;
    return {};
}

double angleBetween(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi; }

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return {sum / static_cast<double>(values.size()), at(0.5), at(0.99), values.back()};
}

float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel) {
    return film.rgba[4 * (std::size_t{y} * film.width + x) + static_cast<std::size_t>(channel)];
}

} // namespace pointrt::test
