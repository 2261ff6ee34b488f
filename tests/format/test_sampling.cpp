// SPDX-License-Identifier: Apache-2.0
// Noise and filled splats are read as written, and contradictions are found.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "expect_found.h"
#include "tests/support/temporary_folder.h"
#include "tiny_attributes.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

const std::string kTinyScan = POINTRT_GOLDEN_DIR "/tiny_v1_4_scan.pro";

/// Noise of the tiny scene's five splats. The third one fills a gap: its order is 7.
struct Sampled {
    std::array<std::uint8_t, 5> noise{10, 0, 255, 32, 1};
    pro_sampling sampling{6, 1, 0, noise.data()};
    TinyScan scan;
    Scene scene = tinyScene();

    Sampled() { scan.sampling = &sampling; }
    Sampled(const Sampled&) = delete;
};

TEST(Sampling, GoldenReads) {
    const ProFile file(kTinyScan);
    EXPECT_EQ(file.sampling().input_count, 6u);
    EXPECT_EQ(file.sampling().filled_count, 1u);
    ASSERT_EQ(file.noise().size(), 5u);
    EXPECT_EQ(file.noise()[2], 255);
    // radii 0.25, 0.1, 0.05, 0.2 and 0.15 with an edge of 2: the median of 0.156, 0, 0.797, 0.4 and 0.009
    EXPECT_FLOAT_EQ(file.sampling().noise_median, 10.0f / 32 * 0.25f * 2);
    EXPECT_EQ(file.world().metres_per_unit, 0.3048) << "all else is present as well";
    EXPECT_EQ(file.attributes().size(), 5u);
}

TEST(Sampling, GoldenVerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyScan)).empty()); }

TEST(Sampling, SameContentIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    Sampled sampled;
    ASSERT_EQ(sampled.scan.write(sampled.scene, folder.file("a.pro")), PRO_OK);
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(kTinyScan));
}

TEST(Sampling, CleanScansHaveNoSampling) {
    const TemporaryFolder folder;
    Sampled sampled;
    sampled.sampling = {6, 0, 0.5f, nullptr};
    sampled.scan.indexed = false;
    ASSERT_EQ(sampled.scan.write(sampled.scene, folder.file("a.pro")), PRO_OK);
    const ProFile file(folder.file("a.pro"));
    EXPECT_EQ(file.sampling().input_count, 0u);
}

TEST(Sampling, NoiseAndFilledSplatsAreIndependent) {
    const TemporaryFolder folder;
    Sampled sampled;
    sampled.sampling = {6, 1, 0, nullptr};
    sampled.scan.indexed = false;
    ASSERT_EQ(sampled.scan.write(sampled.scene, folder.file("filled.pro")), PRO_OK);
    const ProFile filled(folder.file("filled.pro"));
    EXPECT_EQ(filled.sampling().noise, nullptr);
    EXPECT_EQ(filled.sampling().noise_median, 0.0f);
    sampled.sampling = {0, 0, 0, sampled.noise.data()};
    ASSERT_EQ(sampled.scan.write(sampled.scene, folder.file("noisy.pro")), PRO_OK);
    EXPECT_EQ(ProFile(folder.file("noisy.pro")).noise()[3], 32);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("filled.pro"))).empty());
    EXPECT_TRUE(findingsOf(readBytes(folder.file("noisy.pro"))).empty());
}

TEST(Sampling, TracersReadItToo) {
    const ProFile file(kTinyScan, PRO_OPEN_TRACE);
    EXPECT_TRUE(file.order().empty());
    ASSERT_EQ(file.noise().size(), 5u);
    EXPECT_EQ(file.noise()[0], 10);
}

TEST(Sampling, WriterRefusesContradictoryCounts) {
    const TemporaryFolder folder;
    Sampled sampled;
    pro_message message{};
    for (const pro_sampling& wrong : {pro_sampling{6, 6, 0, nullptr}, pro_sampling{0, 1, 0, nullptr}}) {
        sampled.sampling = wrong;
        EXPECT_EQ(sampled.scan.write(sampled.scene, folder.file("a.pro"), &message), PRO_BAD_ARGUMENT);
        EXPECT_EQ(message.finding, 1018u) << message.text;
    }
}

const Bytes& tinyScan() {
    static const Bytes bytes = readBytes(kTinyScan);
    return bytes;
}

TEST(HostileSampling, HeaderAndSection) {
    expectFound(tinyScan(), PRO_OFF_FILLED_COUNT, 6u, 1018);
    expectFound(tinyScan(), PRO_OFF_INPUT_COUNT, 0u, 1018);
    expectFound(tinyScan(), PRO_OFF_INPUT_COUNT, 8u, 9401, true);
    expectFound(tinyScan(), PRO_OFF_FILLED_COUNT, 2u, 9401, true);
    expectFound(tinyScan(), PRO_OFF_NOISE, std::numeric_limits<float>::quiet_NaN(), 1019);
    expectFound(tinyScan(), PRO_OFF_NOISE, -1.0f, 1019);
    expectFound(tinyScan(), PRO_OFF_NOISE, 1.0f, 9402, true);
    expectFound(tinyScan(), sectionOf(tinyScan(), PRO_KIND_NOIS), std::uint8_t{11}, 9402, true);
    expectFound(tinyScan(), recordOf(tinyScan(), PRO_KIND_NOIS), 0x58585858u, 9402, true);
    expectFound(tinyScan(), PRO_FIELDS_END, 1u, 1006);
    const std::size_t record = recordOf(tinyScan(), PRO_KIND_NOIS);
    expectFound(tinyScan(), record + PRO_SEC_OFF_LENGTH, std::uint64_t{6}, 2005);
    Bytes longer = tinyScan();
    storeAt(longer, record + PRO_SEC_OFF_LENGTH, std::uint64_t{6});
    storeAt(longer, record + PRO_SEC_OFF_COUNT, std::uint64_t{6});
    fixChecksums(longer);
    EXPECT_EQ(openCopy(longer).message.finding, 2009u);
}

TEST(HostileSampling, EveryWordOfTheHeaderAndTable) {
    const auto last = recordOf(tinyScan(), PRO_KIND_SENS) + PRO_SECTION_BYTES * 8;
    for (std::size_t offset = 0; offset < last; offset += 4)
        for (const std::uint32_t value : {0u, 1u, 2u, 3u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
            Bytes bytes = tinyScan();
            storeAt(bytes, offset, value);
            fixHeaderChecksum(bytes);
            openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS); // for AddressSanitizer
            openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | PRO_OPEN_TRACE);
        }
}

std::string printed(const TemporaryFolder& folder, const std::string& arguments) {
    const std::string out = folder.file("out.txt");
    const int status = std::system((std::string(POINTRT_INFO) + " " + arguments + " >" + out).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << arguments;
    const Bytes bytes = readBytes(out);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(SamplingInfo, PrintsNoiseAndFilledSplats) {
    const TemporaryFolder folder;
    const std::string text = printed(folder, kTinyScan);
    EXPECT_NE(text.find("0 to 7.97 radii"), std::string::npos) << text;
    EXPECT_NE(text.find("median 0.312 radii, 0.1562 input units"), std::string::npos) << text;
    EXPECT_NE(text.find("1 splats fill gaps between 6 points"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(printed(folder, kTinyScan + " --json"));
    EXPECT_EQ(json["filled"], 1);
    EXPECT_EQ(json["input_points"], 6);
    EXPECT_EQ(json["noise"]["high_radii"], 255.0 / 32);
    EXPECT_FLOAT_EQ(json["noise"]["median"].get<float>(), 0.15625f);
    const auto clean = nlohmann::json::parse(printed(folder, POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro --json"));
    EXPECT_TRUE(clean["noise"].is_null());
    EXPECT_EQ(clean["filled"], 0);
}

TEST(SamplingInfo, ExportsOmitFilledSplats) {
    const TemporaryFolder folder;
    printed(folder, kTinyScan + " --export " + folder.file("a.ply"));
    const Bytes ply = readBytes(folder.file("a.ply"));
    const std::string text(reinterpret_cast<const char*>(ply.data()), ply.size());
    EXPECT_NE(text.find("element vertex 4\n"), std::string::npos);
    printed(folder, kTinyScan + " --export " + folder.file("a.las"));
    EXPECT_EQ(loadAt<std::uint32_t>(readBytes(folder.file("a.las")), 247), 4u) << "points of LAS 1.4";
}

} // namespace
