// SPDX-License-Identifier: Apache-2.0
// The preview denoiser on synthetic films whose noise-free pictures are known: what it must remove and what it must
// keep.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "runtime/render/picture_filter.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN(),
                kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kSide = 128;

/// Selects the pixels of a statistic.
using Where = std::function<bool(std::uint32_t x, std::uint32_t y)>;
bool everywhere(std::uint32_t, std::uint32_t) { return true; }

/// A white plane that faces the eye, lit by 0.5, without noise or variance.
Film planeFilm(std::uint32_t width, std::uint32_t height) {
    const std::size_t pixels = std::size_t{width} * height;
    Film film;
    film.width = width;
    film.height = height;
    film.rgba.assign(4 * pixels, 0.5f);
    film.depth.assign(pixels, 2.0f);
    film.normal.assign(3 * pixels, 0.0f);
    film.albedo.assign(3 * pixels, 1.0f);
    film.variance.assign(pixels, 0.0f);
    film.samples.assign(pixels, 4.0f);
    for (std::size_t i = 0; i < pixels; ++i) film.rgba[4 * i + 3] = film.normal[3 * i + 2] = 1;
    return film;
}

void setRgb(Film& film, std::size_t pixel, float value) {
    for (std::size_t c = 0; c < 3; ++c) film.rgba[4 * pixel + c] = value;
}

/// Multiplies light by the mean of 4 samples with the given deviation; the variance is estimated from the same 4.
void addNoise(Film& film, float deviation) {
    std::mt19937 random(1);
    std::normal_distribution<float> sample(1.0f, deviation);
    for (std::size_t i = 0; i < film.depth.size(); ++i) {
        float sum = 0, squares = 0;
        for (int s = 0; s < 4; ++s) {
            const float value = sample(random);
            sum += value;
            squares += value * value;
        }
        const float mean = sum / 4, light = film.rgba[4 * i];
        film.variance[i] = light * light * (squares / 4 - mean * mean) / 3;
        setRgb(film, i, light * mean);
    }
}

double meanOf(const Film& film, const Where& where) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < film.rgba.size() / 4; ++i)
        if (where(i % film.width, i / film.width)) {
            sum += film.rgba[4 * i + 1];
            ++count;
        }
    return sum / count;
}

/// Root mean square of film / truth - 1.
double errorOf(const Film& film, const Film& truth, const Where& where = everywhere) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < film.rgba.size() / 4; ++i)
        if (where(i % film.width, i / film.width)) {
            const double off = film.rgba[4 * i + 1] / truth.rgba[4 * i + 1] - 1;
            sum += off * off;
            ++count;
        }
    return std::sqrt(sum / count);
}

bool isLeft(std::uint32_t x, std::uint32_t) { return x < kSide / 2; }
bool isRight(std::uint32_t x, std::uint32_t) { return x >= kSide / 2; }

class DenoiserTest : public DeviceFixture {
protected:
    Film denoised(Film film) {
        denoiseFilm(device, film);
        return film;
    }

    /// Light is 0.2 on the left half and 0.8 on the right, with a variance so large that only edges in the guides, set
    /// by `edge` on the right, keep the halves apart.
    void expectGuidesKeepHalvesApart(const std::function<void(Film&, std::size_t right_pixel)>& edge) {
        Film film = planeFilm(kSide, kSide);
        for (std::size_t i = 0; i < film.depth.size(); ++i) {
            const bool right = isRight(i % kSide, 0);
            setRgb(film, i, right ? 0.8f : 0.2f);
            if (right) edge(film, i);
        }
        addNoise(film, 0.1f);
        film.variance.assign(film.variance.size(), 10.0f);
        const Film result = denoised(film);
        const auto beside = [](std::uint32_t x, std::uint32_t) { return x == kSide / 2 - 1; };
        const auto beyond = [](std::uint32_t x, std::uint32_t) { return x == kSide / 2; };
        EXPECT_NEAR(meanOf(result, isLeft), 0.2, 0.002);
        EXPECT_NEAR(meanOf(result, isRight), 0.8, 0.008);
        EXPECT_NEAR(meanOf(result, beside), 0.2, 0.002);
        EXPECT_NEAR(meanOf(result, beyond), 0.8, 0.008);
    }
};

// Glass on a dark floor: the colours are alike, the light divided by the albedo is not, and at the outline the albedo
// is the mean of both.
TEST_F(DenoiserTest, OutlinesOfGlassOnADarkFloorDoNotShine) {
    Film film = planeFilm(kSide, kSide);
    constexpr std::uint32_t kOutline = kSide / 2 - 1;
    for (std::size_t i = 0; i < film.depth.size(); ++i) {
        const std::uint32_t x = i % kSide;
        const float albedo = x < kOutline ? 0.05f : x == kOutline ? 0.525f : 1.0f;
        for (std::size_t c = 0; c < 3; ++c) film.albedo[3 * i + c] = albedo;
        if (isLeft(x, 0)) film.depth[i] = 3; // the centre of the outline's pixels is on the floor
        setRgb(film, i, 0.3f);
    }
    addNoise(film, 0.5f);
    const Film result = denoised(film);
    const auto outline = [](std::uint32_t x, std::uint32_t) { return x == kOutline; };
    EXPECT_NEAR(meanOf(result, outline), 0.3, 0.09); // the second brightest of nine pixels is 0.37 in the mean
    EXPECT_NEAR(meanOf(result, isLeft), 0.3, 0.01);
    EXPECT_NEAR(meanOf(result, isRight), 0.3, 0.01);
}

TEST_F(DenoiserTest, RemovesNoiseOfAPlaneAndKeepsItsMean) {
    const Film truth = planeFilm(kSide, kSide);
    for (const float deviation : {0.1f, 0.5f}) {
        Film noisy = truth;
        addNoise(noisy, deviation);
        const Film result = denoised(noisy);
        EXPECT_LT(4 * errorOf(result, truth), errorOf(noisy, truth));
        EXPECT_NEAR(meanOf(result, everywhere) / meanOf(noisy, everywhere), 1, 0.005);
    }
}

// With skewed noise, bright pixels have a large variance and dark ones a small one, which costs some light; one-sided
// weights lose twice as much.
TEST_F(DenoiserTest, LosesLittleLightToSkewedNoise) {
    Film noisy = planeFilm(kSide, kSide);
    std::mt19937 random(1);
    std::exponential_distribution<float> light(2.0f);
    for (std::size_t i = 0; i < noisy.depth.size(); ++i) {
        float sum = 0, squares = 0;
        for (int s = 0; s < 4; ++s) {
            const float value = light(random);
            sum += value;
            squares += value * value;
        }
        setRgb(noisy, i, sum / 4);
        noisy.variance[i] = (squares / 4 - sum * sum / 16) / 3;
    }
    EXPECT_NEAR(meanOf(denoised(noisy), everywhere) / meanOf(noisy, everywhere), 1, 0.02);
}

// In a room, a path that meets the lit patch beside a lamp makes one pixel in ten three times as bright as the wall:
// too many, and too faint, to clamp as fireflies.
TEST_F(DenoiserTest, SpreadsBrightSamplesOverTheirSurface) {
    Film noisy = planeFilm(kSide, kSide);
    std::mt19937 random(1);
    std::bernoulli_distribution is_bright(0.1);
    const float usual = 0.5f, bright = 8, samples = 8;
    for (std::size_t i = 0; i < noisy.depth.size(); ++i) {
        const float spread = is_bright(random) ? bright - usual : 0.01f; // deviation of one sample from the others
        setRgb(noisy, i, usual + spread / samples);
        noisy.variance[i] = spread * spread / (samples * samples); // (n - 1) / n spread^2 / n / (n - 1)
    }
    const Film result = denoised(noisy);
    const double mean = meanOf(noisy, everywhere);
    EXPECT_NEAR(meanOf(result, everywhere) / mean, 1, 0.02);
    std::size_t specks = 0;
    for (std::size_t i = 0; i < result.depth.size(); ++i) specks += result.rgba[4 * i] > 1.5 * mean;
    // Pixels whose 3x3 neighbourhood is mostly bright: 1 in 1,100 by the binomial distribution.
    EXPECT_LT(specks, result.depth.size() / 500);
}

// A lamp reflected within glass: few samples are many times as bright as the rest.
TEST_F(DenoiserTest, RareBrightSamplesLeaveNoDots) {
    constexpr std::uint32_t kLow = 40, kHigh = 88, kSamples = 32;
    constexpr float kChance = 0.01f, kBright = 100;
    const auto inside = [](std::uint32_t x, std::uint32_t y) {
        return x >= kLow && x < kHigh && y >= kLow && y < kHigh;
    };
    Film film = planeFilm(kSide, kSide);
    addNoise(film, 0.01f);
    std::mt19937 random(5);
    std::binomial_distribution<int> hits(kSamples, kChance);
    for (std::size_t i = 0; i < film.depth.size(); ++i)
        if (inside(i % kSide, i / kSide)) {
            const float share = static_cast<float>(hits(random)) / kSamples;
            setRgb(film, i, film.rgba[4 * i] + share * kBright);
            film.variance[i] += share * (1 - share) * kBright * kBright / (kSamples - 1);
        }
    const Film result = denoised(film);
    double squares = 0, light = 0;
    for (std::uint32_t y = kLow + 4; y < kHigh - 4; ++y)
        for (std::uint32_t x = kLow + 4; x < kHigh - 4; ++x) {
            const auto at = [&](std::uint32_t column) { return result.rgba[4 * (y * kSide + column) + 1]; };
            squares += (at(x + 1) - at(x)) * (at(x + 1) - at(x));
            light += at(x);
        }
    const double count = (kHigh - kLow - 8.0) * (kHigh - kLow - 8.0);
    // 0.44 if variances are smoothed over every second pixel, 0.17 over all
    EXPECT_LT(std::sqrt(squares / count) / (light / count), 0.25) << "differences of neighbours over the light";
}

TEST_F(DenoiserTest, EstimatesAMissingVariance) {
    const Film truth = planeFilm(kSide, kSide);
    Film noisy = truth;
    addNoise(noisy, 0.5f);
    Film sampled_once = noisy;
    noisy.variance.clear();
    sampled_once.variance.assign(sampled_once.variance.size(), 0.0f);
    sampled_once.samples.assign(sampled_once.samples.size(), 1.0f);
    const Film result = denoised(noisy);
    EXPECT_LT(4 * errorOf(result, truth), errorOf(noisy, truth));
    EXPECT_NEAR(meanOf(result, everywhere) / meanOf(noisy, everywhere), 1, 0.005);
    EXPECT_EQ(denoised(sampled_once).rgba, result.rgba);
}

TEST_F(DenoiserTest, WorksWithoutGuides) {
    const Film truth = planeFilm(kSide, kSide);
    Film noisy = truth;
    addNoise(noisy, 0.3f);
    for (std::vector<float>* guide : {&noisy.normal, &noisy.depth, &noisy.albedo, &noisy.samples}) guide->clear();
    EXPECT_LT(4 * errorOf(denoised(noisy), truth), errorOf(noisy, truth));
}

// A floor whose far end is ten times as far away: depths of adjacent rows differ as much as at edges.
TEST_F(DenoiserTest, FollowsATiltedPlane) {
    Film facing = planeFilm(kSide, kSide);
    const Film truth = facing;
    addNoise(facing, 0.3f);
    Film tilted = facing;
    for (std::size_t i = 0; i < truth.depth.size(); ++i)
        tilted.depth[i] = 1 / (0.05f + 0.0035f * static_cast<float>(i / kSide));
    EXPECT_LT(errorOf(denoised(tilted), truth), 1.1 * errorOf(denoised(facing), truth));
}

TEST_F(DenoiserTest, StopsAtEdgesOfTheNormal) {
    expectGuidesKeepHalvesApart([](Film& film, std::size_t pixel) {
        film.normal[3 * pixel] = 0.6f;
        film.normal[3 * pixel + 2] = -0.8f;
    });
}

TEST_F(DenoiserTest, StopsAtEdgesOfTheDepth) {
    expectGuidesKeepHalvesApart([](Film& film, std::size_t pixel) { film.depth[pixel] = 3; });
}

TEST_F(DenoiserTest, DoesNotBlendInTheBackground) {
    expectGuidesKeepHalvesApart([](Film& film, std::size_t pixel) { film.rgba[4 * pixel + 3] = 0; });
}

TEST_F(DenoiserTest, LeavesTheBackgroundUnchanged) {
    Film film = planeFilm(kSide, kSide);
    for (std::size_t i = 0; i < film.depth.size(); ++i)
        if (isRight(i % kSide, 0)) {
            film.rgba[4 * i + 3] = film.normal[3 * i + 2] = film.albedo[3 * i] = 0;
            film.depth[i] = kFloatInfinity;
            setRgb(film, i, 100);
        }
    addNoise(film, 0.3f);
    const Film result = denoised(film);
    for (std::size_t i = 0; i < film.rgba.size(); ++i)
        if (isRight(i / 4 % kSide, 0)) {
            ASSERT_EQ(result.rgba[i], film.rgba[i]) << i;
        }
    EXPECT_NEAR(meanOf(result, isLeft) / meanOf(film, isLeft), 1, 0.005);
}

// A column of half-covered pixels, which get half of their light from a bright background.
TEST_F(DenoiserTest, PartlyCoveredPixelsSpreadNoBackground) {
    Film film = planeFilm(kSide, kSide);
    for (std::size_t i = kSide / 2; i < film.depth.size(); i += kSide) {
        film.rgba[4 * i + 3] = 0.5f;
        setRgb(film, i, 50);
    }
    film.variance.assign(film.variance.size(), 1e4f);
    const Film result = denoised(film);
    for (std::size_t i = 0; i < film.rgba.size(); ++i) ASSERT_NEAR(result.rgba[i], film.rgba[i], 1e-4 * film.rgba[i]);
}

TEST_F(DenoiserTest, KeepsTextureOfTheAlbedo) {
    Film truth = planeFilm(kSide, kSide);
    for (std::size_t i = 0; i < truth.depth.size(); ++i) {
        const float albedo = (i % kSide / 4 + i / kSide / 4) % 2 ? 0.8f : 0.1f;
        for (std::size_t c = 0; c < 3; ++c) truth.albedo[3 * i + c] = albedo;
        setRgb(truth, i, 0.5f * albedo);
    }
    Film noisy = truth;
    addNoise(noisy, 0.2f);
    const Film result = denoised(noisy);
    EXPECT_LT(errorOf(result, truth), 0.01);
    EXPECT_LT(8 * errorOf(result, truth), errorOf(noisy, truth));
}

TEST_F(DenoiserTest, KeepsShadowEdgesOfLowVariance) {
    Film truth = planeFilm(kSide, kSide);
    for (std::size_t i = 0; i < truth.depth.size(); ++i) setRgb(truth, i, isRight(i % kSide, 0) ? 0.6f : 0.3f);
    Film noisy = truth;
    addNoise(noisy, 0.1f);
    const Film result = denoised(noisy);
    const auto at_edge = [](std::uint32_t x, std::uint32_t) { return x == kSide / 2 - 1 || x == kSide / 2; };
    EXPECT_LT(2 * errorOf(result, truth, at_edge), errorOf(noisy, truth, at_edge));
    EXPECT_LT(4 * errorOf(result, truth), errorOf(noisy, truth));
}

// As in a mirror: detail of single pixels that no guide shows.
TEST_F(DenoiserTest, KeepsPixelsOfZeroVariance) {
    Film film = planeFilm(kSide, kSide);
    addNoise(film, 1.0f);
    film.variance.assign(film.variance.size(), 0.0f);
    const Film result = denoised(film);
    for (std::size_t i = 0; i < film.rgba.size(); ++i)
        ASSERT_NEAR(result.rgba[i], film.rgba[i], 1e-5 * std::abs(film.rgba[i])) << i;
}

// A mirror that shows a noisy object in front of black. Variances are smoothed over 2 pixels.
TEST_F(DenoiserTest, ConvergedPixelsTakeNoLightFromNoisyOnes) {
    Film film = planeFilm(kSide, kSide);
    for (std::size_t i = 0; i < film.depth.size(); ++i)
        if (isRight(i % kSide, 0)) setRgb(film, i, 0);
    addNoise(film, 1.0f);
    const Film result = denoised(film);
    const auto certain = [](std::uint32_t x, std::uint32_t) { return x >= kSide / 2 + 2; };
    EXPECT_EQ(meanOf(result, certain), 0);
}

TEST_F(DenoiserTest, LeavesLampsUnchanged) {
    Film film = planeFilm(kSide, kSide);
    addNoise(film, 0.3f);
    const std::size_t lamp = kSide * kSide / 2 + kSide / 2;
    setRgb(film, lamp, 1000);
    film.variance[lamp] = 0;
    for (std::size_t c = 0; c < 3; ++c) film.albedo[3 * lamp + c] = 0;
    const Film result = denoised(film);
    EXPECT_EQ(result.rgba[4 * lamp], 1000);
    EXPECT_LT(result.rgba[4 * lamp + 4], 0.7f);
}

TEST_F(DenoiserTest, ClampsAFireflyButNoHighlight) {
    Film film = planeFilm(kSide, kSide);
    addNoise(film, 0.3f);
    const std::size_t pixel = kSide * kSide / 2 + kSide / 2;
    setRgb(film, pixel, 50);
    film.variance[pixel] = 50 * 50;
    const Film result = denoised(film);
    for (std::size_t i = 0; i < result.rgba.size(); i += 4) ASSERT_LT(result.rgba[i], 0.8f) << i / 4;
    film.variance[pixel] = 0.1f;
    EXPECT_NEAR(denoised(film).rgba[4 * pixel], 50, 0.5);
}

TEST_F(DenoiserTest, ReplacesNonFiniteValues) {
    const Film truth = planeFilm(kSide, kSide);
    Film film = truth;
    addNoise(film, 0.3f);
    const double before = errorOf(film, truth);
    const float bad[] = {kFloatNan, kFloatInfinity, -kFloatInfinity};
    film.rgba[4 * 50] = film.variance[51] = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < film.depth.size(); i += 97) {
        const float value = bad[i % 3];
        film.rgba[4 * i + i / 97 % 3] = value;
        film.variance[i + 11] = value;
        film.normal[3 * (i + 22)] = value;
        film.depth[i + 33] = value;
        film.albedo[3 * (i + 44)] = value;
    }
    const Film result = denoised(film);
    for (std::size_t i = 0; i < result.rgba.size(); ++i) ASSERT_TRUE(std::isfinite(result.rgba[i])) << i;
    EXPECT_LT(errorOf(result, truth), before / 2);
}

TEST_F(DenoiserTest, ReplacesNonFiniteValuesInTheBackground) {
    Film film = planeFilm(5, 5);
    for (std::size_t i = 0; i < 25; ++i) film.rgba[4 * i + 3] = 0;
    film.rgba[4 * 12] = kFloatNan;
    const Film result = denoised(film);
    for (std::size_t i = 0; i < 25; ++i) EXPECT_EQ(result.rgba[4 * i], 0.5f);
}

TEST_F(DenoiserTest, AcceptsFilmsOfAnySize) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 5u}, {1u, 40u}, {131u, 2u}}) {
        Film film = planeFilm(width, height);
        film.variance.assign(film.variance.size(), 0.01f);
        const Film result = denoised(film);
        ASSERT_EQ(result.rgba.size(), film.rgba.size());
        for (std::size_t i = 0; i < film.rgba.size(); ++i) EXPECT_NEAR(result.rgba[i], film.rgba[i], 1e-6);
    }
    EXPECT_TRUE(denoised(Film{}).rgba.empty());
}

/// A film with edges in every guide, fireflies, and pixels that are NaN.
Film unevenFilm(std::uint32_t width, std::uint32_t height) {
    Film film = planeFilm(width, height);
    addNoise(film, 0.5f);
    for (std::size_t i = 0; i < film.depth.size(); ++i) {
        const std::size_t x = i % width, y = i / width;
        film.depth[i] = x > width / 2 ? 2.0f + 0.01f * static_cast<float>(y) : 5.0f;
        film.normal[3 * i] = y > height / 3 ? 0.6f : 0.0f;
        film.albedo[3 * i + 1] = (x / 7 + y / 5) % 2 ? 0.3f : 0.9f;
        if (i % 97 == 0) setRgb(film, i, 40.0f);
        if (i % 211 == 0) setRgb(film, i, kFloatNan);
        if (i % 31 == 0) film.rgba[4 * i + 3] = i % 2 ? 0.0f : 0.4f;
    }
    return film;
}

TEST_F(DenoiserTest, DoesNotDependOnTiles) {
    const PixelSize size{203, 171};
    const Film film = unevenFilm(size.width, size.height);
    for (const auto& [has_variance, wraps] : {std::pair{true, false}, {false, false}, {true, true}}) {
        std::vector<std::vector<float>> pictures;
        const std::uint32_t whole = filterTileFor(size, wraps).width;
        for (const FilterTile tile : {FilterTile{whole, 171}, {whole, 71}, {81, 171}, {73, 75}}) {
            std::vector<float>& picture = pictures.emplace_back();
            PictureFilter filter(device, {size, has_variance, true, tile, wraps}, [&](std::span<const float> rgba) {
                picture.insert(picture.end(), rgba.begin(), rgba.end());
            });
            for (std::uint32_t row = 0, rows = 1; row < size.height;
                 row += rows, rows = std::min(9u, size.height - row))
                filter.addRows(film, row, rows);
            ASSERT_EQ(picture.size(), film.rgba.size());
        }
        for (std::size_t i = 1; i < pictures.size(); ++i)
            EXPECT_EQ(std::memcmp(pictures[i].data(), pictures[0].data(), film.rgba.size() * sizeof(float)), 0) << i;
    }
}

/// In a panorama it does not matter which column is the first.
TEST_F(DenoiserTest, ThePicturesEdgesMeetIfItWraps) {
    const PixelSize size{203, 71};
    constexpr std::uint32_t kTurn = 50;
    const Film film = unevenFilm(size.width, size.height);
    Film turned = film;
    const auto turn = [&](std::vector<float>& to, const std::vector<float>& from, std::size_t channels) {
        for (std::size_t i = 0; i < from.size(); ++i) {
            const std::size_t pixel = i / channels, row = pixel / size.width;
            const std::size_t column = (pixel % size.width + kTurn) % size.width;
            to[channels * (row * size.width + column) + i % channels] = from[i];
        }
    };
    turn(turned.rgba, film.rgba, 4);
    turn(turned.normal, film.normal, 3);
    turn(turned.depth, film.depth, 1);
    turn(turned.albedo, film.albedo, 3);
    turn(turned.variance, film.variance, 1);
    Film expected = film;
    denoiseFilm(device, turned, true);
    Film straight = film, cut = film;
    denoiseFilm(device, straight, true);
    denoiseFilm(device, cut);
    turn(expected.rgba, straight.rgba, 4);
    const auto differ = [](const Film& a, const Film& b) { // some values are NaN
        return std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) != 0;
    };
    EXPECT_FALSE(differ(turned, expected));
    EXPECT_TRUE(differ(straight, cut)) << "else the test says nothing";
}

TEST_F(DenoiserTest, TilesFitTheBuffersOfAnyDevice) {
    constexpr std::uint64_t kBytesBound = 1u << 27, kTexel = 16; // the minimum that Vulkan guarantees
    for (const PixelSize size : {PixelSize{4000, 3000}, {16384, 16384}, {1, 16384}, {16384, 200}}) {
        const FilterTile tile = filterTileFor(size);
        EXPECT_LE(kTexel * tile.width * tile.rows, kBytesBound);
        EXPECT_TRUE(tile.width == size.width || tile.width > 8 * kDenoiseReach);
        EXPECT_TRUE(tile.rows == size.height || tile.rows > 7 * kDenoiseReach);
    }
    EXPECT_EQ(filterTileFor({1920, 1080}).rows, 1080u) << "one tile";
}

TEST_F(DenoiserTest, RefusesArraysOfAnotherSize) {
    Film film = planeFilm(8, 8);
    film.normal.pop_back();
    EXPECT_THROW(denoiseFilm(device, film), std::logic_error);
    film = planeFilm(8, 8);
    film.rgba.clear();
    EXPECT_THROW(denoiseFilm(device, film), std::logic_error);
}

/// A device buffer with a texel per pixel: the first three of its `count` values, then the fourth in last.
Buffer texelsOf(Device& device, const std::vector<float>& values, std::size_t count, const std::vector<float>& last) {
    std::vector<float> texels;
    for (std::size_t i = 0; i < last.size(); ++i) {
        texels.insert(texels.end(), values.begin() + i * count, values.begin() + i * count + 3);
        texels.push_back(last[i]);
    }
    Buffer buffer = createFilledBuffer(device, "texels", texels.data(), texels.size() * sizeof(float),
                                       VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, "texels", buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
    return buffer;
}

TEST_F(DenoiserTest, FiltersSeveralFramesOnTheDevice) {
    Film film = planeFilm(70, 33);
    addNoise(film, 0.3f);
    std::vector<float> alpha;
    for (std::size_t i = 0; i < film.depth.size(); ++i) alpha.push_back(film.rgba[4 * i + 3]);
    Buffer color = texelsOf(device, film.rgba, 4, alpha), surface = texelsOf(device, film.normal, 3, film.depth),
           albedo = texelsOf(device, film.albedo, 3, film.variance);
    Denoiser denoiser = createDenoiser(device, film.width, film.height, {&color, &surface, &albedo});
    const Film expected = denoised(film);
    for (int frame = 0; frame < 2; ++frame) {
        const VkCommandBuffer commands = beginCommands(device);
        recordDenoise(commands, denoiser);
        recordDenoise(commands, denoiser);
        submitAndWait(device, commands);
        std::vector<float> result(film.rgba.size());
        downloadBuffer(device, denoiser.result, result.data(), result.size() * sizeof(float));
        EXPECT_EQ(result, expected.rgba);
    }
    destroyDenoiser(device, denoiser);
    for (Buffer* buffer : {&color, &surface, &albedo}) destroyBuffer(device, *buffer);
}

} // namespace
} // namespace pointrt
