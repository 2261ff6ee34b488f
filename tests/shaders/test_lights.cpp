// SPDX-License-Identifier: Apache-2.0
// The shaders' sampler and light sampling against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "runtime/device_scene/render_space.h"
#include "runtime/util/pack.h"
#include "shaders/lights_probe.spv.h"
#include "tests/runtime/gpu/probe.h"

namespace pointrt {
namespace {

using std::numbers::pi;

struct Receiver {
    gpu::vec4 point;
    gpu::uvec4 light;
};
struct LightAnswer {
    gpu::vec4 direction, radiance_over_pdf, pdf, free, sample2;
};

constexpr std::uint32_t kSamples = 1u << 14;

std::vector<LightAnswer> sampleLights(const std::vector<gpu::Light>& lights, const std::vector<Receiver>& receivers,
                                      std::uint32_t samples = kSamples) {
    const auto count = static_cast<std::uint32_t>(receivers.size() * samples);
    return runProbe<LightAnswer>(lights_probe_spv, lights, receivers, {count, samples, 0, 0});
}

Receiver receiverAt(Vec3 p, std::uint32_t light = 0) {
    return {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 3}, {light, 11, 5, 0}};
}

/// Samples of one light from each point: the answers, point after point.
std::vector<LightAnswer> samplesFrom(const LightDescription& light, const std::vector<Vec3>& points) {
    std::vector<Receiver> receivers;
    for (const Vec3& p : points) receivers.push_back(receiverAt(p));
    return sampleLights({packLight({}, light)}, receivers);
}

using Span = std::span<const LightAnswer>;

Span samplesOf(const std::vector<LightAnswer>& answers, std::size_t receiver) {
    return Span(answers).subspan(receiver * kSamples, kSamples);
}

double mean(Span answers, const std::function<double(const LightAnswer&)>& value) {
    double sum = 0;
    for (const LightAnswer& answer : answers) sum += value(answer);
    return sum / static_cast<double>(answers.size());
}

double irradiance(Span answers, Vec3 normal) {
    return mean(answers, [&](const LightAnswer& a) {
        return a.radiance_over_pdf.x * std::max(0.0, dot(unpack(a.direction), normal));
    });
}

/// Solid angle of the light, estimated from the densities of the samples.
double solidAngle(Span answers) {
    return mean(answers, [](const LightAnswer& a) { return 1.0 / a.radiance_over_pdf.w; });
}

void expectShare(double value, double expected, double share) { EXPECT_NEAR(value / expected, 1, share) << expected; }

/// Directions are unit vectors, and lightPdf equals the density of the sample.
void expectConsistent(Span answers) {
    for (const LightAnswer& a : answers) {
        ASSERT_NEAR(length(unpack(a.direction)), 1, 1e-6);
        ASSERT_NEAR(a.pdf.x / a.radiance_over_pdf.w, 1, 1e-3);
        ASSERT_NEAR(a.radiance_over_pdf.x * a.radiance_over_pdf.w / a.free.w, 1, 1e-3);
    }
}

// Samples.

std::vector<std::array<double, 2>> pairsOf(std::uint32_t pixel, std::uint32_t pair, std::uint32_t seed,
                                           std::uint32_t samples) {
    std::vector<std::array<double, 2>> points;
    const Receiver receiver{{0, 0, 0, static_cast<float>(pair)}, {0, pixel, seed, 0}};
    for (const LightAnswer& a : sampleLights({gpu::Light{}}, {receiver}, samples)) {
        EXPECT_EQ(a.sample2.x, a.pdf.w) << "sample1 is the first of the pair";
        points.push_back({a.sample2.x, a.sample2.y});
    }
    return points;
}

/// Whether points [first, first + 2^k) fill each elementary interval of 2^across by 2^(k - across) parts once.
bool fillsIntervals(const std::vector<std::array<double, 2>>& points, std::size_t first, unsigned k, unsigned across) {
    std::vector<int> filled(1u << k);
    for (std::size_t i = first; i < first + (1u << k); ++i) {
        const auto x = static_cast<unsigned>(points[i][0] * (1u << across));
        const auto y = static_cast<unsigned>(points[i][1] * (1u << (k - across)));
        filled.at((y << across) + x)++;
    }
    return std::all_of(filled.begin(), filled.end(), [](int n) { return n == 1; });
}

TEST(Sampler, FillsEveryElementaryInterval) {
    for (const std::uint32_t pixel : {0u, 1u, 123'456u})
        for (const std::uint32_t pair : {0u, 7u}) {
            const auto points = pairsOf(pixel, pair, 42, 2048);
            for (unsigned k = 0; k <= 11; ++k)
                for (unsigned across = 0; across <= k; ++across) {
                    EXPECT_TRUE(fillsIntervals(points, 0, k, across)) << k << " " << across;
                    EXPECT_TRUE(fillsIntervals(points, 2048 - (1u << k), k, across)) << k << " " << across;
                }
        }
}

TEST(Sampler, StaysBelowOneAndChangesWithPixelPairAndSeed) {
    const auto points = pairsOf(3, 4, 5, 4096);
    for (const auto& p : points) ASSERT_TRUE(p[0] >= 0 && p[0] < 1 && p[1] >= 0 && p[1] < 1);
    EXPECT_NE(points, pairsOf(4, 4, 5, 4096));
    EXPECT_NE(points, pairsOf(3, 5, 5, 4096));
    EXPECT_NE(points, pairsOf(3, 4, 6, 4096));
    EXPECT_EQ(points, pairsOf(3, 4, 5, 4096));
}

/// Root mean square error over pixels of the mean of n samples of a smooth and of an edged integrand.
std::array<double, 2> errors(std::uint32_t n,
                             const std::function<std::array<double, 2>(std::uint32_t, std::uint32_t)>& point,
                             std::uint32_t pixels) {
    // the integral of exp(x + y) is (e - 1)^2, that of the quarter of the unit disc pi / 4
    const double smooth = (std::numbers::e - 1) * (std::numbers::e - 1), edged = pi / 4;
    std::array<double, 2> squares{};
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        double sums[2] = {};
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto [x, y] = point(pixel, i);
            sums[0] += std::exp(x + y);
            sums[1] += x * x + y * y < 1 ? 1 : 0;
        }
        squares[0] += std::pow(sums[0] / n - smooth, 2);
        squares[1] += std::pow(sums[1] / n - edged, 2);
    }
    return {std::sqrt(squares[0] / pixels), std::sqrt(squares[1] / pixels)};
}

TEST(Sampler, ConvergesFasterThanRandomNumbers) {
    constexpr std::uint32_t kPixels = 256, kCount = 256;
    std::vector<Receiver> receivers;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) receivers.push_back({{0, 0, 0, 1}, {0, pixel, 9, 0}});
    const auto answers = sampleLights({gpu::Light{}}, receivers, kCount);
    const auto ours = errors(
        kCount,
        [&](std::uint32_t pixel, std::uint32_t i) {
            const gpu::vec4& u = answers[pixel * kCount + i].sample2;
            return std::array<double, 2>{u.x, u.y};
        },
        kPixels);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit;
    const auto theirs = errors(
        kCount,
        [&](std::uint32_t, std::uint32_t) {
            return std::array<double, 2>{unit(random), unit(random)};
        },
        kPixels);
    std::printf("rms error of 256 samples, ours over random: smooth %.2g, edged %.2g\n", ours[0] / theirs[0],
                ours[1] / theirs[1]);
    // errors fall as n^-3/2 and n^-3/4 instead of n^-1/2: by factors of up to 256 and 4 at 256 samples
    EXPECT_LT(ours[0], theirs[0] / 64);
    EXPECT_LT(ours[1], theirs[1] / 2.5);
}

/// Pearson's coefficient of two rows.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sa += a[i], sb += b[i], saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
    }
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

TEST(Sampler, HasNoCorrelationBetweenPairsAndPixels) {
    constexpr std::uint32_t kCount = 64, kOthers = 64;
    // sample 0 to 63 of the same pixel in other pairs, and of the same pair in other pixels
    for (const bool pixels : {false, true}) {
        std::vector<Receiver> receivers;
        for (std::uint32_t k = 0; k <= kOthers; ++k)
            receivers.push_back({{0, 0, 0, pixels ? 2.0f : static_cast<float>(k)}, {0, pixels ? k : 77u, 9, 0}});
        const auto answers = sampleLights({gpu::Light{}}, receivers, kCount);
        std::vector<double> rows[4]; // one pair (or pixel) and the next: x, y, next x, next y
        for (std::uint32_t k = 0; k < kOthers; ++k)
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const gpu::vec4 &one = answers[k * kCount + i].sample2, &next = answers[(k + 1) * kCount + i].sample2;
                rows[0].push_back(one.x), rows[1].push_back(one.y);
                rows[2].push_back(next.x), rows[3].push_back(next.y);
            }
        // standard deviation for 4096 independent numbers: 1/64; the bound is four times that
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) EXPECT_NEAR(correlation(rows[a], rows[b]), 0, 4.0 / 64) << a << " " << b;
    }
}

TEST(Sampler, HasFirstSamplesThatDoNotRepeatAcrossPixels) {
    std::vector<Receiver> receivers;
    for (std::uint32_t pixel = 0; pixel < 65'536; ++pixel) receivers.push_back({{0, 0, 0, 0}, {0, pixel, 0, 0}});
    const auto answers = sampleLights({gpu::Light{}}, receivers, 1);
    std::vector<int> cells(64 * 64);
    for (const LightAnswer& a : answers)
        cells[static_cast<int>(a.sample2.x * 64) + 64 * static_cast<int>(a.sample2.y * 64)]++;
    double chi = 0; // 16 expected in each cell
    for (const int n : cells) chi += (n - 16) * (n - 16) / 16.0;
    // 4095 degrees of freedom: mean 4095, deviation 90.5
    EXPECT_NEAR(chi, 4095, 5 * 90.5);
}

// Lights.

TEST(Lights, PointAndSpotFallOffWithTheSquareOfDistance) {
    const Vec3 point{1, 2, 3}, at{3, 5, 9};
    const auto answers = samplesFrom(PointLight{at, {49, 98, 7}}, {point});
    const LightAnswer& a = answers.front();
    EXPECT_NEAR(a.direction.w, 7, 1e-5);
    EXPECT_NEAR(length(7 * unpack(a.direction) - (at - point)), 0, 1e-5);
    EXPECT_NEAR(a.radiance_over_pdf.x, 1, 1e-6);
    EXPECT_NEAR(a.radiance_over_pdf.y, 2, 1e-6);
    EXPECT_EQ(a.radiance_over_pdf.w, 0);
    EXPECT_EQ(a.pdf.x, 0);
}

TEST(Lights, SpotDimsBetweenItsAngles) {
    std::vector<Vec3> points;
    for (int degrees = 0; degrees < 90; ++degrees) {
        const double angle = degrees * pi / 180;
        points.push_back({2 * std::sin(angle), 0, 5 - 2 * std::cos(angle)});
    }
    const auto answers = samplesFrom(SpotLight{{0, 0, 5}, {0, 0, -1}, 40, 20, {8, 8, 8}}, points);
    const double outer = std::cos(40 * pi / 180), inner = std::cos(20 * pi / 180);
    for (std::size_t d = 0; d < points.size(); ++d) {
        const double cosine = std::cos(static_cast<double>(d) * pi / 180);
        const double s = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
        EXPECT_NEAR(samplesOf(answers, d)[0].radiance_over_pdf.x, 2 * s * s * (3 - 2 * s), 1e-4) << d;
    }
    const auto hard = samplesFrom(SpotLight{{0, 0, 5}, {0, 0, -1}, 30, 30, {8, 8, 8}}, points);
    for (std::size_t d = 0; d < points.size(); ++d)
        if (d != 30) {
            EXPECT_NEAR(samplesOf(hard, d)[0].radiance_over_pdf.x, d < 30 ? 2 : 0, 1e-5) << d;
        }
}

TEST(Lights, SunGivesItsIrradianceWhateverItsSize) {
    for (const double radius : {0.0, 0.05, 0.2665, 5.0, 44.0}) {
        const Vec3 towards = normalize({0.3, 0.5, 0.8});
        const auto answers = samplesFrom(SunLight{towards, radius, {3, 2, 1}}, {{0, 0, 0}});
        const Span samples = samplesOf(answers, 0);
        expectShare(irradiance(samples, towards), 3, 2e-3);
        // the whole disc is above the horizon of a surface tilted by 40 degrees
        const Vec3 aside = normalize(cross(towards, {0, 0, 1}));
        const Vec3 turned = std::cos(40 * pi / 180) * towards + std::sin(40 * pi / 180) * aside;
        expectShare(irradiance(samples, turned), 3 * std::cos(40 * pi / 180), 2e-3);
        for (const LightAnswer& a : samples) {
            ASSERT_LE(length(cross(unpack(a.direction), towards)), std::sin(radius * pi / 180) * 1.003 + 1e-6);
            ASSERT_GT(a.direction.w, 1e29);
        }
        if (radius == 0) {
            EXPECT_EQ(samples[0].radiance_over_pdf.w, 0);
            EXPECT_EQ(samples[0].free.w, 0);
            continue;
        }
        expectConsistent(samples);
        // cosines near 1 come in steps of 6e-8: at 0.05 degrees the disc is off by up to a thirteenth
        expectShare(solidAngle(samples), 2 * pi * (1 - std::cos(radius * pi / 180)), radius < 1 ? 0.08 : 1e-3);
    }
}

TEST(Lights, SunIsHitByDirectionsWithinItsDisc) {
    const Vec3 towards = normalize({-0.2, 0.1, 0.7});
    for (const double radius : {5.0, 30.0}) {
        const auto answers = samplesFrom(SunLight{towards, radius, {3, 3, 3}}, {{0, 0, 0}});
        const Span samples = samplesOf(answers, 0);
        for (const LightAnswer& a : samples) {
            const double angle = std::acos(dot(unpack(a.free), towards)) * 180 / pi;
            if (std::abs(angle - radius) > 0.01) {
                ASSERT_EQ(a.pdf.z, angle < radius ? 1 : 0) << angle;
            }
        }
        // integrals over the disc of lightPdf and of the radiance
        expectShare(4 * pi * mean(samples, [](const LightAnswer& a) { return a.pdf.y * a.pdf.z; }), 1, 0.01);
        const double facing = mean(samples, [&](const LightAnswer& a) {
            return a.pdf.z * a.free.w * std::max(0.0, dot(unpack(a.free), towards));
        });
        expectShare(4 * pi * facing, 3, 0.01);
    }
}

TEST(Lights, SphereGivesPiLTimesTheSquareOfItsSine) {
    const Vec3 center{0.2, -0.4, 3};
    for (const double radius : {1e-4, 0.01, 0.5, 1.5, 2.9}) {
        std::vector<Vec3> points;
        for (const double distance : {1.01, 1.5, 4.0, 50.0})
            points.push_back(center + (distance * radius) * normalize(Vec3{1, 2, -2}));
        const auto answers = samplesFrom(SphereLight{center, radius, {5, 5, 5}}, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 point = unpack(receiverAt(points[i]).point), way = center - point;
            const Span samples = samplesOf(answers, i);
            // positions are floats: at 3 units they are off by a thousandth of a radius of 1e-4
            const double share = radius < 1e-3 ? 0.01 : 2e-3;
            const double squared_sine = radius * radius / dot(way, way);
            expectShare(irradiance(samples, normalize(way)), 5 * pi * squared_sine, share);
            expectShare(solidAngle(samples), 2 * pi * (1 - std::sqrt(1 - squared_sine)), share);
            expectConsistent(samples);
            if (radius < 1e-3) continue;
            for (const LightAnswer& a : samples) { // the distance ends on the sphere
                const Vec3 end = point + a.direction.w * unpack(a.direction);
                ASSERT_NEAR(length(end - center), radius, 2e-3 * radius);
                ASSERT_LT(a.direction.w, length(way));
            }
        }
    }
}

TEST(Lights, SphereShinesInside) {
    const Vec3 center{1, 1, 1};
    const auto answers = samplesFrom(SphereLight{center, 2, {5, 5, 5}}, {center, {1, 2.5, 0.5}});
    for (std::size_t i = 0; i < 2; ++i) {
        const Span samples = samplesOf(answers, i);
        expectShare(irradiance(samples, normalize(Vec3{1, 2, 3})), 5 * pi, 2e-3);
        expectShare(solidAngle(samples), 4 * pi, 1e-5);
        expectConsistent(samples);
        const Vec3 point = i == 0 ? center : Vec3{1, 2.5, 0.5};
        for (const LightAnswer& a : samples)
            ASSERT_NEAR(length(point + a.direction.w * unpack(a.direction) - center), 2, 1e-5);
    }
}

std::array<Vec3, 4> cornersOf(const QuadLight& quad) {
    return {quad.center - quad.u - quad.v, quad.center + quad.u - quad.v, quad.center + quad.u + quad.v,
            quad.center - quad.u + quad.v};
}

/// Lambert's formula: irradiance over radiance of a polygon entirely above the surface.
double lambert(const std::array<Vec3, 4>& corners, Vec3 point, Vec3 normal) {
    Vec3 sum;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 a = normalize(corners[i] - point), b = normalize(corners[(i + 1) % 4] - point);
        const Vec3 across = cross(a, b);
        sum = sum + (std::atan2(length(across), dot(a, b)) / length(across)) * across;
    }
    return 0.5 * std::abs(dot(sum, normal));
}

/// Solid angle of a quad: Van Oosterom and Strackee, over both triangles.
double solidAngleOf(const std::array<Vec3, 4>& corners, Vec3 point) {
    double sum = 0;
    for (const int last : {2, 3}) {
        const Vec3 a = normalize(corners[0] - point), b = normalize(corners[last - 1] - point),
                   c = normalize(corners[last] - point);
        sum += 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    }
    return sum;
}

const QuadLight kPanel{{0.5, 1.0, 3.0}, {1.0, 0.2, 0.0}, 0.5 * normalize({-0.2, 1.0, 0.3}), {5, 5, 5}, true};

QuadLight panel() {
    QuadLight quad = kPanel; // perpendicular
    quad.v = 0.6 * normalize(cross(cross(quad.u, quad.v), quad.u));
    return quad;
}

TEST(Lights, QuadGivesLambertsFormula) {
    const QuadLight quad = panel();
    const Vec3 normal = normalize(cross(quad.u, quad.v));
    std::vector<Vec3> points;
    for (const double depth : {-30.0, -7.0, -2.0, -0.5, -0.05, -0.005, 0.05, 0.5, 2.0})
        for (const Vec3 aside : {Vec3{}, 0.4 * quad.u + 0.9 * quad.v, 2.0 * quad.u + 0.3 * quad.v})
            points.push_back(quad.center + aside + depth * normal);
    const auto answers = samplesFrom(quad, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 point = unpack(receiverAt(points[i]).point);
        const Vec3 facing = dot(quad.center - point, normal) > 0 ? normal : -1 * normal;
        const Span samples = samplesOf(answers, i);
        SCOPED_TRACE(testing::Message() << "point " << i);
        // nearly edge-on, floats give sample positions an error of a hundredth; the light from there is negligible
        const double expected = 5 * lambert(cornersOf(quad), point, facing);
        EXPECT_NEAR(irradiance(samples, facing), expected, 2e-3 * expected + 1e-6);
        expectShare(solidAngle(samples), solidAngleOf(cornersOf(quad), point), 2e-3);
        expectConsistent(samples);
        for (const LightAnswer& a : samples) {
            const Vec3 at = point + a.direction.w * unpack(a.direction) - quad.center;
            ASSERT_NEAR(dot(at, normal), 0, 2e-6 * (1 + a.direction.w));
            ASSERT_LE(std::abs(dot(at, quad.u)), dot(quad.u, quad.u) * (1 + 1e-4));
            ASSERT_LE(std::abs(dot(at, quad.v)), dot(quad.v, quad.v) * (1 + 1e-4));
        }
    }
}

// With samples uniform over the solid angle, only their cosine varies.
TEST(Lights, NearbyQuadIsSampledUniformlyOverSolidAngle) {
    const QuadLight quad = panel();
    const Vec3 normal = normalize(cross(quad.u, quad.v)), point = quad.center + 0.9 * quad.u - 0.3 * normal;
    const auto answers = samplesFrom(quad, {point});
    const double expected = 5 * lambert(cornersOf(quad), unpack(receiverAt(point).point), normal);
    for (std::size_t first = 0; first < 4096; first += 64)
        expectShare(irradiance(Span(answers).subspan(first, 64), normal), expected, 0.03);
}

TEST(Lights, QuadSeenEdgeOnGivesNothing) {
    const QuadLight quad{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, true};
    const auto answers = samplesFrom(quad, {{3, 0, 1}, {30, 0, 1}});
    for (std::size_t i = 0; i < 2; ++i)
        for (const LightAnswer& a : samplesOf(answers, i)) {
            ASSERT_NEAR(a.radiance_over_pdf.x, 0, 1e-5);
            ASSERT_TRUE(std::isfinite(a.radiance_over_pdf.w * a.radiance_over_pdf.w));
            ASSERT_TRUE(std::isfinite(a.direction.x + a.direction.y + a.direction.z + a.direction.w));
        }
}

/// Received light over radiance: the solid angle, without the corners that emit nothing.
double seenAngle(Span answers, double radiance) {
    return mean(answers, [&](const LightAnswer& a) { return a.radiance_over_pdf.x / radiance; });
}

/// View factor of a disc from a point off its axis, for a surface parallel to it.
double discFactor(double radius, double aside, double depth) {
    const double sum = aside * aside + depth * depth + radius * radius, product = 2 * aside * radius;
    return 0.5 * (1 - (sum - 2 * radius * radius) / std::sqrt(sum * sum - product * product));
}

const DiscLight kDisc{{0.5, 1.0, 3.0}, normalize({0.3, -0.5, 0.8}), 0.7, {5, 5, 5}, true};

TEST(Lights, DiscGivesItsViewFactor) {
    const Vec3 along = normalize(cross(kDisc.normal, Vec3{0, 0, 1}));
    std::vector<Vec3> points;
    std::vector<double> expected;
    for (const double depth : {-60.0, -7.0, -2.0, -1.05, -0.95, -0.3, -0.01, 0.01, 0.3, 1.05, 7.0})
        for (const double aside : {0.0, 0.2, 0.9, 1.5, 4.0}) {
            points.push_back(kDisc.center + kDisc.radius * (aside * along + depth * kDisc.normal));
            expected.push_back(5 * pi * discFactor(1, aside, depth));
        }
    const auto answers = samplesFrom(kDisc, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 point = unpack(receiverAt(points[i]).point);
        const Vec3 facing = dot(kDisc.center - point, kDisc.normal) > 0 ? kDisc.normal : -1 * kDisc.normal;
        const Span samples = samplesOf(answers, i);
        SCOPED_TRACE(testing::Message() << "point " << i);
        EXPECT_NEAR(irradiance(samples, facing), expected[i], 4e-3 * expected[i] + 1e-4);
        for (const LightAnswer& a : samples) {
            ASSERT_NEAR(length(unpack(a.direction)), 1, 1e-6);
            ASSERT_NEAR(a.pdf.x / a.radiance_over_pdf.w, 1, 2e-3);
            ASSERT_EQ(a.free.w, 5);
            if (a.radiance_over_pdf.x == 0) continue;
            ASSERT_NEAR(a.radiance_over_pdf.x * a.radiance_over_pdf.w, 5, 0.01);
            const Vec3 at = point + a.direction.w * unpack(a.direction) - kDisc.center;
            ASSERT_NEAR(dot(at, kDisc.normal), 0, 2e-6 * (1 + a.direction.w));
            ASSERT_LE(length(at), kDisc.radius * (1 + 1e-4));
        }
    }
}

// Irradiance pi L r^2 / (r^2 + d^2), and solid angle 2 pi (1 - d / sqrt(r^2 + d^2)).
TEST(Lights, DiscMatchesClosedFormsOnItsAxis) {
    const std::vector<double> distances{0.01, 0.2, 0.6, 0.8, 2, 30};
    std::vector<Vec3> points;
    for (const double d : distances) points.push_back(kDisc.center + d * kDisc.normal);
    const auto answers = samplesFrom(kDisc, points);
    const double squared = kDisc.radius * kDisc.radius;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distances[i];
        expectShare(irradiance(samplesOf(answers, i), -1 * kDisc.normal), 5 * pi * squared / (squared + d * d), 3e-3);
        expectShare(seenAngle(samplesOf(answers, i), 5), 2 * pi * (1 - d / std::sqrt(squared + d * d)), 3e-3);
    }
}

// lightPdf integrates over the disc to the share of samples that receive light: all, except those at the corners of the
// square that is sampled from nearby.
TEST(Lights, DensityOfDiscIntegratesToShareOfLitSamples) {
    for (const double distance : {0.2, 0.65, 0.75, 3.0}) {
        const Vec3 aside = normalize(cross(kDisc.normal, Vec3{0, 0, 1}));
        const Vec3 point = kDisc.center + distance * normalize(kDisc.normal + 0.4 * aside);
        std::vector<Receiver> receivers;
        for (std::uint32_t seed = 0; seed < 16; ++seed)
            receivers.push_back(receiverAt(point)), receivers.back().light.z = seed;
        const auto answers = sampleLights({packLight({}, kDisc)}, receivers);
        const double sum = mean(answers, [&](const LightAnswer& a) {
            const Vec3 direction = unpack(a.free);
            const double t = dot(kDisc.center - point, kDisc.normal) / dot(direction, kDisc.normal);
            return t > 0 && length(point + t * direction - kDisc.center) < kDisc.radius ? double{a.pdf.y} : 0.0;
        });
        const double lit = mean(answers, [](const LightAnswer& a) { return a.radiance_over_pdf.x > 0 ? 1.0 : 0.0; });
        EXPECT_GT(lit, distance > kDisc.radius ? 0.9999 : 0.6);
        EXPECT_NEAR(4 * pi * sum / lit, 1, 0.015) << distance;
    }
}

TEST(Lights, DiscSeenEdgeOnGivesNothing) {
    const DiscLight disc{{0, 0, 1}, {0, 0, 1}, 1, {5, 5, 5}, true};
    const auto answers = samplesFrom(disc, {{3, 0, 1}, {30, 0, 1}});
    for (const LightAnswer& a : answers) {
        ASSERT_NEAR(a.radiance_over_pdf.x, 0, 1e-5);
        ASSERT_TRUE(std::isfinite(a.radiance_over_pdf.w * a.radiance_over_pdf.w));
        ASSERT_TRUE(std::isfinite(a.direction.x + a.direction.y + a.direction.z + a.direction.w));
    }
}

/// Whether a ray from point hits the light.
bool meets(const LightDescription& light, Vec3 point, Vec3 direction) {
    if (const auto* sphere = std::get_if<SphereLight>(&light)) {
        const Vec3 way = sphere->center - point;
        const double along = dot(way, direction), height = dot(way, way) - along * along;
        return height < sphere->radius * sphere->radius &&
               (along > 0 || dot(way, way) < sphere->radius * sphere->radius);
    }
    const auto& quad = std::get<QuadLight>(light);
    const Vec3 normal = cross(quad.u, quad.v);
    const double t = dot(quad.center - point, normal) / dot(direction, normal);
    const Vec3 at = point + t * direction - quad.center;
    return t > 0 && std::abs(dot(at, quad.u)) < dot(quad.u, quad.u) && std::abs(dot(at, quad.v)) < dot(quad.v, quad.v);
}

TEST(Lights, DensitiesIntegrateToOne) {
    const Vec3 point{0.5, 0.5, 0.5};
    const LightDescription lights[] = {SphereLight{{1, 0.5, 2}, 1, {1, 1, 1}},
                                       SphereLight{{0.6, 0.4, 0.5}, 1, {1, 1, 1}},
                                       QuadLight{{0.5, 1.0, 1.5}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, true},
                                       QuadLight{{0.5, 3.0, 7.5}, {0.7, 0, 0}, {0, 0.7, 0}, {1, 1, 1}, true}};
    for (const LightDescription& light : lights) {
        std::vector<Vec3> points(8, point); // one per seed
        std::vector<Receiver> receivers;
        for (std::uint32_t seed = 0; seed < 8; ++seed)
            receivers.push_back(receiverAt(point)), receivers.back().light.z = seed;
        const auto answers = sampleLights({packLight({}, light)}, receivers);
        const double sum = mean(answers, [&](const LightAnswer& a) {
            return meets(light, point, unpack(a.free)) ? static_cast<double>(a.pdf.y) : 0.0;
        });
        expectShare(4 * pi * sum, 1, 0.01);
    }
}

} // namespace
} // namespace pointrt
