// SPDX-License-Identifier: Apache-2.0
// The codec of Gaussians keeps to the worst-case errors in SPEC.md, and files of Gaussians read back as written.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_gaussians.h"
#include "tiny_index.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

// SPEC.md, "Precision". Rotation, in radians: each of the three stored components is off by at most
// h = 1 / (sqrt(2) 4095). That moves a unit quaternion with the largest component w by sqrt(3) h / w at most, w is at
// least 1/2, and a rotation turns by twice the angle between quaternions: 4 sqrt(3) h = 1.1963e-3; terms of second
// order add 5e-4 of it.
constexpr double kRotationError = 1.199e-3;
constexpr double kOpacityError = 0.5 / 1023;
constexpr double kMeanError = 0x1p-28; // half a step of 2^-21 / 64, cube units per axis

pro_gaussians wideCoding() {
    pro_gaussians coding{};
    coding.deviation_low = -20;
    coding.deviation_step = 0.005f;
    coding.color_low = -1;
    coding.color_step = 0.01f;
    return coding;
}

pro_gaussian plainGaussian() {
    return {{0.5, 0.5, 0.5}, {0.01f, 0.01f, 0.01f}, {1, 0, 0, 0}, 0.5f, {0.5f, 0.5f, 0.5f}};
}

struct CodedGaussian {
    std::array<std::uint32_t, PRO_SPLAT_WORDS> splat{};
    std::array<std::uint32_t, PRO_GAUSSIAN_WORDS> words{};
    pro_gaussian decoded{};
};

CodedGaussian codeGaussian(const pro_gaussian& gaussian, const pro_gaussians& coding) {
    CodedGaussian coded;
    pro_splat splat{};
    for (int axis = 0; axis < 3; ++axis) // the middle of the step: a mean rounded to float may lie in the next one
        splat.position[axis] = static_cast<float>((std::floor(gaussian.mean[axis] * 0x1p21) + 0.5) * 0x1p-21);
    pro_splat_encode(&splat, 1, 0, coded.splat.data());
    pro_gaussian_encode(&gaussian, &coding, coded.splat.data(), coded.words.data());
    pro_gaussian_decode(&coding, coded.splat.data(), coded.words.data(), &coded.decoded);
    return coded;
}

/// Angle of the rotation from one to the other, by the chord, which is exact for small angles, too.
double turnBetween(const float a[4], const float b[4]) {
    double same = 0, opposite = 0;
    for (int i = 0; i < 4; ++i) {
        same += std::pow(double{a[i]} - b[i], 2);
        opposite += std::pow(double{a[i]} + b[i], 2);
    }
    return 4 * std::asin(std::sqrt(std::min(same, opposite)) / 2);
}

TEST(GaussianCodec, RotationsStayWithinTheStatedAngle) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    double worst = 0;
    for (int i = 0; i < 300000; ++i) {
        pro_gaussian gaussian = plainGaussian();
        const bool even = i % 2 == 0; // the worst case is where no component is larger than the others
        float squared = 0;
        for (float& each : gaussian.rotation) {
            each = even ? std::copysign(1 + 0.01f * normal(random), normal(random)) : normal(random);
            squared += each * each;
        }
        for (float& each : gaussian.rotation) each /= std::sqrt(squared);
        const pro_gaussian decoded = codeGaussian(gaussian, wideCoding()).decoded;
        double norm = 0;
        for (const float each : decoded.rotation) norm += double{each} * each;
        ASSERT_NEAR(norm, 1, 8e-7);
        const double angle = turnBetween(gaussian.rotation, decoded.rotation);
        ASSERT_LE(angle, kRotationError) << i;
        worst = std::max(worst, angle);
    }
    EXPECT_GE(worst, 0.9 * kRotationError) << "SPEC.md could state less";
}

TEST(GaussianCodec, RotationsOfAnyCodesAreUnit) {
    std::mt19937 random(2);
    for (int i = 0; i < 100000; ++i) {
        const std::uint32_t splat[PRO_SPLAT_WORDS] = {};
        const bool extreme = i % 2 == 0; // three components of 1/sqrt(2) belong to no unit quaternion
        const auto word = [&] { return static_cast<std::uint32_t>(random()) | (extreme ? 0x00FFFFFFu : 0u); };
        const std::uint32_t words[PRO_GAUSSIAN_WORDS] = {word(), word(), word(), word()};
        pro_gaussian decoded;
        const pro_gaussians coding = wideCoding();
        pro_gaussian_decode(&coding, splat, words, &decoded);
        double squared = 0;
        for (const float each : decoded.rotation) squared += double{each} * each;
        ASSERT_NEAR(squared, 1, 1e-6);
    }
}

TEST(GaussianCodec, DeviationsStayWithinHalfAStep) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 300000; ++i) {
        pro_gaussians coding = wideCoding();
        coding.deviation_low = -60 + 50 * unit(random);
        coding.deviation_step = 0.0001f + 0.01f * unit(random);
        pro_gaussian gaussian = plainGaussian();
        for (float& each : gaussian.deviation)
            each = std::exp2(coding.deviation_low + 4095 * unit(random) * coding.deviation_step);
        const pro_gaussian decoded = codeGaussian(gaussian, coding).decoded;
        for (int axis = 0; axis < 3; ++axis) {
            const double octaves = std::log2(double{decoded.deviation[axis]} / gaussian.deviation[axis]);
            ASSERT_LE(std::fabs(octaves), coding.deviation_step / 2 + 1e-5) << "and rounding of floats up to 60";
        }
    }
}

TEST(GaussianCodec, OpacitiesColoursAndMeansStayWithinHalfAStep) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    const pro_gaussians coding = wideCoding();
    for (int i = 0; i < 300000; ++i) {
        pro_gaussian gaussian = plainGaussian();
        gaussian.opacity = static_cast<float>(unit(random));
        for (double& each : gaussian.mean) each = unit(random);
        for (float& each : gaussian.color)
            each = static_cast<float>(coding.color_low + 510 * coding.color_step * unit(random));
        const pro_gaussian decoded = codeGaussian(gaussian, coding).decoded;
        ASSERT_LE(std::fabs(double{decoded.opacity} - gaussian.opacity), kOpacityError + 1e-7);
        for (int k = 0; k < 3; ++k) {
            ASSERT_LE(std::fabs(decoded.mean[k] - gaussian.mean[k]), kMeanError);
            const double steps = k == 2 ? 1 : 0.5; // blue has half a bit less
            ASSERT_LE(std::fabs(double{decoded.color[k]} - gaussian.color[k]), steps * coding.color_step + 1e-6);
        }
    }
}

TEST(GaussianCodec, ValuesOutsideTheCodingAreClamped) {
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const pro_gaussians coding = wideCoding();
    pro_gaussian gaussian{{-1, 2, nan}, {0, infinite, nan}, {0, 0, 0, 0}, 1.5f, {-9, 9, nan}};
    const pro_gaussian low = codeGaussian(gaussian, coding).decoded;
    EXPECT_EQ(low.mean[0], 0.5 / 64 * 0x1p-21);
    EXPECT_EQ(low.mean[1], 1 - 0.5 / 64 * 0x1p-21);
    EXPECT_EQ(low.mean[2], 0.5 / 64 * 0x1p-21);
    EXPECT_EQ(low.deviation[0], std::exp2(-20.0f));
    EXPECT_FLOAT_EQ(low.deviation[1], std::exp2(-20.0f + 4095 * 0.005f));
    EXPECT_EQ(low.deviation[2], low.deviation[0]);
    EXPECT_NEAR(low.rotation[0], 1, 1e-6) << "no rotation";
    EXPECT_EQ(low.opacity, 1.0f);
    EXPECT_EQ(low.color[0], -1.0f);
    EXPECT_FLOAT_EQ(low.color[1], -1 + 511 * 0.01f);
    EXPECT_EQ(low.color[2], -1.0f);
    gaussian.rotation[2] = infinite;
    gaussian.opacity = nan;
    const pro_gaussian odd = codeGaussian(gaussian, coding).decoded;
    EXPECT_NEAR(odd.rotation[0], 1, 1e-6);
    EXPECT_EQ(odd.opacity, 0.0f);
    const pro_gaussians empty{};
    EXPECT_EQ(codeGaussian(plainGaussian(), empty).words[2] & 0xFFFFFF, 0u) << "a coding without steps";
}

TEST(GaussianCodec, WordsAreLaidOutAsSpecified) {
    pro_gaussians coding{};
    coding.deviation_low = -12;
    coding.deviation_step = 0.0078125f;
    coding.color_low = 0;
    coding.color_step = 1;
    // residuals 1, 2 and 3 of step 5; codes of 1, 2 and 3 octaves; a half turn, slightly tilted, around x
    const auto mean = [](double residual) { return (5 + (residual + 0.5) / 64) * 0x1p-21; };
    const auto component = [](double code) { return static_cast<float>((2 * code / 4095 - 1) / std::sqrt(2.0)); };
    pro_gaussian gaussian{{mean(1), mean(2), mean(3)},
                          {0x1p-11f, 0x1p-10f, 0x1p-9f},
                          {-component(2000), 0, -component(2100), -component(2200)},
                          603.0f / 1023,
                          {300, 200, 100}};
    gaussian.rotation[1] = -std::sqrt(1 - component(2000) * component(2000) - component(2100) * component(2100) -
                                      component(2200) * component(2200));
    const auto& words = codeGaussian(gaussian, coding).words;
    EXPECT_EQ(words[0], 2000u | 2100u << 12 | 1u << 24 | 1u << 26) << "the largest component becomes positive";
    EXPECT_EQ(words[1], 2200u | 128u << 12 | 2u << 24 | 3u << 30) << "603 is 150 * 4 + 3";
    EXPECT_EQ(words[2], 256u | 384u << 12 | 150u << 24);
    EXPECT_EQ(words[3], 3u | 300u << 6 | 200u << 15 | 50u << 24);
}

TEST(GaussianCodec, HarmonicsByDegree) {
    const std::uint32_t counts[] = {0, 3, 8, 15, 0};
    for (std::uint32_t degree = 0; degree < 5; ++degree) EXPECT_EQ(pro_harmonic_count(degree), counts[degree]);
    EXPECT_EQ(pro_harmonic_count(0xFFFFFFFF), 0u);
}

/// The pointers in two sets of Gaussians must be equal, and all other bytes.
void expectSameGaussians(const pro_gaussians& read, const TinyGaussians& written) {
    const pro_gaussians view = written.view();
    EXPECT_EQ(read.degree, view.degree);
    EXPECT_EQ(read.deviation_low, view.deviation_low);
    EXPECT_EQ(read.deviation_step, view.deviation_step);
    EXPECT_EQ(read.color_low, view.color_low);
    EXPECT_EQ(read.color_step, view.color_step);
    EXPECT_TRUE(std::ranges::equal(read.harmonic_max, view.harmonic_max));
    ASSERT_EQ(read.node_count, view.node_count);
    ASSERT_EQ(read.list_count, view.list_count);
    EXPECT_TRUE(std::equal(written.words.begin(), written.words.end(), read.words));
    EXPECT_EQ(read.harmonics != nullptr, read.degree > 0);
    EXPECT_TRUE(std::equal(written.harmonics.begin(), written.harmonics.end(), read.harmonics));
    EXPECT_TRUE(std::equal(written.nodes.begin(), written.nodes.end(), read.nodes));
    EXPECT_TRUE(std::equal(written.lists.begin(), written.lists.end(), read.lists));
}

TEST(Gaussians, ReadBackAsWritten) {
    for (std::uint32_t degree = 0; degree <= PRO_HARMONICS_DEGREE_MAX; ++degree) {
        const TemporaryFolder folder;
        Scene scene = tinyScene();
        const TinyGaussians gaussians(scene, degree);
        ASSERT_EQ(gaussians.write(scene, folder.file("a.pro")), PRO_OK);
        EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
        for (const std::uint32_t flags : {0u, std::uint32_t{PRO_OPEN_TRACE}}) {
            const ProFile file(folder.file("a.pro"), flags);
            EXPECT_EQ(file.info().version_minor, 5u);
            ASSERT_NE(file.gaussians(), nullptr);
            expectSameGaussians(*file.gaussians(), gaussians);
            EXPECT_EQ(file.harmonics(4).size(), std::size_t{3} * pro_harmonic_count(degree));
            EXPECT_EQ(file.gaussian(4).opacity, 1.0f);
        }
    }
}

TEST(Gaussians, SplatsAreThoseOfAnOrdinaryFile) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    ASSERT_EQ(TinyGaussians(scene).write(scene, folder.file("a.pro")), PRO_OK);
    const ProFile file(folder.file("a.pro"));
    EXPECT_TRUE(std::ranges::equal(file.splats(), scene.splats));
    EXPECT_TRUE(std::ranges::equal(file.nodes(), scene.nodes));
    for (const std::uint32_t kind : {PRO_KIND_GAUS, PRO_KIND_GHRM, PRO_KIND_GNOD, PRO_KIND_GLST})
        EXPECT_EQ(loadAt(readBytes(folder.file("a.pro")),
                         recordOf(readBytes(folder.file("a.pro")), kind) + PRO_SEC_OFF_FLAGS),
                  0u)
            << "readers of 1.4 may ignore them";
}

TEST(Gaussians, FilesWithoutHaveNone) {
    const TemporaryFolder folder;
    tinyScene().write(folder.file("a.pro"));
    const ProFile file(folder.file("a.pro"));
    EXPECT_EQ(file.gaussians(), nullptr);
    const Bytes bytes = readBytes(folder.file("a.pro"));
    pro_file* opened = nullptr;
    ASSERT_EQ(pro_open_memory(bytes.data(), bytes.size(), 0, &opened, nullptr), PRO_OK);
    pro_gaussians gaussians;
    gaussians.words = reinterpret_cast<const std::uint32_t*>(&gaussians);
    EXPECT_EQ(pro_get_gaussians(opened, &gaussians), 0);
    EXPECT_EQ(gaussians.words, nullptr);
    EXPECT_EQ(gaussians.deviation_step, 0.0f);
    pro_close(opened);
}

TEST(Gaussians, AllMayBeTooFaintToBeListed) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyGaussians gaussians(scene);
    gaussians.nodes.assign(PRO_GROUP_SIZE * PRO_GAUSSIAN_NODE_WORDS, 0);
    gaussians.lists = {};
    ASSERT_EQ(gaussians.write(scene, folder.file("a.pro")), PRO_OK);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
    EXPECT_EQ(ProFile(folder.file("a.pro")).gaussians()->list_count, 0u);
}

TEST(Gaussians, HarmonicsOfDegreeZeroAreNotWritten) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyGaussians gaussians(scene, 0);
    gaussians.harmonics.assign(100, 1);
    ASSERT_EQ(gaussians.write(scene, folder.file("a.pro")), PRO_OK);
    EXPECT_EQ(ProFile(folder.file("a.pro")).gaussians()->harmonics, nullptr);
}

/// Exact parameters for splats 1 and 3; splat 4 and the others have only codes.
std::vector<pro_exact_gaussian> twoExact() {
    return {{1, {0.8f, 0, 0.6f, 0}, {0.011f, 0.012f, 1e-15f}, 0.004f}, {3, {0, 0, 0, -1}, {1, 2, 3}, 0.987654f}};
}

TEST(Gaussians, ExactParametersTakeThePlaceOfCodes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyGaussians gaussians(scene);
    ASSERT_EQ(gaussians.write(scene, folder.file("coded.pro")), PRO_OK);
    gaussians.exact = twoExact();
    ASSERT_EQ(gaussians.write(scene, folder.file("exact.pro")), PRO_OK);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("exact.pro"))).empty());
    const ProFile coded(folder.file("coded.pro")), exact(folder.file("exact.pro"), PRO_OPEN_TRACE);
    EXPECT_EQ(coded.gaussians()->exact, nullptr);
    ASSERT_EQ(exact.gaussians()->exact_count, 2u);
    for (const pro_exact_gaussian& written : gaussians.exact) {
        const pro_gaussian read = exact.gaussian(written.index), rounded = coded.gaussian(written.index);
        EXPECT_TRUE(std::ranges::equal(read.rotation, written.rotation));
        EXPECT_TRUE(std::ranges::equal(read.deviation, written.deviation));
        EXPECT_EQ(read.opacity, written.opacity);
        EXPECT_TRUE(std::ranges::equal(read.mean, rounded.mean));
        EXPECT_TRUE(std::ranges::equal(read.color, rounded.color));
    }
    for (const std::size_t other : {0, 2, 4}) {
        EXPECT_EQ(exact.gaussian(other).opacity, coded.gaussian(other).opacity);
        EXPECT_TRUE(std::ranges::equal(exact.gaussian(other).rotation, coded.gaussian(other).rotation));
    }
}

TEST(Gaussians, ReadersWithoutExactParametersSeeCodes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyGaussians gaussians(scene);
    gaussians.exact = twoExact();
    ASSERT_EQ(gaussians.write(scene, folder.file("a.pro")), PRO_OK);
    Bytes bytes = readBytes(folder.file("a.pro"));
    EXPECT_EQ(loadAt(bytes, recordOf(bytes, PRO_KIND_GEXA) + PRO_SEC_OFF_FLAGS), 0u);
    // a section kind that no reader knows
    storeAt(bytes, recordOf(bytes, PRO_KIND_GEXA) + PRO_SEC_OFF_KIND, 0x78787878u);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK);
}

TEST(Gaussians, WriterRefusesNulls) {
    Scene scene = tinyScene();
    const TinyGaussians gaussians(scene);
    const pro_view view = scene.view();
    const pro_content content{&scene.info, &view, nullptr, nullptr, nullptr, 0, nullptr};
    const auto refuses = [&](auto&& change) {
        pro_gaussians pointers = gaussians.view();
        change(pointers);
        return pro_write_gaussians("unused.pro", &content, &pointers, 1, nullptr) == PRO_BAD_ARGUMENT;
    };
    EXPECT_TRUE(refuses([](pro_gaussians& each) { each.words = nullptr; }));
    EXPECT_TRUE(refuses([](pro_gaussians& each) { each.nodes = nullptr; }));
    EXPECT_TRUE(refuses([](pro_gaussians& each) { each.lists = nullptr; }));
    EXPECT_TRUE(refuses([](pro_gaussians& each) { each.harmonics = nullptr; }));
    EXPECT_TRUE(refuses([](pro_gaussians& each) { each.exact = nullptr, each.exact_count = 1; }));
}

TEST(Gaussians, NullMeansNone) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    const pro_view view = scene.view();
    const pro_content content{&scene.info, &view, nullptr, nullptr, nullptr, 0, nullptr};
    ASSERT_EQ(pro_write_gaussians(folder.file("a.pro").c_str(), &content, nullptr, 1, nullptr), PRO_OK);
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(POINTRT_GOLDEN_DIR "/tiny_compact.pro"));
    EXPECT_EQ(pro_write_gaussians(folder.file("a.pro").c_str(), &content, nullptr, 0, nullptr), PRO_CANNOT_WRITE);
}

const std::string kTinyV15 = POINTRT_GOLDEN_DIR "/tiny_v1_5.pro";

TEST(Golden, Version15Reads) {
    const ProFile file(kTinyV15);
    EXPECT_EQ(file.info().version_minor, 5u);
    ASSERT_NE(file.gaussians(), nullptr);
    const pro_gaussians& gaussians = *file.gaussians();
    EXPECT_EQ(gaussians.degree, 1u);
    EXPECT_EQ(gaussians.deviation_low, -12.0f);
    EXPECT_EQ(gaussians.harmonic_max[0], 0.5f);
    EXPECT_EQ(gaussians.node_count, 24u);
    EXPECT_EQ(gaussians.nodes[9 * PRO_GAUSSIAN_NODE_WORDS], 2u);
    EXPECT_EQ(gaussians.list_count, 5u);
    EXPECT_EQ(gaussians.lists[0], 4u);
    EXPECT_EQ(file.harmonics(0)[1], -116);
    const pro_gaussian gaussian = file.gaussian(1);
    EXPECT_NEAR(gaussian.mean[0], 0.4, 3e-7);
    EXPECT_FLOAT_EQ(gaussian.deviation[2], std::exp2(-12 + 2048 * 10.0f / 4096)) << "code 2048 of 2^-7";
    EXPECT_NEAR(gaussian.rotation[1], 2 / std::sqrt(5), 2e-4);
    EXPECT_NEAR(gaussian.opacity, 0.4, 5e-4);
    EXPECT_EQ(gaussian.color[1], 0.375f);
}

TEST(Golden, Version15VerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyV15)).empty()); }

/// A seed for the fuzzers: pointrt-bake of 40 Gaussians at random, opacities from 0.004 to 0.998.
TEST(Golden, ExactGaussiansRead) {
    const std::string path = POINTRT_GOLDEN_DIR "/exact_gaussians.pro";
    EXPECT_TRUE(findingsOf(readBytes(path)).empty());
    const ProFile file(path);
    ASSERT_NE(file.gaussians(), nullptr);
    EXPECT_GT(file.gaussians()->exact_count, 0u);
    EXPECT_LT(file.gaussians()->exact_count, 40u);
}

TEST(Golden, SameGaussiansAreWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    ASSERT_EQ(TinyGaussians(scene).write(scene, folder.file("a.pro")), PRO_OK);
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(kTinyV15));
}

} // namespace
