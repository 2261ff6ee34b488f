// SPDX-License-Identifier: Apache-2.0
// What shaders/shade/caustic.glsl gathers from a photon map, compared with a search through all photons.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/render/photon_map.h"
#include "runtime/util/pack.h"
#include "runtime/util/vec.h"
#include "shaders/photon_probe.spv.h"
#include "tests/runtime/gpu/probe.h"

namespace pointrt {
namespace {

using std::numbers::pi;

struct Probe {
    gpu::vec4 position, normal;
};

std::vector<gpu::vec4> gatherAt(const PhotonMap& map, const std::vector<Probe>& probes) {
    ValidatedDevice validated;
    Device& device = validated.device;
    std::vector<gpu::Photon> photons = map.photons;
    photons.resize(photons.size() + 1); // buffers cannot be empty
    return answersOf<gpu::vec4>(device, photon_probe_spv,
                                {filledBuffer(device, photons), filledBuffer(device, map.buckets),
                                 filledBuffer(device, std::vector{map.frame}), filledBuffer(device, probes)},
                                probes.size(), {});
}

/// Like packSnorm4x8.
std::uint32_t packNormal(Vec3 n) {
    const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(v * 127)) & 0xFF; };
    return byte(n.x) | byte(n.y) << 8 | byte(n.z) << 16;
}

Vec3 normalOf(const gpu::Photon& photon) {
    const auto bits = std::bit_cast<std::uint32_t>(photon.position.w);
    const auto byte = [&](int shift) { return static_cast<std::int8_t>(bits >> shift & 0xFF) / 127.0; };
    return {byte(0), byte(8), byte(16)};
}

gpu::Photon photonAt(Vec3 position, Vec3 normal, Vec3 flux) {
    gpu::Photon photon{pack(position), pack(flux, 1)};
    photon.position.w = std::bit_cast<float>(packNormal(normal));
    return photon;
}

double radiusOf(const PhotonMap& map, const gpu::Photon& photon) {
    return map.frame.levels[static_cast<std::size_t>(photon.flux.w)].high.w;
}

/// The light at probe by a loop over all photons, each with the radius of its level.
Vec3 searchAll(const PhotonMap& map, const Probe& probe, double margin) {
    Vec3 sum;
    const Vec3 position = unpack(probe.position), normal = unpack(probe.normal);
    for (const gpu::Photon& photon : map.photons) {
        const double radius = radiusOf(map, photon) * (1 + margin);
        const Vec3 offset = position - unpack(photon.position);
        const double height = dot(normalOf(photon), offset), squared = dot(offset, offset);
        if (squared >= radius * radius || std::abs(height) >= PHOTON_REACH * radius) continue;
        if (dot(normal, normalOf(photon)) <= 0.5) continue;
        const double inside = 1 - (squared - height * height) / (radius * radius);
        sum = sum + 3 / (pi * radius * radius) * inside * inside * unpack(photon.flux);
    }
    return sum;
}

using Random = std::mt19937;

double unit(Random& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

/// On a floor around the origin: two clusters of different density, and some far around them.
std::vector<gpu::Photon> floorPhotons(std::size_t count) {
    Random random(5);
    std::normal_distribution<double> heap;
    std::vector<gpu::Photon> photons;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 at{20 * unit(random) - 10, 0, 20 * unit(random) - 10};
        if (i % 8 < 4) at = {0.05 * heap(random) - 1, 0, 0.05 * heap(random) + 1};
        if (i % 8 == 4 || i % 8 == 5) at = {0.5 * heap(random) + 2, 0, 0.5 * heap(random)};
        photons.push_back(photonAt(at, {0, 1, 0}, Vec3{unit(random), unit(random), 1}));
    }
    return photons;
}

/// Photons in a cloud, all with this normal.
std::vector<gpu::Photon> cloudPhotons(std::size_t count, double size, Vec3 normal) {
    Random random(9);
    std::vector<gpu::Photon> photons;
    for (std::size_t i = 0; i < count; ++i) {
        const double stretch = std::pow(unit(random), 3) * size;
        photons.push_back(photonAt(
            {stretch * (2 * unit(random) - 1), stretch * (2 * unit(random) - 1), stretch * (2 * unit(random) - 1)},
            normal, Vec3{1, unit(random), 0}));
    }
    return photons;
}

/// A third of the probes at photons, a third near them, a third anywhere.
std::vector<Probe> probesAmong(const PhotonMap& map, std::size_t count, Vec3 normal, double size) {
    Random random(3);
    std::vector<Probe> probes;
    for (std::size_t i = 0; i < count; ++i) {
        const gpu::Photon& photon = map.photons[random() % map.photons.size()];
        const double near = i % 3 == 0 ? 0 : radiusOf(map, photon);
        const Vec3 step{near * (2 * unit(random) - 1), near * (2 * unit(random) - 1), near * (2 * unit(random) - 1)};
        const Vec3 anywhere{size * (2 * unit(random) - 1), size * (2 * unit(random) - 1),
                            size * (2 * unit(random) - 1)};
        probes.push_back({pack(i % 3 == 2 ? anywhere : unpack(photon.position) + step), pack(normal)});
    }
    return probes;
}

void expectAsSearched(const PhotonMap& map, const std::vector<Probe>& probes) {
    const std::vector<gpu::vec4> answers = gatherAt(map, probes);
    std::size_t lit = 0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        // rounding decides on photons at the rim of a disc: either is accepted
        const Vec3 low = searchAll(map, probes[i], -1e-4), high = searchAll(map, probes[i], 1e-4);
        const auto expectBetween = [&](double value, double a, double b) {
            const double slack = 2e-3 * (a + b);
            ASSERT_GE(value, std::min(a, b) - slack) << i;
            ASSERT_LE(value, std::max(a, b) + slack) << i;
        };
        expectBetween(answers[i].x, low.x, high.x);
        expectBetween(answers[i].y, low.y, high.y);
        expectBetween(answers[i].z, low.z, high.z);
        lit += answers[i].x > 0;
    }
    EXPECT_GT(lit, probes.size() / 3);
}

std::size_t levelsUsed(const PhotonMap& map) {
    std::size_t levels = 0;
    for (int level = 0; level < PHOTON_LEVELS; ++level)
        levels += std::any_of(map.photons.begin(), map.photons.end(),
                              [&](const gpu::Photon& p) { return p.flux.w == static_cast<float>(level); });
    return levels;
}

TEST(PhotonMap, KeepsEveryPhoton) {
    std::vector<gpu::Photon> photons = floorPhotons(20'000);
    const PhotonMap map = sortPhotons(photons, 10);
    ASSERT_EQ(map.photons.size(), photons.size());
    EXPECT_EQ(map.frame.count.x, photons.size());
    const auto before = [](const gpu::Photon& a, const gpu::Photon& b) {
        return a.position.x != b.position.x ? a.position.x < b.position.x : a.position.z < b.position.z;
    };
    std::vector<gpu::Photon> sorted = map.photons;
    std::sort(sorted.begin(), sorted.end(), before);
    std::sort(photons.begin(), photons.end(), before);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        ASSERT_EQ(sorted[i].position.x, photons[i].position.x);
        ASSERT_EQ(sorted[i].position.z, photons[i].position.z);
        ASSERT_EQ(sorted[i].flux.x, photons[i].flux.x);
    }
    EXPECT_EQ(levelsUsed(map), std::size_t{PHOTON_LEVELS}) << "the scene has all densities";
}

TEST(PhotonMap, GatheringMatchesASearchOnAFloor) {
    const PhotonMap map = sortPhotons(floorPhotons(20'000), 10);
    expectAsSearched(map, probesAmong(map, 600, {0, 1, 0}, 10));
}

TEST(PhotonMap, GatheringMatchesASearchInACloud) {
    const Vec3 normal = normalize(Vec3{1, -2, 0.5});
    const PhotonMap map = sortPhotons(cloudPhotons(20'000, 3, normal), 10);
    expectAsSearched(map, probesAmong(map, 600, normal, 3));
}

TEST(PhotonMap, GatheringMatchesASearchInSharedBuckets) {
    // more cells with photons than buckets, so that most buckets hold the photons of several cells
    const Vec3 normal{0, 0, -1};
    std::vector<gpu::Photon> photons;
    Random random(1);
    for (std::uint32_t i = 0; i < PHOTON_BUCKETS; ++i)
        photons.push_back(photonAt({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}, normal, {1, 1, 1}));
    const PhotonMap map = sortPhotons(std::move(photons), 0.05);
    ASSERT_LT(map.frame.levels[0].high.w, 0.001);
    expectAsSearched(map, probesAmong(map, 60, normal, 0.5));
}

/// The light gathered on a floor, summed over a fine grid of probes, divided by the flux of the photons.
double lightSpread(std::vector<gpu::Photon> photons, PhotonDiscs discs) {
    double flux = 0;
    for (const gpu::Photon& photon : photons) flux += photon.flux.y;
    const PhotonMap map = sortPhotons(std::move(photons), 40, discs);
    // probes are half of the smallest radius apart
    const double step = map.frame.levels[0].high.w / 2;
    std::vector<Probe> probes;
    const double half = 10 + map.frame.levels[PHOTON_LEVELS - 1].high.w;
    for (double x = -half; x < half; x += step)
        for (double z = -half; z < half; z += step) probes.push_back({pack({x, 0, z}), {0, 1, 0, 0}});
    double sum = 0;
    for (const gpu::vec4& answer : gatherAt(map, probes)) sum += answer.y * step * step;
    return sum / flux;
}

TEST(PhotonMap, KeepsTheTotalFlux) {
    std::vector<gpu::Photon> photons = floorPhotons(8000);
    std::erase_if(photons, [](const gpu::Photon& p) { return std::hypot(p.position.x + 1, p.position.z - 1) < 0.4; });
    EXPECT_NEAR(lightSpread(photons, {}), 1, 0.005);
    EXPECT_NEAR(lightSpread(photons, {0, 0.6}), 1, 0.005) << "narrower discs are brighter";
}

TEST(PhotonMap, ShrinksItsDiscsAndKeepsTheirLevels) {
    const std::vector<gpu::Photon> photons = floorPhotons(20'000);
    const PhotonMap first = sortPhotons(photons, 10), narrow = sortPhotons(photons, 10, {0, 0.3}),
                    given = sortPhotons(photons, 10, {2 * first.finest, 0.3});
    EXPECT_EQ(narrow.finest, first.finest);
    EXPECT_EQ(given.finest, 2 * first.finest);
    const auto photonsOf = [](const PhotonMap& map, int level) {
        return std::count_if(map.photons.begin(), map.photons.end(),
                             [&](const gpu::Photon& p) { return p.flux.w == static_cast<float>(level); });
    };
    for (int level = 0; level < PHOTON_LEVELS; ++level) {
        EXPECT_FLOAT_EQ(narrow.frame.levels[level].high.w, 0.3f * first.frame.levels[level].high.w);
        EXPECT_FLOAT_EQ(given.frame.levels[level].high.w, 0.6f * first.frame.levels[level].high.w);
        EXPECT_EQ(photonsOf(narrow, level), photonsOf(first, level));
    }
    expectAsSearched(narrow, probesAmong(narrow, 600, {0, 1, 0}, 10));
}

TEST(PhotonMap, LightsOnlyTheSideOfItsNormal) {
    std::vector<gpu::Photon> photons;
    Random random(1);
    for (int i = 0; i < 1000; ++i) photons.push_back(photonAt({unit(random), 0, unit(random)}, {0, 1, 0}, {1, 1, 1}));
    const PhotonMap map = sortPhotons(std::move(photons), 100);
    const Vec3 at{0.5, 0, 0.5};
    const auto turned = [&](double degrees) {
        return Probe{pack(at), pack({std::sin(degrees * pi / 180), std::cos(degrees * pi / 180), 0})};
    };
    const std::vector<gpu::vec4> answers = gatherAt(map, {turned(0), turned(55), turned(65), turned(180)});
    EXPECT_GT(answers[0].x, 0);
    EXPECT_GT(answers[1].x, 0);
    EXPECT_EQ(answers[2].x, 0);
    EXPECT_EQ(answers[3].x, 0);
    // photons on the other side of a wall
    const std::vector<gpu::vec4> beside =
        gatherAt(map, {{pack(at + Vec3{0, 1.1 * map.frame.levels[PHOTON_LEVELS - 1].high.w, 0}), {0, 1, 0, 0}}});
    EXPECT_EQ(beside[0].x, 0);
}

TEST(PhotonMap, FewOrNoPhotonsAreAccepted) {
    const std::vector<Probe> probes{{{0, 0, 0, 0}, {0, 1, 0, 0}}, {{-5, 3, 2, 0}, {0, 1, 0, 0}}};
    for (const gpu::vec4& answer : gatherAt(sortPhotons({}, 1), probes)) EXPECT_EQ(answer.x, 0);
    // one photon, and many in one place
    for (const std::size_t count : {1u, 2u, 1000u}) {
        const PhotonMap map =
            sortPhotons(std::vector<gpu::Photon>(count, photonAt({0, 0, 0}, {0, 1, 0}, {1, 2, 3})), 1);
        ASSERT_EQ(map.photons.size(), count);
        const double radius = radiusOf(map, map.photons[0]);
        const std::vector<gpu::vec4> answers = gatherAt(map, probes);
        EXPECT_NEAR(answers[0].y * pi * radius * radius / 3 / (2.0 * static_cast<double>(count)), 1, 1e-5);
        EXPECT_EQ(answers[1].y, 0);
    }
}

} // namespace
} // namespace pointrt
