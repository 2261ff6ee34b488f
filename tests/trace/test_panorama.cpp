// SPDX-License-Identifier: Apache-2.0
// Panoramas from within a sphere and beside one, compared with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>

#include "runtime/scene/panorama.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kPanoramaSplats = 40000;
/// Rays that miss or hit the sphere by less than this are not compared: its silhouette consists of rims of discs.
constexpr double kPanoramaRim = 2e-3;

RenderSettings panoramaFrom(Vec3 eye, std::uint32_t width, double eyes_apart_m = 0) {
    RenderSettings settings = square(width);
    settings.height = panoramaSize(width, eyes_apart_m > 0).height;
    settings.camera.panorama = true;
    settings.camera.eyes_apart_m = eyes_apart_m;
    settings.camera.eye = eye;
    settings.camera.target = eye + Vec3{0.3, -0.2, -1}; // not along an axis, and not level
    settings.camera.up = Vec3{0.1, 1, 0.2};
    return settings;
}

/// Whether a ray from outside the unit sphere nearly grazes it.
bool isNearRim(const PanoramaRay& ray) {
    const double along = dot(ray.origin, ray.direction);
    const double across = std::sqrt(std::max(0.0, dot(ray.origin, ray.origin) - along * along));
    return length(ray.origin) >= 1 && std::abs(across - 1) < kPanoramaRim;
}

struct PanoramaErrors {
    std::size_t hits = 0, wrong = 0, compared = 0;
    double depth = 0, position = 0; ///< largest error where rays do not graze the sphere
};

PanoramaErrors compareWithPanorama(const Rendered& rendered) {
    const Film& film = rendered.film;
    PanoramaErrors errors;
    for (std::uint32_t y = 0; y < film.height; ++y)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const std::size_t i = std::size_t{y} * film.width + x;
            const PanoramaRay ray = panoramaRay(rendered.camera, (x + 0.5) / film.width, (y + 0.5) / film.height);
            const std::optional<double> t = meetSphere(ray.origin, ray.direction);
            const bool has_hit = std::isfinite(film.depth[i]);
            errors.hits += has_hit;
            if (isNearRim(ray)) continue;
            errors.wrong += has_hit != t.has_value();
            if (!has_hit || !t) continue;
            const Vec3 at = ray.origin + *t * ray.direction;
            if (std::abs(dot(at, ray.direction)) < 0.15) continue; // meets discs far from the sphere
            ++errors.compared;
            errors.depth = std::max(errors.depth, std::abs(film.depth[i] - *t));
            const Vec3 found{film.position[3 * i], film.position[3 * i + 1], film.position[3 * i + 2]};
            errors.position = std::max(errors.position, length(found - at));
        }
    std::printf("%zu hits, %zu wrong, %zu compared: depth off by %.2g, position by %.2g\n", errors.hits, errors.wrong,
                errors.compared, errors.depth, errors.position);
    return errors;
}

/// Rims of discs are 2e-4 off the sphere, which is 7 times as much along rays at 8 degrees to the surface.
constexpr double kPanoramaError = 1.4e-3;

TEST(PanoramaPicture, SeesASphereFromWithinInAllDirections) {
    const SphereFile sphere(kPanoramaSplats);
    for (const std::uint32_t width : {250u, 16u}) { // tiles of pixels at the edges are partly in the picture
        const Rendered rendered = renderFile(sphere.path, panoramaFrom({0.2, 0.1, -0.3}, width));
        const PanoramaErrors errors = compareWithPanorama(rendered);
        EXPECT_EQ(errors.wrong, 0u);
        EXPECT_EQ(errors.hits, rendered.film.depth.size());
        EXPECT_LT(errors.depth, kPanoramaError);
        EXPECT_LT(errors.position, kPanoramaError);
    }
}

/// Most beams miss, and some rays leave through the poles.
TEST(PanoramaPicture, SeesASphereFromOutside) {
    const SphereFile sphere(kPanoramaSplats);
    for (const Vec3 eye : {Vec3{2, 0.5, 1}, Vec3{0.1, 1.2, 0}, Vec3{0, -30, 0.5}}) {
        const Rendered rendered = renderFile(sphere.path, panoramaFrom(eye, 600));
        const PanoramaErrors errors = compareWithPanorama(rendered);
        EXPECT_EQ(errors.wrong, 0u);
        EXPECT_GT(errors.compared, 10u);
        EXPECT_LT(errors.depth, kPanoramaError);
        EXPECT_LT(errors.position, kPanoramaError);
    }
}

/// Eyes so far apart, as if seen by an ant, that their pictures are quite different; rows of both share a tile of
/// pixels.
TEST(PanoramaPicture, SeesASphereWithTwoEyes) {
    const SphereFile sphere(kPanoramaSplats);
    const Rendered rendered = renderFile(sphere.path, panoramaFrom({2, 0.5, 1}, 300, 0.8));
    EXPECT_EQ(rendered.camera.eyes_apart, 0.8) << "a scan of unknown unit is in metres";
    const PanoramaErrors errors = compareWithPanorama(rendered);
    EXPECT_EQ(errors.wrong, 0u);
    EXPECT_GT(errors.compared, 1000u);
    EXPECT_LT(errors.depth, kPanoramaError);
    EXPECT_LT(errors.position, kPanoramaError);
}

/// The first and the last column are neighbours like any other two: from inside a sphere depths change slowly.
TEST(PanoramaPicture, HasNoSeam) {
    const SphereFile sphere(kPanoramaSplats);
    RenderSettings settings = panoramaFrom({0.2, 0.1, -0.3}, 256);
    settings.spp = 4;
    const Film film = renderFile(sphere.path, settings).film;
    double within = 0, across = 0;
    for (std::size_t y = 0; y < film.height; ++y) {
        const float* const row = film.depth.data() + y * film.width;
        for (std::size_t x = 1; x < film.width; ++x) within = std::max(within, std::abs(double{row[x]} - row[x - 1]));
        across = std::max(across, std::abs(double{row[0]} - row[film.width - 1]));
    }
    EXPECT_LE(across, within);
    EXPECT_LT(within, 0.03) << "else the test says little";
}

} // namespace
} // namespace pointrt::test
