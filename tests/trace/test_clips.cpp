// SPDX-License-Identifier: Apache-2.0
// Clipped pictures: depths are those of the surfaces that remain, and light of all kinds is that of a scan from which
// the splats have been taken away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "tests/gaussians/nasty_gaussians.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/gaussian_file.h"
#include "tests/trace/gaussian_picture.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kCutSplats = 30'000;
const FormRequest kBothForms[] = {{KernelForm::kWavefront}, {KernelForm::kMegakernel}};

/// Keeps what is below this height along z.
ClipDescription below(double z) { return {ClipPlane{{0, 0, z}, {0, 0, -1}}}; }

/// Distance to the unit sphere around the origin without its cap above z = cut; infinity for a miss. nullopt near the
/// cut or the silhouette, where the discs deviate from the sphere.
std::optional<double> depthOfCutSphere(Vec3 origin, Vec3 direction, double cut) {
    constexpr double kDiscs = 0.04; // a few radii
    const double middle = -dot(origin, direction), half_squared = middle * middle - dot(origin, origin) + 1;
    if (std::abs(half_squared) < kDiscs) return std::nullopt;
    if (half_squared < 0) return std::numeric_limits<double>::infinity();
    for (const double t : {middle - std::sqrt(half_squared), middle + std::sqrt(half_squared)}) {
        const double z = origin.z + t * direction.z;
        if (std::abs(z - cut) < kDiscs) return std::nullopt;
        if (z < cut) return t;
    }
    return std::numeric_limits<double>::infinity();
}

TEST(Clips, DepthIsThatOfTheWallBehindTheCut) {
    const SphereFile sphere(kCutSplats);
    const double cut = 0.4;
    SceneDescription scene;
    scene.instances.push_back({sphere.path, {}, {}, {}});
    scene.clips = {below(cut)};
    RenderSettings settings = square(64);
    settings.camera.eye = {1, 0.5, 4};
    settings.camera.target = {0, 0, 0};
    for (const FormRequest& form : kBothForms) {
        const Rendered rendered = renderScene(scene, settings, form);
        std::size_t walls = 0;
        for (std::uint32_t y = 0; y < settings.height; ++y)
            for (std::uint32_t x = 0; x < settings.width; ++x) {
                const Vec3 direction = centerRayDirection(settings, rendered.camera, x, y);
                const auto expected = depthOfCutSphere(rendered.camera.eye, direction, cut);
                const double depth = rendered.film.depth[std::size_t{y} * settings.width + x];
                if (!expected) continue;
                if (std::isfinite(*expected))
                    EXPECT_NEAR(depth, *expected, 0.01) << x << ", " << y;
                else
                    EXPECT_FALSE(std::isfinite(depth)) << x << ", " << y;
                walls += std::isfinite(*expected) && *expected > 4.2;
            }
        EXPECT_GT(walls, 100u) << "hardly a ray goes through the cut";
    }
}

/// The lower half of the sphere, which the clip keeps, as a separate scan.
struct HalfSphereFile {
    std::string path = temporaryPath("half_sphere.pro");
    HalfSphereFile() {
        const Splats all = sphereSplats(kCutSplats, Vec3f(0, 0, 0), 1);
        Splats half;
        half.oriented = true;
        for (std::size_t i = 0; i < all.positions.size(); ++i) {
            if (all.positions[i].z() > 0) continue;
            half.input_index.push_back(static_cast<std::uint32_t>(half.positions.size()));
            half.positions.push_back(all.positions[i]);
            half.normals.push_back(all.normals[i]);
            half.radii.push_back(all.radii[i]);
        }
        writeScene(path, half, {});
    }
    ~HalfSphereFile() { std::remove(path.c_str()); }
    HalfSphereFile(const HalfSphereFile&) = delete;
    HalfSphereFile& operator=(const HalfSphereFile&) = delete;
};

/// A bowl with a mirror ball in it, under a lamp that also shines past the bowl onto a wall.
SceneDescription bowlScene(const std::string& path) {
    SceneDescription scene;
    scene.materials.resize(2);
    scene.materials[1].kind = MaterialKind::kMirror;
    scene.instances.push_back({path, {}, 0u, {}});
    scene.shapes.push_back({ShapeKind::kSphere, {0.2, 0, -0.4}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, 1});
    scene.shapes.push_back({ShapeKind::kPlane, {0, 0, -1.5}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0});
    scene.lights.push_back(PointLight{{0.8, 0.4, 3}, {20, 20, 20}});
    scene.sky = evenSky(0.1f);
    return scene;
}

/// The share of pixels whose light differs by more than a twentieth, and the mean of both pictures.
struct Difference {
    double share = 0, mean = 0;
};
Difference differenceOf(const Rendered& a, const Rendered& b, std::uint32_t size) {
    Difference difference;
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const double one = pixel(a.film, x, y, 1), other = pixel(b.film, x, y, 1);
            difference.share += std::abs(one - other) > 0.05 * std::max(one, other) + 1e-3;
            difference.mean += one;
        }
    difference.share /= size * size;
    difference.mean /= size * size;
    return difference;
}

TEST(Clips, LightIsThatOfAScanWithoutWhatIsCut) {
    const SphereFile sphere(kCutSplats);
    const HalfSphereFile half;
    SceneDescription cut = bowlScene(sphere.path);
    cut.clips = {below(0)};
    RenderSettings settings = square(48);
    settings.camera.eye = {-0.8, -1, 3.5};
    settings.camera.target = {0, 0, -0.5};
    const std::pair<Integrator, KernelForm> kinds[] = {{Integrator::kPhong, KernelForm::kWavefront},
                                                       {Integrator::kWhitted, KernelForm::kMegakernel},
                                                       {Integrator::kPath, KernelForm::kWavefront},
                                                       {Integrator::kPath, KernelForm::kMegakernel}};
    for (const auto& [integrator, form] : kinds) {
        settings.integrator = integrator;
        const Rendered expected = renderScene(bowlScene(half.path), settings, {form});
        const Difference to_half = differenceOf(renderScene(cut, settings, {form}), expected, 48);
        // discs at the rim reach beyond the cut, and rounding sends some paths elsewhere
        EXPECT_LT(to_half.share, 0.08) << nameOf(kIntegratorNames, integrator);
        EXPECT_GT(to_half.mean, 0.1);
    }
    settings.integrator = Integrator::kPhong;
    const Difference to_whole =
        differenceOf(renderScene(bowlScene(sphere.path), settings), renderScene(cut, settings), 48);
    EXPECT_GT(to_whole.share, 0.3) << "the clip cuts hardly anything";
}

TEST(Clips, DisabledOnesCutNothing) {
    const SphereFile sphere(5000);
    SceneDescription scene;
    scene.instances.push_back({sphere.path, {}, {}, {}});
    const Rendered whole = renderScene(scene, square(32));
    scene.clips = {below(0)};
    scene.clips[0].enabled = false;
    const Rendered same = renderScene(scene, square(32));
    EXPECT_EQ(whole.film.depth, same.film.depth);
}

/// PSNR of light behind a plane through the middle, seen from in front of it.
double psnrOfCutGaussians(const SceneDescription& scene, const OracleScene& oracle, const FormRequest& form) {
    const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
    const Rendered rendered = renderScene(scene, settings, form);
    EXPECT_EQ(rendered.rays.cut, 0u);
    return psnrAgainst(rendered, settings, [&](Vec3 direction) {
        const Vec3 eye = rendered.camera.eye;
        return lightOf(compositeAlong(oracle, eye - (eye.z / direction.z) * direction, direction));
    });
}

TEST(Clips, GaussiansAreCompositedFromTheCutOn) {
    const GaussianFile file(makeGaussians("random", 400)), none({roundGaussian({50, 50, -9}, 0.1, 0.5, {1, 1, 1})});
    SceneDescription scene;
    scene.instances.push_back({file.path, {}, {}, {}});
    scene.clips = {below(0)};
    for (const FormRequest& form : kBothForms) EXPECT_GT(psnrOfCutGaussians(scene, file.scene, form), 60);
    scene.instances.push_back({none.path, {}, {}, {}}); // two instances are gathered in rounds
    for (const FormRequest& form : kBothForms) EXPECT_GT(psnrOfCutGaussians(scene, file.scene, form), 55);
}

} // namespace
} // namespace pointrt::test
