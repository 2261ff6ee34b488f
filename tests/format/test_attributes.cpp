// SPDX-License-Identifier: Apache-2.0
// Attributes, sensors, up and units are read as written, and contradictions are found.
#include <gtest/gtest.h>

#include <cstring>

#include "expect_found.h"
#include "tests/support/temporary_folder.h"
#include "tiny_attributes.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

const std::string kCompactScan = POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro"; // without an index

TEST(Attributes, GoldenReads) {
    const ProFile file(kCompactScan);
    EXPECT_EQ(file.world().up[2], 1.0f);
    EXPECT_EQ(file.world().metres_per_unit, 0.3048);
    ASSERT_EQ(file.world().sensor_count, 2u);
    EXPECT_EQ(file.world().sensors[2], 1e6);
    EXPECT_EQ(file.world().sensors[7], 0.0);
    ASSERT_EQ(file.attributes().size(), 5u);
    const pro_attribute* const intensity = file.attribute("intensity");
    ASSERT_NE(intensity, nullptr);
    EXPECT_EQ(intensity->type, std::uint32_t{PRO_TYPE_U16});
    EXPECT_EQ(intensity->low, 0.0);
    EXPECT_EQ(intensity->high, 65535.0);
    EXPECT_EQ(pro_attribute_value(intensity, 3), 300.0);
    EXPECT_EQ(pro_attribute_value(file.attribute("rgb16"), 14), 65535.0);
    EXPECT_EQ(file.attribute("gps_time")->low, -4.5) << "NaN does not count";
    EXPECT_EQ(file.attribute("gps_time")->high, 1e9 + 0.25);
    EXPECT_EQ(file.attributes()[4].low, -0x1p63);
    EXPECT_EQ(file.attribute("nir"), nullptr);
    EXPECT_EQ(file.index(), nullptr);
}

TEST(Attributes, GoldenVerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kCompactScan)).empty()); }

TEST(Attributes, SameContentIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyScan scan;
    scan.indexed = false;
    ASSERT_EQ(scan.write(scene, folder.file("a.pro")), PRO_OK);
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(kCompactScan));
}

TEST(Attributes, WithoutThemTheBytesAreThoseOfAFileThatNeverHadThem) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyScan scan;
    scan.world = {};
    scan.attributes.clear();
    ASSERT_EQ(scan.write(scene, folder.file("a.pro")), PRO_OK);
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(POINTRT_GOLDEN_DIR "/tiny_v1_4.pro"));
}

TEST(Attributes, TracersReadThemToo) {
    const ProFile file(kCompactScan, PRO_OPEN_TRACE);
    EXPECT_EQ(file.world().up[2], 1.0f);
    ASSERT_NE(file.attribute("classification"), nullptr);
    EXPECT_EQ(pro_attribute_value(file.attribute("classification"), 2), 6.0);
}

struct AttributeWriter : testing::Test {
    TemporaryFolder folder;
    Scene scene = tinyScene();
    TinyScan scan;
    pro_message message{};

    std::uint32_t refusedWith() {
        EXPECT_EQ(scan.write(scene, folder.file("a.pro"), &message), PRO_BAD_ARGUMENT) << message.text;
        EXPECT_FALSE(std::filesystem::exists(folder.file("a.pro")));
        return message.finding;
    }
};

TEST_F(AttributeWriter, RefusesNames) {
    std::memset(scan.attributes[1].name, 0, sizeof scan.attributes[1].name);
    EXPECT_EQ(refusedWith(), 9201u);
    std::strcpy(scan.attributes[1].name, "intensity");
    EXPECT_EQ(refusedWith(), 9201u);
    std::strcpy(scan.attributes[1].name, "a\nb");
    EXPECT_EQ(refusedWith(), 9201u);
    std::strcpy(scan.attributes[1].name, "\xC3");
    EXPECT_EQ(refusedWith(), 9201u);
}

TEST_F(AttributeWriter, RefusesTypes) {
    scan.attributes[0].type = 11;
    EXPECT_EQ(refusedWith(), 9202u);
    scan.attributes[0].type = PRO_TYPE_U16;
    scan.attributes[0].components = 5;
    EXPECT_EQ(refusedWith(), 9202u);
}

TEST_F(AttributeWriter, RefusesWorlds) {
    scan.world.up[2] = 2;
    EXPECT_EQ(refusedWith(), 1016u);
    scan.world.up[2] = -1;
    scan.world.metres_per_unit = -1;
    EXPECT_EQ(refusedWith(), 1017u);
    scan.world.metres_per_unit = 0;
    scan.sensors[3] = 0.5;
    EXPECT_EQ(refusedWith(), 9301u);
}

TEST_F(AttributeWriter, RefusesTooMany) {
    while (scan.attributes.size() <= PRO_ATTRIBUTE_MAX) {
        const std::string name = std::to_string(scan.attributes.size());
        scan.add(name.c_str(), PRO_TYPE_U8, 1, scan.classification.data());
    }
    EXPECT_EQ(refusedWith(), 0u);
    scan.attributes.resize(PRO_ATTRIBUTE_MAX);
    EXPECT_EQ(scan.write(scene, folder.file("a.pro"), &message), PRO_OK) << message.text;
}

const Bytes& golden() {
    static const Bytes bytes = readBytes(kCompactScan);
    return bytes;
}

TEST(HostileAttributes, RecordsAndHeader) {
    const std::size_t records = sectionOf(golden(), PRO_KIND_ATTD);
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    expectFound(golden(), PRO_OFF_UP, 0.5f, 1016);
    expectFound(golden(), PRO_OFF_METRES, kNan, 1017);
    expectFound(golden(), records + PRO_ATTR_OFF_NAME, std::uint8_t{0}, 9201);
    expectFound(golden(), records + PRO_ATTR_OFF_NAME + 31, std::uint8_t{'x'}, 9201);
    expectFound(golden(), records + PRO_ATTR_OFF_TYPE, 0u, 9202);
    expectFound(golden(), records + PRO_ATTR_OFF_TYPE, 0xFFFFFFFFu, 9202);
    expectFound(golden(), records + PRO_ATTR_OFF_TYPE, std::uint32_t{PRO_TYPE_U8}, 2014);
    expectFound(golden(), records + PRO_ATTR_OFF_TYPE, std::uint32_t{PRO_TYPE_I16}, 9205, true);
    expectFound(golden(), records + PRO_ATTR_OFF_COMPONENTS, 2u, 2014);
    expectFound(golden(), records + PRO_ATTR_OFF_COMPONENTS, 0xFFFFFFFFu, 9202);
    expectFound(golden(), records + PRO_ATTR_OFF_RESERVED, 1u, 9203);
    expectFound(golden(), records + PRO_ATTR_OFF_LOW, kNan, 9204);
    expectFound(golden(), records + PRO_ATTR_OFF_LOW, 1e9, 9204);
    expectFound(golden(), records + PRO_ATTR_OFF_LOW, 1.0, 9205, true);
    expectFound(golden(), sectionOf(golden(), PRO_KIND_SENS) + 24, 0.0, 9301);
    expectFound(golden(), sectionOf(golden(), PRO_KIND_SENS), kNan, 9301);
}

TEST(HostileAttributes, MissingSections) {
    constexpr std::uint32_t kUnknown = 0x58585858u;
    expectFound(golden(), recordOf(golden(), PRO_KIND_ATTD), kUnknown, 2014);
    expectFound(golden(), recordOf(golden(), PRO_KIND_ATTR), kUnknown, 2014);
    Bytes none = golden(); // a file without both is valid
    storeAt(none, recordOf(none, PRO_KIND_ATTD), kUnknown);
    for (int i = 0; i < 5; ++i) storeAt(none, recordOf(none, PRO_KIND_ATTR), kUnknown);
    fixChecksums(none);
    EXPECT_EQ(openCopy(none).result, PRO_OK);
}

TEST(HostileAttributes, EveryWordOfTheHeaderTableAndRecords) {
    const auto last = recordOf(golden(), PRO_KIND_SENS) + PRO_SECTION_BYTES * 7;
    const std::size_t records = sectionOf(golden(), PRO_KIND_ATTD);
    const auto tryAll = [](std::size_t begin, std::size_t end) {
        for (std::size_t offset = begin; offset < end; offset += 4)
            for (const std::uint32_t value : {0u, 1u, 2u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
                Bytes bytes = golden();
                storeAt(bytes, offset, value);
                fixHeaderChecksum(bytes);
                openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS); // for AddressSanitizer
            }
    };
    tryAll(0, last);
    tryAll(records, records + 5 * PRO_ATTRIBUTE_BYTES);
}

TEST(HostileAttributes, EveryPrefixIsRefused) {
    for (std::size_t size = PRO_HEADER_BYTES; size < golden().size(); size += 512) {
        Bytes prefix(golden().begin(), golden().begin() + static_cast<std::ptrdiff_t>(size));
        storeAt(prefix, PRO_OFF_FILE_BYTES, std::uint64_t{size});
        fixHeaderChecksum(prefix);
        ASSERT_EQ(openCopy(prefix).result == PRO_OK, size + PRO_SECTION_ALIGNMENT > golden().size() + 40) << size;
    }
}

} // namespace
