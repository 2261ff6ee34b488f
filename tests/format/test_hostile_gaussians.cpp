// SPDX-License-Identifier: Apache-2.0
// Damaged and hostile Gaussians are refused with the right finding, or stay in bounds.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_gaussians.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

const Bytes& soundGaussians() {
    static const Bytes bytes = [] {
        const TemporaryFolder folder;
        Scene scene = tinyScene();
        TinyGaussians gaussians(scene);
        gaussians.exact = {{1, {1, 0, 0, 0}, {0.5f, 0.25f, 0.125f}, 0.5f}, {3, {0, 1, 0, 0}, {1, 1, 1}, 1}};
        EXPECT_EQ(gaussians.write(scene, folder.file("a.pro")), PRO_OK);
        return readBytes(folder.file("a.pro"));
    }();
    return bytes;
}

constexpr std::uint32_t kNeededKinds[] = {PRO_KIND_GAUS, PRO_KIND_GHRM, PRO_KIND_GNOD, PRO_KIND_GLST};
constexpr std::uint32_t kGaussianKinds[] = {PRO_KIND_GAUS, PRO_KIND_GHRM, PRO_KIND_GNOD, PRO_KIND_GLST, PRO_KIND_GEXA};
constexpr std::uint32_t kUnknownKind = 0x78787878;

void expectRefusedWith(const Bytes& bytes, std::uint32_t finding) {
    for (const std::uint32_t flags : {0u, std::uint32_t{PRO_OPEN_TRACE}}) {
        const OpenResult opened = openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | flags);
        EXPECT_EQ(opened.result, PRO_INVALID) << opened.message.text;
        EXPECT_EQ(opened.message.finding, finding) << opened.message.text;
    }
    EXPECT_TRUE(has(findingsOf(bytes), finding));
}

template <typename T>
Bytes changedGaussians(std::size_t offset, T value) {
    Bytes bytes = soundGaussians();
    EXPECT_NE(loadAt<T>(bytes, offset), value);
    storeAt(bytes, offset, value);
    fixHeaderChecksum(bytes);
    return bytes;
}

/// Changes one value, fixes the header's checksum, and expects this finding.
template <typename T>
void expectRefusedGaussians(std::size_t offset, T value, std::uint32_t finding) {
    SCOPED_TRACE("offset " + std::to_string(offset) + " value " + std::to_string(value));
    expectRefusedWith(changedGaussians(offset, value), finding);
}

std::size_t gaussianRecord(std::uint32_t kind, std::size_t field) { return recordOf(soundGaussians(), kind) + field; }
std::size_t nodeWord(std::size_t node, std::size_t word) {
    return sectionOf(soundGaussians(), PRO_KIND_GNOD) + 4 * (node * PRO_GAUSSIAN_NODE_WORDS + word);
}
std::size_t listWord(std::size_t i) { return sectionOf(soundGaussians(), PRO_KIND_GLST) + 4 * i; }

/// The file with a different number of elements in a section.
Bytes withGaussianCount(std::uint32_t kind, std::uint64_t count) {
    Bytes bytes = soundGaussians();
    storeAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_COUNT), count);
    storeAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_LENGTH),
            count * loadAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_STRIDE)));
    fixHeaderChecksum(bytes);
    return bytes;
}

TEST(HostileGaussians, TheIntactFileOpens) {
    EXPECT_EQ(openCopy(soundGaussians()).result, PRO_OK);
    EXPECT_EQ(openCopy(soundGaussians(), PRO_OPEN_TRACE).result, PRO_OK);
    EXPECT_TRUE(findingsOf(soundGaussians()).empty());
}

TEST(HostileGaussians, EveryFlippedByteIsFound) {
    const auto expectFlipsFound = [](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Bytes bytes = soundGaussians();
            bytes[i] ^= std::byte{0x10};
            ASSERT_FALSE(findingsOf(bytes).empty()) << "byte " << i;
        }
    };
    expectFlipsFound(PRO_OFF_HARMONICS_DEGREE, PRO_FIELDS_END + 4);
    for (const std::uint32_t kind : kGaussianKinds) { // and the first padding bytes
        expectFlipsFound(gaussianRecord(kind, 0), gaussianRecord(kind, PRO_SECTION_BYTES));
        const auto length = loadAt<std::uint64_t>(soundGaussians(), gaussianRecord(kind, PRO_SEC_OFF_LENGTH));
        expectFlipsFound(sectionOf(soundGaussians(), kind), sectionOf(soundGaussians(), kind) + length + 4);
    }
}

TEST(HostileGaussians, Coding) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    for (const float low : {-60.5f, 10.5f, kNan, -kInfinite}) expectRefusedGaussians(PRO_OFF_DEVIATION_LOW, low, 9501);
    for (const float step : {0.0f, -0.01f, 1.01f, kNan, kInfinite, 0.02f}) // the last one leads to 2^70
        expectRefusedGaussians(PRO_OFF_DEVIATION_STEP, step, 9501);
    for (const float low : {kNan, kInfinite, -2e30f}) expectRefusedGaussians(PRO_OFF_COLOR_LOW, low, 9501);
    for (const float step : {kNan, kInfinite, -0.1f, 2e30f}) expectRefusedGaussians(PRO_OFF_COLOR_STEP, step, 9501);
    for (const float most : {kNan, kInfinite, -1.0f}) expectRefusedGaussians(PRO_OFF_HARMONIC_MAX, most, 9501);
    expectRefusedGaussians(PRO_OFF_HARMONIC_MAX + 4, 0.5f, 9501); // above the degree
    EXPECT_EQ(openCopy(changedGaussians(PRO_OFF_COLOR_STEP, 0.0f)).result, PRO_OK) << "one colour";
}

TEST(HostileGaussians, HarmonicsFitTheDegree) {
    for (const std::uint32_t degree : {0u, 2u, 3u, 4u, 0xFFFFFFFFu})
        expectRefusedGaussians(PRO_OFF_HARMONICS_DEGREE, degree, 2009);
    Bytes bytes = changedGaussians(gaussianRecord(PRO_KIND_GHRM, PRO_SEC_OFF_KIND), kUnknownKind);
    expectRefusedWith(bytes, 9502); // degree 1 without GHRM
    storeAt(bytes, PRO_OFF_HARMONICS_DEGREE, 4u);
    fixHeaderChecksum(bytes);
    expectRefusedWith(bytes, 9501);
    storeAt(bytes, PRO_OFF_HARMONICS_DEGREE, 0u);
    storeAt(bytes, PRO_OFF_HARMONIC_MAX, 0.0f);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK) << "no view-dependent colour";
    storeAt(bytes, gaussianRecord(PRO_KIND_GHRM, PRO_SEC_OFF_KIND), PRO_KIND_GHRM);
    storeAt(bytes, gaussianRecord(PRO_KIND_GHRM, PRO_SEC_OFF_STRIDE), 0u);
    storeAt(bytes, gaussianRecord(PRO_KIND_GHRM, PRO_SEC_OFF_LENGTH), std::uint64_t{0});
    fixHeaderChecksum(bytes);
    expectRefusedWith(bytes, 9502); // GHRM without a degree
}

TEST(HostileGaussians, AllSectionsOrNone) {
    for (const std::uint32_t kind : kNeededKinds)
        expectRefusedGaussians(gaussianRecord(kind, PRO_SEC_OFF_KIND), kUnknownKind, 9502);
    Bytes bytes = soundGaussians();
    for (const std::uint32_t kind : kNeededKinds) storeAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_KIND), kUnknownKind);
    fixHeaderChecksum(bytes);
    expectRefusedWith(bytes, 9502); // exact parameters for no Gaussians
    storeAt(bytes, gaussianRecord(PRO_KIND_GEXA, PRO_SEC_OFF_KIND), kUnknownKind);
    fixHeaderChecksum(bytes);
    expectRefusedWith(bytes, 9501); // a coding without sections
    for (std::size_t offset = PRO_OFF_HARMONICS_DEGREE; offset < PRO_FIELDS_END; offset += 4)
        storeAt(bytes, offset, 0u);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK) << "an ordinary file of splats";
}

TEST(HostileGaussians, SectionCounts) {
    for (const std::uint32_t kind : {PRO_KIND_GAUS, PRO_KIND_GHRM})
        for (const std::uint64_t count : {0, 4, 6}) expectRefusedWith(withGaussianCount(kind, count), 2009);
    for (const std::uint64_t count : {0, 16, 23, 25}) expectRefusedWith(withGaussianCount(PRO_KIND_GNOD, count), 9506);
    expectRefusedWith(withGaussianCount(PRO_KIND_GNOD, 32), 9505);
    for (const std::uint64_t count : {0, 4}) expectRefusedWith(withGaussianCount(PRO_KIND_GLST, count), 9508);
    for (const std::uint32_t kind : kGaussianKinds) {
        const auto stride = loadAt(soundGaussians(), gaussianRecord(kind, PRO_SEC_OFF_STRIDE));
        const auto count = loadAt<std::uint64_t>(soundGaussians(), gaussianRecord(kind, PRO_SEC_OFF_COUNT));
        Bytes bytes = soundGaussians();
        storeAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_STRIDE), 2 * stride);
        storeAt(bytes, gaussianRecord(kind, PRO_SEC_OFF_LENGTH), 2 * stride * count);
        fixHeaderChecksum(bytes);
        expectRefusedWith(bytes, 2009);
    }
}

TEST(HostileGaussians, RootGroup) {
    expectRefusedGaussians(nodeWord(3, PRO_GAUSSIAN_NODE_CHILDREN), 1u, 9503);
    expectRefusedGaussians(nodeWord(4, PRO_GAUSSIAN_NODE_FIRST), 0u, 9503);
    expectRefusedGaussians(nodeWord(8, PRO_GAUSSIAN_NODE_FIRST), 2u, 9503); // then the last of the seven would list one
}

/// The root names group 1, and node 9 in it names group 2.
TEST(HostileGaussians, TraversalsOfNodesEnd) {
    for (const std::uint32_t group : {2u, 3u, 0x80000001u, 0xFFFFFFFFu})
        expectRefusedGaussians(nodeWord(0, PRO_GAUSSIAN_NODE_CHILDREN), group, 9504);
    for (const std::uint32_t group : {1u, 3u, 0xFFFFFFFFu})
        expectRefusedGaussians(nodeWord(9, PRO_GAUSSIAN_NODE_CHILDREN), group, 9504);
    for (const std::uint32_t group : {1u, 2u}) // a cycle, and a group named twice
        expectRefusedGaussians(nodeWord(20, PRO_GAUSSIAN_NODE_CHILDREN), group, 9504);
    expectRefusedGaussians(nodeWord(0, PRO_GAUSSIAN_NODE_CHILDREN), 0u, 9505);
    expectRefusedGaussians(nodeWord(9, PRO_GAUSSIAN_NODE_CHILDREN), 0u, 9505);
    expectRefusedGaussians(nodeWord(20, PRO_GAUSSIAN_NODE_CHILDREN), 3u, 9506); // there is no group 3
}

/// An octree of this many levels below the root; the deepest node lists everything.
TinyGaussians deepGaussians(const Scene& scene, std::uint32_t depth) {
    TinyGaussians gaussians(scene);
    gaussians.nodes.assign((depth + 1) * PRO_GROUP_SIZE * PRO_GAUSSIAN_NODE_WORDS, 0);
    for (std::uint32_t group = 0; group < depth; ++group)
        gaussians.nodes[group * PRO_GROUP_SIZE * PRO_GAUSSIAN_NODE_WORDS] = group + 1;
    for (std::size_t slot = 1; slot < PRO_GROUP_SIZE; ++slot)
        gaussians.nodes[(depth * PRO_GROUP_SIZE + slot) * PRO_GAUSSIAN_NODE_WORDS + PRO_GAUSSIAN_NODE_FIRST] = 5;
    return gaussians;
}

TEST(HostileGaussians, DepthIsLimited) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    pro_message message{};
    EXPECT_EQ(deepGaussians(scene, PRO_MAX_DEPTH).write(scene, folder.file("a.pro"), &message), PRO_OK) << message.text;
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
    EXPECT_EQ(deepGaussians(scene, PRO_MAX_DEPTH + 1).write(scene, folder.file("a.pro"), &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(message.finding, 9507u);
}

TEST(HostileGaussians, Lists) {
    expectRefusedGaussians(nodeWord(0, PRO_GAUSSIAN_NODE_FIRST), 1u, 9508);
    for (const std::uint32_t first : {2u, 6u, 0xFFFFFFFFu})
        expectRefusedGaussians(nodeWord(17, PRO_GAUSSIAN_NODE_FIRST), first, 9508);
    for (const std::uint32_t first : {4u, 6u, 0x80000000u})
        expectRefusedGaussians(nodeWord(22, PRO_GAUSSIAN_NODE_FIRST), first, 9508);
    expectRefusedGaussians(nodeWord(23, PRO_GAUSSIAN_NODE_FIRST), 6u, 9508); // the last node's list would end before it
    for (std::size_t i = 0; i < 5; ++i)
        for (const std::uint32_t index : {5u, 0x80000000u, 0xFFFFFFFFu})
            expectRefusedGaussians(listWord(i), index, 9509);
}

TEST(HostileGaussians, HarmonicCodes) {
    const std::size_t first = sectionOf(soundGaussians(), PRO_KIND_GHRM);
    for (const std::size_t at : {std::size_t{0}, std::size_t{44}})
        expectRefusedGaussians(first + at, std::int8_t{-128}, 9511);
}

TEST(HostileGaussians, ExactParameters) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    const std::size_t first = sectionOf(soundGaussians(), PRO_KIND_GEXA), second = first + PRO_EXACT_GAUSSIAN_BYTES;
    const auto word = [](std::size_t record, std::size_t i) { return record + 4 * i; };
    for (const std::uint32_t index : {3u, 4u, 5u, 0xFFFFFFFFu}) expectRefusedGaussians(first, index, 9512);
    for (const std::uint32_t index : {0u, 1u, 5u, 0x80000000u}) expectRefusedGaussians(second, index, 9512);
    for (const float component : {kNan, kInfinite, 0.999f, 0.0f})
        expectRefusedGaussians(word(first, 1), component, 9513);
    for (const float deviation : {kNan, kInfinite, 0.0f, -1.0f, 0x1p-61f, 0x1p61f})
        expectRefusedGaussians(word(second, 7), deviation, 9513);
    for (const float opacity : {kNan, -0.1f, 1.1f}) expectRefusedGaussians(word(second, 8), opacity, 9513);
    EXPECT_EQ(openCopy(changedGaussians(word(first, 1), -1.0f), PRO_OPEN_SKIP_CHECKSUMS).result, PRO_OK);
    for (const std::uint64_t count :
         {std::uint64_t{3}, std::uint64_t{1} << 40}) { // more than there are, and more than memory holds
        const Bytes bytes = withGaussianCount(PRO_KIND_GEXA, count);
        EXPECT_EQ(openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).result, PRO_INVALID);
    }
}

TEST(HostileGaussians, OnlyVerifyFindsGaussiansThatCountTwice) {
    for (const auto& [entry, index] : {std::pair<std::size_t, std::uint32_t>{2, 0}, {3, 4}, {4, 0}}) {
        Bytes bytes = changedGaussians(listWord(entry), index); // twice in a node; or in nodes of two depths
        fixChecksums(bytes);
        EXPECT_EQ(openCopy(bytes).result, PRO_OK);
        EXPECT_EQ(findingsOf(bytes), std::vector<std::uint32_t>{9510});
    }
    Bytes bytes = changedGaussians(listWord(1), 2u); // two nodes of different depth
    fixChecksums(bytes);
    EXPECT_EQ(findingsOf(bytes), std::vector<std::uint32_t>{9510});
}

TEST(HostileGaussians, RandomDamageStaysInBounds) {
    std::mt19937 random(13);
    const std::uint32_t extremes[] = {0, 1, 2, 8, 0x7FFFFFFF, 0x80000000, 0xFFFFFFF0, 0xFFFFFFFF};
    int opened = 0;
    for (int round = 0; round < 20000; ++round) {
        Bytes bytes = soundGaussians();
        for (unsigned changes = 1 + random() % 2; changes > 0; --changes) {
            const std::size_t kinds = std::size(kGaussianKinds), kind = random() % (kinds + 1);
            const std::size_t used = PRO_TABLE_OFFSET + 12 * PRO_SECTION_BYTES;
            const std::size_t start = kind < kinds ? sectionOf(soundGaussians(), kGaussianKinds[kind]) : 0;
            const std::size_t offset = start + random() % (kind < kinds ? 200 : used) / 4 * 4;
            storeAt(bytes, offset, random() % 2 ? extremes[random() % 8] : static_cast<std::uint32_t>(random() % 30));
        }
        fixHeaderChecksum(bytes);
        opened += openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | (round % 2 ? 0u : std::uint32_t{PRO_OPEN_TRACE})).result ==
                  PRO_OK;
    }
    EXPECT_GT(opened, 100) << "some damage must pass the first checks";
}

} // namespace
