// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/oracle_picture.h"

#include <algorithm>
#include <numeric>

#include "format/base/parallel.h"
#include "tests/gaussians/culling.h"
#include "tests/gaussians/srgb.h"

namespace pointrt::test {

namespace {

/// Pixels per edge of the squares that share a list of candidates.
constexpr std::uint32_t kTileSide = 16;

struct Job {
    const OracleScene& scene;
    const OracleCamera& camera;
    const PictureOptions& options;
    std::vector<SeenEllipsoid> ellipsoids; ///< empty without culling
    OraclePicture& picture;
};

using Candidates = std::vector<std::uint32_t>;

OracleComposite compositeThrough(const Job& job, const Candidates& candidates, double x, double y) {
    const OracleRay ray = rayThrough(job.camera, x, y);
    return composite(job.scene, ray, hitsAlong(job.scene, ray, candidates), job.options.stop_below);
}

Double3 over(const OracleComposite& sum, const Double3& background) {
    return plus(sum.radiance, times(sum.transmittance, background));
}

/// The mean of the samples' linear light, encoded.
Double3 meanOfSamples(const Job& job, const Candidates& candidates, std::uint32_t x, std::uint32_t y) {
    Double3 mean{};
    for (std::uint32_t sample = 0; sample < job.options.spp; ++sample) {
        const PixelOffset at = sampleOffset(y * job.camera.width + x, sample, job.options.seed);
        const Double3 color = over(compositeThrough(job, candidates, x + at.x, y + at.y), job.options.background);
        for (std::size_t c = 0; c < 3; ++c) mean[c] += linearFromSrgb(color[c]) / job.options.spp;
    }
    for (double& channel : mean) channel = srgbFromLinear(channel);
    return mean;
}

void renderPixel(const Job& job, const Candidates& candidates, std::uint32_t x, std::uint32_t y) {
    const std::size_t pixel = std::size_t{y} * job.camera.width + x;
    const OracleComposite center = compositeThrough(job, candidates, x + 0.5, y + 0.5);
    job.picture.centers[pixel] = center;
    job.picture.colors[pixel] =
        job.options.spp == 1 ? over(center, job.options.background) : meanOfSamples(job, candidates, x, y);
}

Candidates seenIn(const Job& job, PixelRectangle rectangle, const Candidates& candidates) {
    return job.options.culls ? seenThrough(job.camera, rectangle, job.ellipsoids, candidates) : candidates;
}

void renderTile(const Job& job, PixelRectangle tile, const Candidates& of_row) {
    const Candidates candidates = seenIn(job, tile, of_row);
    for (std::uint32_t y = tile.top; y < tile.bottom; ++y)
        for (std::uint32_t x = tile.left; x < tile.right; ++x) renderPixel(job, candidates, x, y);
}

/// The candidates of a whole row of tiles are found first: most of a scene is above or below it.
void renderTileRow(const Job& job, std::uint32_t top, const Candidates& all) {
    const std::uint32_t width = job.camera.width, bottom = std::min(top + kTileSide, job.camera.height);
    const Candidates of_row = seenIn(job, {0, top, width, bottom}, all);
    for (std::uint32_t left = 0; left < width; left += kTileSide)
        renderTile(job, {left, top, std::min(left + kTileSide, width), bottom}, of_row);
}

} // namespace

OraclePicture renderPicture(const OracleScene& scene, const OracleCamera& camera, const PictureOptions& options) {
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    OraclePicture picture{camera.width, camera.height, std::vector<Double3>(pixels),
                          std::vector<OracleComposite>(pixels)};
    Job job{scene, camera, options, {}, picture};
    if (options.culls) job.ellipsoids = ellipsoidsFrom(camera.eye, scene);
    Candidates all(scene.gaussians.size());
    std::iota(all.begin(), all.end(), 0u);
    forAll((camera.height + kTileSide - 1) / kTileSide,
           [&](std::size_t row) { renderTileRow(job, static_cast<std::uint32_t>(row) * kTileSide, all); });
    return picture;
}

} // namespace pointrt::test
