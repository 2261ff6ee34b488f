// SPDX-License-Identifier: Apache-2.0
// pointrt-info prints Gaussians, and exports them as files of 3D Gaussian splatting.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_gaussians.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

struct GaussianInfo : testing::Test {
    TemporaryFolder folder;
    std::string pro = folder.file("a.pro"), ply = folder.file("a.ply");

    void SetUp() override {
        Scene scene = tinyScene();
        write(scene, TinyGaussians(scene));
    }

    /// Writes the Gaussians in the input order 3 0 4 1 2.
    void write(Scene& scene, const TinyGaussians& gaussians) {
        scene.order = {3, 0, 4, 1, 2};
        ASSERT_EQ(gaussians.write(scene, pro), PRO_OK);
    }

    std::string run(const std::string& arguments) {
        const std::string out = folder.file("out.txt");
        const int status = std::system((std::string(POINTRT_INFO) + " " + arguments + " >" + out).c_str());
        EXPECT_EQ(WEXITSTATUS(status), 0) << arguments;
        return textOfFile(out);
    }

    static std::string textOfFile(const std::string& path) {
        const Bytes bytes = readBytes(path);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    /// The properties of the vertices of a PLY, after a header that must be exactly this.
    static std::vector<float> propertiesOf(const std::string& file, std::size_t rest) {
        std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 5\n";
        const auto add = [&](const std::string& name) { header += "property float " + name + "\n"; };
        for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"}) add(name);
        for (std::size_t k = 0; k < rest; ++k) add("f_rest_" + std::to_string(k));
        for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
            add(name);
        header += "end_header\n";
        EXPECT_EQ(file.substr(0, header.size()), header);
        std::vector<float> values((file.size() - header.size()) / sizeof(float));
        std::memcpy(values.data(), file.data() + header.size(), values.size() * sizeof(float));
        return values;
    }
};

TEST_F(GaussianInfo, Prints) {
    const std::string text = run(pro);
    EXPECT_NE(text.find("version 1.5"), std::string::npos);
    // 24 nodes of 8 bytes and 5 list entries of 4 for 5 Gaussians
    EXPECT_NE(text.find("5, 67.4 bytes each (GAUS 16.0, GHRM 9.0, GNOD 38.4, GLST 4.0)"), std::string::npos) << text;
    EXPECT_NE(text.find("degree 1"), std::string::npos);
    EXPECT_NE(text.find("24 nodes, 4.80 for each Gaussian; 5 list entries, 1.00 for each"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(run(pro + " --json"))["gaussians"];
    EXPECT_EQ(json["count"], 5);
    EXPECT_EQ(json["degree"], 1);
    EXPECT_EQ(json["bytes"], (nlohmann::json{{"GAUS", 80}, {"GHRM", 45}, {"GNOD", 192}, {"GLST", 20}}));
    EXPECT_DOUBLE_EQ(json["bytes_per_gaussian"], 67.4);
    EXPECT_EQ(json["nodes"], 24);
    EXPECT_DOUBLE_EQ(json["list_entries_per_gaussian"], 1);
    tinyScene().write(pro);
    EXPECT_FALSE(nlohmann::json::parse(run(pro + " --json")).contains("gaussians"));
}

TEST_F(GaussianInfo, ExportsGaussiansInInputOrder) {
    run(pro + " --export " + ply);
    constexpr std::size_t kRow = 26; // 9, 9 harmonics, 8
    const std::vector<float> values = propertiesOf(textOfFile(ply), 9);
    ASSERT_EQ(values.size(), 5 * kRow);
    const ProFile file(pro);
    const std::size_t splat_of_row[] = {1, 3, 4, 0, 2}; // order is 3 0 4 1 2
    for (std::size_t row = 0; row < 5; ++row) {
        const float* value = values.data() + row * kRow;
        const pro_gaussian gaussian = file.gaussian(splat_of_row[row]);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_FLOAT_EQ(value[k], static_cast<float>(10.0 * static_cast<double>(k + 1) + 2 * gaussian.mean[k]));
            EXPECT_EQ(value[3 + k], 0.0f);
            EXPECT_NEAR(0.5 + 0.28209479177387814 * double{value[6 + k]}, gaussian.color[k], 1e-6);
            EXPECT_NEAR(std::exp(value[19 + k]), 2 * gaussian.deviation[k], 1e-5 * gaussian.deviation[k]);
            for (std::size_t h = 0; h < 3; ++h) // ordered by colour here, and by coefficient there
                EXPECT_FLOAT_EQ(value[9 + 3 * k + h],
                                static_cast<float>(file.harmonics(splat_of_row[row])[3 * h + k]) / 127 * 0.5f);
        }
        EXPECT_NEAR(1 / (1 + std::exp(-value[18])), gaussian.opacity, 0.26 / 1023) << "1 becomes a bit less";
        for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(value[22 + k], gaussian.rotation[k]);
    }
}

TEST_F(GaussianInfo, LogitsOfTheEndsAreFiniteAndCodedAgainAsTheEnds) {
    Scene scene = tinyScene();
    TinyGaussians gaussians(scene, 0);
    // the opacity of splat 0; that of splat 4 is 1
    gaussians.words[1] &= ~(PRO_OPACITY_LOW_MASK << PRO_OPACITY_LOW_SHIFT);
    gaussians.words[2] &= (1u << PRO_OPACITY_HIGH_SHIFT) - 1;
    write(scene, gaussians);
    const std::vector<float> values = propertiesOf(run(pro + " --export -"), 0);
    constexpr std::size_t kRow = 17;
    ASSERT_EQ(values.size(), 5 * kRow);
    const auto codeOf = [](float logit) { return std::lround(1023 / (1 + std::exp(-double{logit}))); };
    EXPECT_TRUE(std::isfinite(values[3 * kRow + 9]));
    EXPECT_EQ(codeOf(values[3 * kRow + 9]), 0);
    EXPECT_TRUE(std::isfinite(values[2 * kRow + 9]));
    EXPECT_EQ(codeOf(values[2 * kRow + 9]), 1023);
}

/// The bytes of a gzip file.
std::vector<std::uint8_t> unzipped(const std::string& path) {
    std::vector<std::uint8_t> bytes(1 << 16);
    const gzFile file = gzopen(path.c_str(), "rb");
    bytes.resize(static_cast<std::size_t>(gzread(file, bytes.data(), static_cast<unsigned>(bytes.size()))));
    gzclose(file);
    return bytes;
}

std::uint32_t wordAt(const std::vector<std::uint8_t>& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

/// Quaternion w x y z of four bytes: the largest of x y z w is left out.
std::array<double, 4> unpackedRotation(std::uint32_t word) {
    std::array<double, 4> xyzw{};
    const std::size_t largest = word >> 30;
    double squares = 0;
    for (std::size_t i = 4; i-- > 0;) {
        if (i == largest) continue;
        xyzw[i] = (word & 512 ? -1 : 1) * std::sqrt(0.5) * (word & 511) / 511;
        squares += xyzw[i] * xyzw[i];
        word >>= 10;
    }
    xyzw[largest] = std::sqrt(1 - squares);
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

TEST_F(GaussianInfo, ExportsSpz) {
    const std::string spz = folder.file("a.spz");
    run(pro + " --export " + spz);
    const std::vector<std::uint8_t> bytes = unzipped(spz);
    ASSERT_EQ(bytes.size(), 16u + 5 * (9 + 1 + 3 + 3 + 4 + 9));
    EXPECT_EQ(wordAt(bytes, 4), 3u) << "version";
    EXPECT_EQ(wordAt(bytes, 8), 5u);
    EXPECT_EQ(bytes[12], 1) << "degree";
    const int bits = bytes[13];
    const ProFile file(pro);
    const std::size_t splat_of_row[] = {1, 3, 4, 0, 2}; // order is 3 0 4 1 2
    for (std::size_t row = 0; row < 5; ++row) {
        const pro_gaussian gaussian = file.gaussian(splat_of_row[row]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = 16 + 9 * row + 3 * k;
            const auto word = static_cast<std::int32_t>(wordAt(bytes, at) << 8);
            const double position = std::ldexp(word >> 8, -bits);
            EXPECT_NEAR(position, 10.0 * static_cast<double>(k + 1) + 2 * gaussian.mean[k], std::ldexp(1.0, -bits));
            const double color = (bytes[66 + 3 * row + k] / 255.0 - 0.5) / 0.15 * 0.28209479177387814 + 0.5;
            EXPECT_NEAR(color, std::clamp(double{gaussian.color[k]}, -0.44, 1.44), 0.004);
            EXPECT_NEAR(bytes[81 + 3 * row + k] / 16.0 - 10, std::log(2 * gaussian.deviation[k]), 1 / 32.0 + 1e-6);
            for (std::size_t h = 0; h < 3; ++h)
                EXPECT_NEAR((bytes[116 + 9 * row + 3 * h + k] - 128) / 128.0,
                            static_cast<double>(file.harmonics(splat_of_row[row])[3 * h + k]) / 127 * 0.5, 0.0041);
        }
        EXPECT_NEAR(bytes[61 + row] / 255.0, gaussian.opacity, 0.5 / 255 + 1e-6);
        const auto rotation = unpackedRotation(wordAt(bytes, 96 + 4 * row));
        double alike = 0;
        for (std::size_t k = 0; k < 4; ++k) alike += rotation[k] * gaussian.rotation[k];
        EXPECT_GT(std::abs(alike), 0.99999) << "a quaternion and its negative turn alike";
    }
}

TEST_F(GaussianInfo, ExportsDiscsAsLas) {
    run(pro + " --export " + folder.file("a.las"));
    EXPECT_EQ(loadAt<std::uint32_t>(readBytes(folder.file("a.las")), 107), 5u) << "points";
}

TEST_F(GaussianInfo, VerifyNamesFindings) {
    Bytes bytes = readBytes(pro);
    storeAt(bytes, sectionOf(bytes, PRO_KIND_GLST), 9u);
    fixChecksums(bytes);
    writeBytes(pro, bytes);
    const std::string out = folder.file("out.txt");
    const int status = std::system((std::string(POINTRT_INFO) + " " + pro + " --verify >" + out + " 2>&1").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_NE(textOfFile(out).find("finding 9509: listed Gaussian 0"), std::string::npos);
}

} // namespace
