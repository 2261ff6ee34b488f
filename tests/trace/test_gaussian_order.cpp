// SPDX-License-Identifier: Apache-2.0
// Several captures in one scene: Gaussians of all files are composited in one common order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/gaussians/nasty_gaussians.h"
#include "tests/trace/gaussian_file.h"
#include "tests/trace/gaussian_picture.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr KernelForm kForms[] = {KernelForm::kWavefront, KernelForm::kMegakernel};

/// Every other Gaussian is in the second file, so that both alternate along rays.
struct TwoFiles {
    explicit TwoFiles(const std::vector<OracleGaussian>& all) : even(partOf(all, 0)), odd(partOf(all, 1)) {
        std::vector<OracleGaussian> both = even.scene.gaussians;
        both.insert(both.end(), odd.scene.gaussians.begin(), odd.scene.gaussians.end());
        scene = oracleScene(std::move(both));
    }

    static std::vector<OracleGaussian> partOf(const std::vector<OracleGaussian>& all, std::size_t which) {
        std::vector<OracleGaussian> part;
        for (std::size_t i = which; i < all.size(); i += 2) part.push_back(all[i]);
        return part;
    }

    SceneDescription description() const {
        SceneDescription description;
        description.instances = {{even.path, {}, {}, {}}, {odd.path, {}, {}, {}}};
        return description;
    }

    GaussianFile even, odd;
    OracleScene scene; ///< the Gaussians of both files
};

class GaussianOrder : public testing::TestWithParam<std::string> {};

TEST_P(GaussianOrder, OfTwoCapturesEqualsBruteForce) {
    const TwoFiles files(makeGaussians(GetParam(), 400));
    for (const Vec3 eye : {Vec3{0.3, 0.2, 4}, Vec3{0, 0, 0.1}}) {
        const RenderSettings settings = lookingFrom(eye, {0, 0, 0});
        for (const KernelForm form : kForms) {
            const Rendered rendered = renderScene(files.description(), settings, {form});
            EXPECT_EQ(rendered.rays.cut, 0u);
            const double psnr_db = psnrAgainst(rendered, settings, [&](Vec3 direction) {
                return lightOf(compositeAlong(files.scene, rendered.camera.eye, direction));
            });
            EXPECT_GT(psnr_db, 60) << "from " << eye.x << ", " << eye.y << ", " << eye.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Each, GaussianOrder, testing::Values("random", "giants", "needles", "inside", "duplicates"),
                         [](const auto& kind) { return kind.param; });

TEST(GaussianOrder, HoldsInMirrorsAndBeforeAndBehindSurfaces) {
    const TwoFiles files(makeGaussians("random", 400));
    SceneDescription scene = files.description();
    scene.materials.resize(2);
    scene.materials[0].kind = MaterialKind::kMirror;
    scene.materials[0].color = {1, 1, 1};
    scene.materials[1].color = {0, 0, 0};
    scene.materials[1].emission = {0.2f, 0.5f, 0.7f};
    const double mirror = 5, plane = 0.1; // among the Gaussians
    scene.shapes = {screenAt(mirror, 0), screenAt(plane, 1)};
    RenderSettings settings = lookingFrom({0, 0, 3}, {0, 0, mirror});
    settings.integrator = Integrator::kWhitted;
    for (const KernelForm form : kForms) {
        const Rendered rendered = renderScene(scene, settings, {form});
        const double psnr_db = psnrAgainst(rendered, settings, [&](Vec3 direction) {
            const Vec3 eye{rendered.camera.eye.x, rendered.camera.eye.y, 2 * mirror - rendered.camera.eye.z};
            const Vec3 mirrored{direction.x, direction.y, -direction.z};
            const OracleComposite before = compositeAlong(files.scene, eye, mirrored, (plane - eye.z) / mirrored.z);
            Color light = lightBefore(before);
            for (std::size_t c = 0; c < 3; ++c)
                light[c] += static_cast<float>(before.transmittance) * scene.materials[1].emission[c];
            return light;
        });
        EXPECT_GT(psnr_db, 60);
    }
}

/// Degree 0, so that rotating the Gaussians only rotates their axes.
std::vector<OracleGaussian> withoutHarmonics(std::vector<OracleGaussian> gaussians) {
    for (OracleGaussian& each : gaussians) each.harmonics.clear();
    return gaussians;
}

TEST(GaussianOrder, HoldsOfPlacedCaptures) {
    const std::vector<OracleGaussian> all = withoutHarmonics(makeGaussians("random", 300));
    // stored half as large, a quarter turn back about z, and 1 to the left of where the scene places them
    std::vector<OracleGaussian> stored = TwoFiles::partOf(all, 1);
    const double half = std::sqrt(0.5);
    for (OracleGaussian& each : stored) {
        const auto [x, y, z] = each.mean;
        each.mean = {0.5 * y, -0.5 * (x - 1), 0.5 * z};
        for (double& deviation : each.deviation) deviation *= 0.5;
        const auto [w, i, j, k] = each.rotation;
        each.rotation = {half * (w + k), half * (i + j), half * (j - i), half * (k - w)};
    }
    const GaussianFile even(TwoFiles::partOf(all, 0)), odd(stored);
    SceneDescription scene;
    scene.instances = {{even.path, {}, {}, {}}, {odd.path, {}, {}, {}}};
    Placement& placement = scene.instances[1].placement;
    placement.scale = 2;
    placement.translation = {1, 0, 0};
    placement.rotation = {Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};
    const OracleScene truth = oracleScene(all);
    const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
    const Rendered rendered = renderScene(scene, settings);
    EXPECT_GT(
        psnrAgainst(rendered, settings,
                    [&](Vec3 direction) { return lightOf(compositeAlong(truth, rendered.camera.eye, direction)); }),
        50); // of the input: the files round parameters
}

/// Number of first hits of a picture that differ from the expected ones, and of all.
struct FirstHitCounts {
    std::size_t hits = 0, elsewhere = 0, other_ids = 0;
};

FirstHitCounts countFirstHits(const TwoFiles& files, const Rendered& rendered, const RenderSettings& settings) {
    FirstHitCounts counts;
    const Vec3 eye = rendered.camera.eye;
    const auto evens = static_cast<std::uint32_t>(files.even.scene.gaussians.size());
    for (std::uint32_t i = 0; i < settings.width * settings.height; ++i) {
        const Vec3 direction = centerRayDirection(settings, rendered.camera, i % settings.width, i / settings.width);
        const double depth = compositeAlong(files.scene, eye, direction).depth;
        const bool is_hit = std::isfinite(depth);
        counts.hits += is_hit;
        const bool off = is_hit != std::isfinite(rendered.film.depth[i]) ||
                         (is_hit && std::abs(rendered.film.depth[i] - depth) > 1e-4);
        counts.elsewhere += off;
        if (off || !is_hit) continue;
        const std::uint32_t strongest = compositeAlong(files.scene, eye, direction, depth + 1e-6).strongest;
        const bool is_odd = rendered.film.instance_id[i] == 1;
        counts.other_ids += strongest != rendered.film.splat_id[i] + (is_odd ? evens : 0);
    }
    return counts;
}

TEST(GaussianOrder, FirstHitsAreThoseOfAllCaptures) {
    const TwoFiles files(makeGaussians("random", 400));
    const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
    const FirstHitCounts counts = countFirstHits(files, renderScene(files.description(), settings), settings);
    EXPECT_GT(counts.hits, 100u);
    EXPECT_LE(counts.elsewhere, counts.hits / 100); // where rounding moves a ray across the half
    EXPECT_LE(counts.other_ids, counts.hits / 100);
}

/// Share of a lamp's light that reaches the floor through a Gaussian in each of this many files.
double floorLight(std::size_t fogs, Integrator integrator, KernelForm form) {
    const GaussianFile near({roundGaussian({0, 1, 0}, 0.2, 0.5, {1, 1, 1})});
    const GaussianFile far({roundGaussian({0, 1.8, 0}, 0.2, 0.5, {1, 1, 1})});
    SceneDescription scene;
    if (fogs > 0) scene.instances.push_back({near.path, {}, {}, {}});
    if (fogs > 1) scene.instances.push_back({far.path, {}, {}, {}});
    scene.materials.resize(1);
    scene.shapes = {{ShapeKind::kPlane, {0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0}};
    scene.lights = {PointLight{{0, 3, 0}, {10, 10, 10}}};
    RenderSettings settings = lookingFrom({3, 0.5, 0}, {0, 0, 0}, 8); // all pixels see the same
    settings.spp = 16;
    settings.camera.fov_deg = 0.1;
    settings.integrator = integrator;
    const Rendered rendered = renderScene(scene, settings, {form});
    double sum = 0;
    for (std::uint32_t i = 0; i < 64; ++i) sum += pixel(rendered.film, i % 8, i / 8, 0);
    return sum / 64;
}

// Queued shadow rays pass or not at random; those stored by the megakernel are attenuated.
TEST(GaussianOrder, ShadowsOfCapturesMultiply) {
    for (const auto& [integrator, form] : {std::pair{Integrator::kPhong, KernelForm::kWavefront},
                                           std::pair{Integrator::kPath, KernelForm::kMegakernel}}) {
        const double lit = floorLight(0, integrator, form);
        EXPECT_GT(lit, 0.01);
        EXPECT_NEAR(floorLight(2, integrator, form) / lit, 0.25, 0.06); // see ShadowsAreAsDarkAsTheyAreOpaque
    }
}

} // namespace
} // namespace pointrt::test
