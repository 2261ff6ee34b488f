// SPDX-License-Identifier: Apache-2.0
// Files of Gaussians and of pictures, and the measure of differences.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tests/gaussians/gaussian_ply.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/gaussians/picture_difference.h"
#include "tests/gaussians/srgb.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

class GaussianFiles : public testing::Test {
protected:
    TemporaryFolder folder;
    std::string path = folder.file("gaussians.ply");

    /// Writes a PLY with one Gaussian.
    void writeOne(const std::vector<std::string>& names, const std::vector<float>& values,
                  const std::string& format = "binary_little_endian", const std::string& type = "float") {
        std::ofstream file(path, std::ios::binary);
        file << "ply\nformat " << format << " 1.0\ncomment made\nelement vertex 1\n";
        for (const std::string& name : names) file << "property " << type << ' ' << name << '\n';
        file << "end_header\n";
        file.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(float)));
    }
};

std::vector<std::string> trainedNames() {
    std::vector<std::string> names{"rot_0", "rot_1", "rot_2", "rot_3", "opacity", "scale_0", "scale_1", "scale_2"};
    for (int k = 0; k < 9; ++k) names.push_back("f_rest_" + std::to_string(k));
    for (const char* name : {"f_dc_0", "f_dc_1", "f_dc_2", "nx", "x", "y", "z"}) names.emplace_back(name);
    return names;
}

const std::vector<float> kTrained{1, 2, 3, 4, 0, -1, -2, -3, 10, 11, 12, 20, 21, 22, 30, 31, 32, 1, 0, -1, 99, 5, 6, 7};

TEST_F(GaussianFiles, PropertiesAreReadByNameAndDecoded) {
    writeOne(trainedNames(), kTrained);
    const std::vector<OracleGaussian> gaussians = readGaussianPly(path);
    ASSERT_EQ(gaussians.size(), 1u);
    const OracleGaussian& one = gaussians[0];
    EXPECT_EQ(one.mean, (Double3{5, 6, 7}));
    EXPECT_EQ(one.deviation, (Double3{std::exp(-1), std::exp(-2), std::exp(-3)}));
    EXPECT_EQ(one.rotation, (std::array<double, 4>{1, 2, 3, 4}));
    EXPECT_EQ(one.opacity, 0.5);
    const double constant = 0.5 / std::sqrt(3.14159265358979323846);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(one.color[c], 0.5 + constant * (1.0 - double(c)), 1e-15);
    ASSERT_EQ(one.harmonics.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) // red first
        EXPECT_EQ(one.harmonics[k], (Double3{10.0 + double(k), 20.0 + double(k), 30.0 + double(k)}));
    EXPECT_EQ(one.degree(), 1);
}

TEST_F(GaussianFiles, OtherPlyFilesAreRefused) {
    writeOne(trainedNames(), kTrained, "ascii");
    EXPECT_THROW(readGaussianPly(path), std::runtime_error);
    writeOne(trainedNames(), kTrained, "binary_little_endian", "double");
    EXPECT_THROW(readGaussianPly(path), std::runtime_error);
    writeOne(trainedNames(), {1, 2, 3});
    EXPECT_THROW(readGaussianPly(path), std::runtime_error) << "ends too early";
    writeOne({"x", "y", "z"}, {1, 2, 3});
    EXPECT_THROW(readGaussianPly(path), std::runtime_error) << "points";
    EXPECT_THROW(readGaussianPly(folder.file("missing.ply")), std::runtime_error);
}

TEST_F(GaussianFiles, WrittenGaussiansAreReadBack) {
    const std::vector<OracleGaussian> written = makeGaussians("mixed", 80);
    writeGaussianPly(path, written);
    const std::vector<OracleGaussian> read = readGaussianPly(path);
    ASSERT_EQ(read.size(), written.size());
    constexpr double kFloat = 1e-6;
    for (std::size_t k = 0; k < read.size(); ++k) {
        EXPECT_NEAR(read[k].opacity, written[k].opacity, kFloat);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(read[k].mean[i], written[k].mean[i], 1e-5); // of up to 100
            EXPECT_NEAR(read[k].deviation[i] / written[k].deviation[i], 1, kFloat);
            EXPECT_NEAR(read[k].color[i], written[k].color[i], kFloat);
            EXPECT_NEAR(read[k].harmonics[14][i], written[k].harmonics[14][i], kFloat);
        }
        EXPECT_NEAR(read[k].rotation[3], written[k].rotation[3], kFloat);
    }
}

TEST_F(GaussianFiles, GaussiansOfOpacityOneStayOpaque) {
    OracleGaussian gaussian;
    gaussian.opacity = 1;
    writeGaussianPly(path, {gaussian});
    EXPECT_EQ(static_cast<float>(readGaussianPly(path)[0].opacity), 1.0f);
}

TEST(NastyGaussians, AreAsTheirKindsSay) {
    for (const std::string& kind : gaussianKinds()) {
        const std::vector<OracleGaussian> gaussians = makeGaussians(kind, 100);
        EXPECT_EQ(gaussians.size(), 100u) << kind;
        EXPECT_NO_THROW(oracleScene(gaussians)) << kind;
    }
    const std::vector<OracleGaussian> twins = makeGaussians("duplicates", 8), needles = makeGaussians("needles", 1);
    EXPECT_EQ(twins[4].mean, twins[7].mean);
    EXPECT_NE(twins[4].color, twins[7].color);
    EXPECT_NE(twins[3].mean, twins[4].mean);
    EXPECT_NEAR(needles[0].deviation[0] / needles[0].deviation[2], 1000, 1e-9);
    for (const OracleGaussian& each : makeGaussians("borders", 100))
        for (const double coordinate : each.mean) EXPECT_EQ(coordinate, std::round(coordinate * 16) / 16);
    EXPECT_THROW(makeGaussians("nice", 1), std::invalid_argument);
}

TEST(NastyGaussians, AreTheSameForTheSameSeed) {
    EXPECT_EQ(makeGaussians("random", 3, 5)[2].mean, makeGaussians("random", 3, 5)[2].mean);
    EXPECT_NE(makeGaussians("random", 3, 5)[2].mean, makeGaussians("random", 3, 6)[2].mean);
}

TEST(NastyGaussians, ThousandsOfLayersCountAlongOneRay) {
    const OracleScene scene = oracleScene(makeGaussians("layers", 4000));
    const OracleRay ray{{0, 0, 4}, {0, 0, -1}};
    EXPECT_GT(composite(scene, ray, hitsAlong(scene, ray)).counted, 1500u);
}

TEST(FloatPictures, ArePreservedByPfmFiles) {
    const TemporaryFolder folder;
    for (const std::uint32_t channels : {1u, 3u}) {
        FloatPicture picture{4, 3, channels, {}};
        for (std::uint32_t i = 0; i < 12 * channels; ++i) picture.values.push_back(0.1f * static_cast<float>(i));
        writePfm(folder.file("a.pfm"), picture);
        const FloatPicture read = readPfm(folder.file("a.pfm"));
        EXPECT_EQ(read.width, 4u);
        EXPECT_EQ(read.channels, channels);
        EXPECT_EQ(read.values, picture.values);
    }
    EXPECT_THROW(readPfm(folder.file("missing.pfm")), std::runtime_error);
}

FloatPicture grey(float value) { return {10, 10, 3, std::vector<float>(300, value)}; }

TEST(PictureDifferences, EqualPicturesAreInfinitelyAlike) {
    const PictureDifference difference = differenceOf(grey(0.3f), grey(0.3f));
    EXPECT_EQ(difference.psnr_db, INFINITY);
    EXPECT_EQ(difference.max_difference, 0);
    EXPECT_EQ(difference.share_off, 0);
}

TEST(PictureDifferences, AnOffsetOfATenthIsTwentyDecibels) {
    const PictureDifference difference = differenceOf(grey(0.3f), grey(0.4f));
    EXPECT_NEAR(difference.psnr_db, 20, 1e-5);
    EXPECT_NEAR(difference.max_difference, 0.1, 1e-7);
    EXPECT_EQ(difference.share_off, 1);
}

TEST(PictureDifferences, PixelsAreOffByMoreThanAStepOfEightBits) {
    FloatPicture other = grey(0.3f);
    other.values[0] += 1.0f / 255;
    other.values[3] += 1.5f / 255;
    other.values[5] -= 1.5f / 255; // of the same pixel
    EXPECT_NEAR(differenceOf(grey(0.3f), other).share_off, 0.01, 1e-12);
    other.values[6] = NAN;
    EXPECT_EQ(differenceOf(grey(0.3f), other).max_difference, 1);
    EXPECT_THROW(differenceOf(grey(0), {5, 20, 3, std::vector<float>(300)}), std::runtime_error);
}

TEST(Srgb, DecodingUndoesEncoding) {
    for (const double value : {-0.01, 0.0, 0.001, 0.04, 0.5, 1.0, 1.7})
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(value)), value, 1e-7);
    EXPECT_NEAR(linearFromSrgb(0.5), 0.21404, 1e-5);
}

} // namespace
} // namespace pointrt::test
