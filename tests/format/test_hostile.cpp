// SPDX-License-Identifier: Apache-2.0
// Damaged and hostile files are refused with the right finding and never read out of bounds (by AddressSanitizer).
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <limits>
#include <random>
#include <set>

#include "file_bytes.h"
#include "scene_builder.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

Bytes bytesOf(Scene scene) {
    const TemporaryFolder folder;
    scene.write(folder.file("a.pro"));
    return readBytes(folder.file("a.pro"));
}

const Bytes& tiny() {
    static const Bytes bytes = bytesOf(tinyScene());
    return bytes;
}

/// Changes one value of the tiny file, fixes the checksums, and expects this finding.
template <typename T>
void expectRefused(std::size_t offset, T value, std::uint32_t finding, pro_result result = PRO_INVALID) {
    Bytes bytes = tiny();
    storeAt(bytes, offset, value);
    fixHeaderChecksum(bytes);
    const OpenResult opened = openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS);
    EXPECT_EQ(opened.result, result) << "offset " << offset << ": " << opened.message.text;
    EXPECT_EQ(opened.message.finding, finding) << "offset " << offset << ": " << opened.message.text;
    EXPECT_TRUE(has(findingsOf(bytes), finding));
}

std::size_t record(std::uint32_t kind, std::size_t field) { return recordOf(tiny(), kind) + field; }
std::size_t word(std::uint32_t kind, std::size_t index) { return sectionOf(tiny(), kind) + 4 * index; }

TEST(Hostile, TheIntactFileOpens) {
    EXPECT_EQ(openCopy(tiny()).result, PRO_OK);
    EXPECT_TRUE(findingsOf(tiny()).empty());
}

TEST(Hostile, EveryPrefixIsRefused) {
    for (std::size_t size = 0; size < tiny().size(); ++size) {
        const Bytes prefix(tiny().begin(), tiny().begin() + static_cast<std::ptrdiff_t>(size));
        const OpenResult opened = openCopy(prefix);
        ASSERT_EQ(opened.result, PRO_INVALID) << size;
        ASSERT_EQ(opened.message.finding, size < PRO_HEADER_BYTES ? 1001u : 1004u) << size;
    }
}

TEST(Hostile, EveryPrefixIsRefusedEvenIfItsHeaderAgrees) {
    for (std::size_t size = PRO_HEADER_BYTES; size < tiny().size(); size += 16) {
        Bytes prefix(tiny().begin(), tiny().begin() + static_cast<std::ptrdiff_t>(size));
        storeAt(prefix, PRO_OFF_FILE_BYTES, std::uint64_t{size});
        // only the padding of the last section may be missing
        const auto last = recordOf(tiny(), PRO_KIND_META);
        const auto end = loadAt<std::uint64_t>(tiny(), last + PRO_SEC_OFF_OFFSET) +
                         loadAt<std::uint64_t>(tiny(), last + PRO_SEC_OFF_LENGTH);
        ASSERT_EQ(openCopy(prefix).result, size >= end ? PRO_OK : PRO_INVALID) << size;
    }
}

TEST(Hostile, ExtraBytesAreRefused) {
    Bytes longer = tiny();
    longer.push_back(std::byte{0});
    EXPECT_EQ(openCopy(longer).message.finding, 1004u);
}

TEST(Hostile, EveryFlippedByteIsFound) {
    for (std::size_t i = 0; i < tiny().size(); ++i) {
        if (i >= PRO_OFF_VERSION_MINOR && i < PRO_OFF_FILE_BYTES) continue; // every minor version is read
        Bytes bytes = tiny();
        bytes[i] ^= std::byte{0x10};
        ASSERT_FALSE(findingsOf(bytes).empty()) << "byte " << i;
    }
}

TEST(Hostile, EveryHeaderWordAtExtremes) {
    // words that may take these values: minor version, flags, low halves of doubles, numbers in range, and those that
    // only verify compares
    std::set<std::size_t> free_words = {PRO_OFF_VERSION_MINOR, PRO_OFF_FLAGS,       PRO_OFF_RADIUS_STEP,
                                        PRO_OFF_BLEND_SLAB,    PRO_OFF_INPUT_COUNT, PRO_OFF_NOISE};
    for (std::size_t offset = PRO_OFF_ORIGIN; offset < PRO_OFF_OLD_GRID; offset += 4) free_words.insert(offset);
    for (std::size_t i = 0; i < loadAt(tiny(), PRO_OFF_SECTION_COUNT); ++i) {
        const std::size_t start = PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES;
        free_words.insert(start + PRO_SEC_OFF_FLAGS);
        free_words.insert(start + PRO_SEC_OFF_XXH3); // not compared here
        free_words.insert(start + PRO_SEC_OFF_XXH3 + 4);
    }
    for (std::size_t offset = 0; offset < PRO_HEADER_BYTES; offset += 4) {
        if (offset == PRO_OFF_HEADER_XXH3 || offset == PRO_OFF_HEADER_XXH3 + 4) continue;
        for (const std::uint32_t value : {0u, 1u, 0xFFFFFFFFu}) {
            Bytes bytes = tiny();
            if (loadAt(bytes, offset) == value) continue;
            storeAt(bytes, offset, value);
            fixHeaderChecksum(bytes);
            const OpenResult opened = openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS);
            // a file with an unknown, shorter or missing META section is still valid
            const std::size_t meta = recordOf(tiny(), PRO_KIND_META), order = recordOf(tiny(), PRO_KIND_ORDR);
            if (!free_words.contains(offset) && offset != meta && offset != order) {
                ASSERT_NE(opened.result, PRO_OK) << "offset " << offset << " value " << value;
            }
        }
    }
}

TEST(Hostile, HeaderFields) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    expectRefused(PRO_OFF_MAGIC, 0u, 1002);
    expectRefused(PRO_OFF_MAGIC + 4, 0x0A1A0A0Au, 1002);
    expectRefused(PRO_OFF_VERSION_MAJOR, 2u, 1003, PRO_UNSUPPORTED);
    expectRefused(PRO_OFF_VERSION_MAJOR, 0u, 1003, PRO_UNSUPPORTED);
    expectRefused(PRO_OFF_FILE_BYTES, ~std::uint64_t{0}, 1004);
    expectRefused(PRO_OFF_OLD_GRID, 1u, 1006);
    expectRefused(PRO_FIELDS_END, 1u, 1006);
    expectRefused(PRO_TABLE_OFFSET - 4, 1u, 1006);
    expectRefused(PRO_OFF_FLAGS, 16u, 1007);
    expectRefused(PRO_OFF_SPLAT_COUNT, 0u, 1008);
    expectRefused(PRO_OFF_NODE_COUNT, 0u, 1008);
    expectRefused(PRO_OFF_NODE_COUNT, 23u, 1008);
    expectRefused(PRO_OFF_LEAF_COUNT, 0u, 1008);
    expectRefused(PRO_OFF_LEAF_COUNT, 0x7FFFFFFFu, 1008);
    expectRefused(PRO_OFF_MATERIAL_COUNT, 257u, 1008);
    expectRefused(PRO_OFF_MAX_DEPTH, 22u, 1009);
    expectRefused(PRO_OFF_RADIUS_MAX, kNan, 1010);
    expectRefused(PRO_OFF_RADIUS_MAX, 0.0f, 1010);
    expectRefused(PRO_OFF_RADIUS_MAX, 4.5f, 1010);
    expectRefused(PRO_OFF_RADIUS_STEP, -0.1f, 1011);
    expectRefused(PRO_OFF_RADIUS_STEP, kNan, 1011);
    expectRefused(PRO_OFF_BLEND_SLAB, 4.1f, 1012);
    expectRefused(PRO_OFF_SCALE, 0.0, 1013);
    expectRefused(PRO_OFF_SCALE, kInfinite, 1013);
    expectRefused(PRO_OFF_ORIGIN + 16, kInfinite, 1013);
    expectRefused(PRO_OFF_ORIGIN + 8, double{kNan}, 1013);
    expectRefused(PRO_OFF_BOUNDS_MIN, 12.0, 1014);
    expectRefused(PRO_OFF_BOUNDS_MAX + 16, double{kNan}, 1014);
}

TEST(Hostile, HeaderChecksum) {
    Bytes bytes = tiny();
    storeAt(bytes, PRO_OFF_HEADER_XXH3, std::uint64_t{1});
    EXPECT_EQ(openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).message.finding, 1005u);
}

TEST(Hostile, SectionTable) {
    constexpr std::uint64_t kHuge = ~std::uint64_t{0};
    expectRefused(PRO_OFF_SECTION_COUNT, 57u, 2001);
    expectRefused(PRO_OFF_SECTION_COUNT, 0xFFFFFFFFu, 2001);
    expectRefused(PRO_OFF_SECTION_STRIDE, 0u, 2001);
    expectRefused(record(PRO_KIND_NODE, PRO_SEC_OFF_KIND), 0x58585858u, 2002, PRO_UNSUPPORTED);
    expectRefused(record(PRO_KIND_META, PRO_SEC_OFF_KIND), std::uint32_t{PRO_KIND_ORDR}, 2009);
    expectRefused(record(PRO_KIND_LEAF, PRO_SEC_OFF_LENGTH), kHuge, 2005);
    expectRefused(record(PRO_KIND_LEAF, PRO_SEC_OFF_COUNT), (std::uint64_t{1} << 60) + 5,
                  2005); // 16 * count wraps to 80
    expectRefused(record(PRO_KIND_LEAF, PRO_SEC_OFF_STRIDE), 0u, 2005);
    expectRefused(record(PRO_KIND_SPLT, PRO_SEC_OFF_OFFSET), std::uint64_t{0}, 2006);
    expectRefused(record(PRO_KIND_SPLT, PRO_SEC_OFF_OFFSET), kHuge - 4095, 2006);
    expectRefused(record(PRO_KIND_SPLT, PRO_SEC_OFF_OFFSET), std::uint64_t{tiny().size()}, 2006);
    expectRefused(record(PRO_KIND_SPLT, PRO_SEC_OFF_OFFSET), std::uint64_t{4100}, 2007);
    expectRefused(record(PRO_KIND_SPLT, PRO_SEC_OFF_OFFSET), std::uint64_t{4096}, 2008);
    expectRefused(record(PRO_KIND_NODE, PRO_SEC_OFF_FLAGS), 3u, 2010);
    expectRefused(record(PRO_KIND_NODE, PRO_SEC_OFF_FLAGS + 4), 1u, 2010);
    expectRefused(PRO_HEADER_BYTES - 4, 1u, 2010);
    expectRefused(PRO_OFF_MATERIAL_COUNT, 1u, 2009);
    expectRefused(PRO_OFF_REF_COUNT, 4u, 2009);
    expectRefused(PRO_OFF_SPLAT_COUNT, 6u, 2009);
}

TEST(Hostile, SectionsMissingOrTwice) {
    Bytes missing = tiny();
    storeAt(missing, recordOf(missing, PRO_KIND_MATL) + PRO_SEC_OFF_FLAGS, 0u);
    storeAt(missing, recordOf(missing, PRO_KIND_MATL) + PRO_SEC_OFF_KIND, 0x58585858u);
    fixHeaderChecksum(missing);
    EXPECT_EQ(openCopy(missing).message.finding, 2004u);

    Bytes twice = tiny(); // NODE (24 words) and a second section of the same shape over the splats' page
    const std::size_t order = recordOf(twice, PRO_KIND_ORDR);
    storeAt(twice, order + PRO_SEC_OFF_KIND, std::uint32_t{PRO_KIND_NODE});
    storeAt(twice, order + PRO_SEC_OFF_COUNT, std::uint64_t{24});
    storeAt(twice, order + PRO_SEC_OFF_LENGTH, std::uint64_t{96});
    fixHeaderChecksum(twice);
    EXPECT_EQ(openCopy(twice).message.finding, 2003u);
}

TEST(Hostile, OffsetPlusLengthMayNotWrap) {
    Bytes bytes = tiny(); // META: stride 1, so that length and count can be anything
    const std::uint64_t length = ~std::uint64_t{0} - 4095;
    storeAt(bytes, record(PRO_KIND_META, PRO_SEC_OFF_COUNT), length);
    storeAt(bytes, record(PRO_KIND_META, PRO_SEC_OFF_LENGTH), length);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).message.finding, 2006u);
}

TEST(Hostile, UnknownOptionalSectionsAreSkipped) {
    Bytes bytes = tiny();
    storeAt(bytes, recordOf(bytes, PRO_KIND_ORDR), 0x58585858u);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK);
    EXPECT_TRUE(findingsOf(bytes).empty());
}

TEST(Hostile, LaterMinorVersionsAreRead) {
    Bytes bytes = tiny();
    storeAt(bytes, PRO_OFF_VERSION_MINOR, 9u);
    storeAt(bytes, PRO_OFF_FLAGS, 0xFFu);
    storeAt(bytes, PRO_FIELDS_END, 5u);                                              // a field of a later version
    storeAt(bytes, word(PRO_KIND_MATL, PRO_MAT_SHININESS + 1), 1.5f);                // another out-of-range value
    storeAt(bytes, recordOf(bytes, PRO_KIND_NODE) + PRO_SEC_OFF_FLAGS + 4, 0x1234u); // and one in the table
    fixChecksums(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK);
    EXPECT_TRUE(findingsOf(bytes).empty());
}

TEST(Hostile, SectionChecksumsCanBeSkipped) {
    Bytes bytes = tiny();
    bytes[sectionOf(bytes, PRO_KIND_SPLT)] ^= std::byte{1};
    EXPECT_EQ(openCopy(bytes).message.finding, 2012u);
    EXPECT_EQ(openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).result, PRO_OK);
}

TEST(Hostile, PaddingIsCheckedByVerify) {
    Bytes bytes = tiny();
    bytes.back() = std::byte{1};
    EXPECT_EQ(openCopy(bytes).result, PRO_OK);
    EXPECT_EQ(findingsOf(bytes), std::vector<std::uint32_t>{2011});
}

TEST(Hostile, NodeWords) {
    constexpr std::uint32_t kInner = PRO_NODE_INNER;
    expectRefused(word(PRO_KIND_NODE, 3), 1u, 3001);
    expectRefused(word(PRO_KIND_NODE, 0), kInner | 0u, 3002); // a cycle
    expectRefused(word(PRO_KIND_NODE, 9), kInner | 1u, 3002); // another cycle
    expectRefused(word(PRO_KIND_NODE, 9), 0xFFFFFFFFu, 3002);
    expectRefused(word(PRO_KIND_NODE, 0), 0u, 3003);
    expectRefused(word(PRO_KIND_NODE, 16), kInner | 3u, 3004); // one group too many
    expectRefused(word(PRO_KIND_NODE, 8), 6u, 3005);
    expectRefused(word(PRO_KIND_NODE, 8), 0x7FFFFFFFu, 3005);
    expectRefused(word(PRO_KIND_NODE, 8), 2u, 3007);
    expectRefused(word(PRO_KIND_NODE, 23), 0u, 3007);
    expectRefused(PRO_OFF_MAX_DEPTH, 1u, 3006);
}

TEST(Hostile, EveryNodeWordIsChecked) {
    for (std::size_t i = 0; i < 24; ++i)
        for (const std::uint32_t value : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 0x7FFFFFFFu, 0x80000000u, 0x80000001u,
                                          0x80000002u, 0x80000003u, 0xFFFFFFFFu}) {
            Bytes bytes = tiny();
            if (loadAt(bytes, word(PRO_KIND_NODE, i)) == value) continue;
            storeAt(bytes, word(PRO_KIND_NODE, i), value);
            fixChecksums(bytes);
            ASSERT_EQ(openCopy(bytes).result, PRO_INVALID) << "node " << i << " value " << value;
        }
}

TEST(Hostile, DeepChainIsRefusedWithoutRecursion) {
    // each group holds one inner node: a valid breadth-first numbering, 200,000 levels deep
    Scene scene = tinyScene();
    constexpr std::uint32_t kGroups = 200000;
    scene.nodes.assign(std::size_t{kGroups} * 8, 0);
    for (std::uint32_t group = 0; group + 1 < kGroups; ++group) scene.nodes[group * 8] = PRO_NODE_INNER | (group + 1);
    scene.nodes[(kGroups - 1) * 8] = 1;
    const TemporaryFolder folder;
    const pro_view view = scene.view();
    pro_message message{};
    EXPECT_EQ(pro_write((folder.file("a.pro")).c_str(), &scene.info, &view, &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(message.finding, 3006u);
}

TEST(Hostile, LeafWords) {
    const auto leaf = [](std::size_t index, std::size_t field) { return word(PRO_KIND_LEAF, 4 * index + field); };
    expectRefused(leaf(0, PRO_LEAF_RESERVED), 1u, 4001);
    expectRefused(leaf(3, PRO_LEAF_COUNTS), 0u, 4002);
    expectRefused(leaf(1, PRO_LEAF_FIRST_MEMBER), 0xFFFFFFFFu, 4003);
    expectRefused(leaf(0, PRO_LEAF_FIRST_MEMBER), 1u, 4003);
    expectRefused(leaf(0, PRO_LEAF_FIRST_REF), 1u, 4004);
    expectRefused(leaf(4, PRO_LEAF_COUNTS), 0xFFFFFFFFu, 4005);
    expectRefused(leaf(4, PRO_LEAF_COUNTS), 2u, 4005);
}

TEST(Hostile, EveryLeafWordIsChecked) {
    for (std::size_t i = 0; i < 5 * PRO_LEAF_WORDS; ++i)
        for (const std::uint32_t value : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 0x10000u, 0x20000u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
            Bytes bytes = tiny();
            if (loadAt(bytes, word(PRO_KIND_LEAF, i)) == value) continue;
            storeAt(bytes, word(PRO_KIND_LEAF, i), value);
            fixChecksums(bytes);
            ASSERT_EQ(openCopy(bytes).result, PRO_INVALID) << "leaf word " << i << " value " << value;
        }
}

TEST(Hostile, References) {
    for (std::size_t i = 0; i < 3; ++i)
        for (const std::uint32_t value : {5u, 0x7FFFFFFFu, 0xFFFFFFFFu})
            expectRefused(word(PRO_KIND_REFS, i), value, 4006);
}

TEST(Hostile, FindingsOfVerifyOnly) {
    const auto expectFound = [](std::size_t offset, auto value, std::uint32_t finding) {
        Bytes bytes = tiny();
        storeAt(bytes, offset, value);
        fixChecksums(bytes);
        EXPECT_EQ(openCopy(bytes).result, PRO_OK) << finding;
        EXPECT_EQ(findingsOf(bytes), std::vector<std::uint32_t>{finding});
    };
    expectFound(word(PRO_KIND_REFS, 0), 2u, 4007);
    expectFound(word(PRO_KIND_REFS, 1), 1u, 4008);
    expectFound(word(PRO_KIND_SPLT, 0), loadAt(tiny(), word(PRO_KIND_SPLT, 0)) | 1u << 20, 5004);
    expectFound(PRO_OFF_BOUNDS_MAX, 11.7, 5005);
    expectFound(word(PRO_KIND_META, 0), 0xBFFFBFFFu, 8001);
}

TEST(Hostile, Splats) {
    for (std::size_t i = 0; i < 5; ++i) {
        expectRefused(word(PRO_KIND_SPLT, 4 * i + 1), 0x80000000u, 5001);
        expectRefused(word(PRO_KIND_SPLT, 4 * i + 2), 2u << PRO_MATERIAL_SHIFT, 5002);
        expectRefused(word(PRO_KIND_SPLT, 4 * i + 2), 0xFFFFFFFFu, 5002);
    }
    Bytes bytes = tiny();
    storeAt(bytes, PRO_OFF_RADIUS_STEP, 1.0f);
    storeAt(bytes, word(PRO_KIND_SPLT, 3), 255u << PRO_RADIUS_SHIFT);
    fixChecksums(bytes);
    EXPECT_EQ(openCopy(bytes).message.finding, 5003u);
}

TEST(Hostile, Materials) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i <= PRO_MAT_SHININESS; ++i)
        for (const float value : {kNan, -1.0f, 1e9f, std::numeric_limits<float>::infinity()})
            expectRefused(word(PRO_KIND_MATL, PRO_MATERIAL_FLOATS + i), value, 6001);
    expectRefused(word(PRO_KIND_MATL, PRO_MAT_SHININESS), 0.5f, 6001);
    expectRefused(word(PRO_KIND_MATL, 15), 1.0f, 6002);
}

TEST(Hostile, Order) {
    expectRefused(word(PRO_KIND_ORDR, 0), 0u, 7001);
    Bytes above = tiny(); // values from splat_count on are compared by verify only
    storeAt(above, word(PRO_KIND_ORDR, 0), 7u);
    fixChecksums(above);
    EXPECT_EQ(openCopy(above).result, PRO_OK);
    EXPECT_EQ(findingsOf(above), std::vector<std::uint32_t>{7001});
}

TEST(Hostile, MetadataUtf8) {
    const auto found = [](std::string text) {
        Bytes bytes = tiny();
        text.resize(23, ' ');
        std::memcpy(bytes.data() + sectionOf(bytes, PRO_KIND_META), text.data(), text.size());
        fixChecksums(bytes);
        return !findingsOf(bytes).empty();
    };
    ASSERT_EQ(tinyScene().metadata.size(), 23u);
    for (const char* good : {"", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"})
        EXPECT_FALSE(found(good)) << good;
    for (const char* bad : {"\x80", "\xC0\x80", "\xC3", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF5\x80"})
        EXPECT_TRUE(found(bad));
    EXPECT_TRUE(found(std::string(22, 'a') + "\xE2")) << "truncated at the end";
}

TEST(Hostile, ManyBrokenPlacesAreOneFinding) {
    Bytes bytes = tiny();
    for (std::size_t i = 0; i < 5; ++i) storeAt(bytes, word(PRO_KIND_SPLT, 4 * i + 1), 0x80000000u);
    fixChecksums(bytes);
    EXPECT_TRUE(has(findingsOf(bytes), 5001));
    EXPECT_SAYS(openCopy(bytes).message.text, "splat 0: *ball*(and 4 more)");
}

TEST(Hostile, RandomDamageNeverReadsOutOfBounds) {
    std::mt19937 random(11);
    std::vector<pro_splat> splats(60);
    std::uniform_real_distribution<float> unit(0, 0.999f);
    for (pro_splat& splat : splats) splat = {{unit(random), unit(random), unit(random)}, {0, 0, 1}, 0.05f, {}, 0};
    const Bytes intact = bytesOf(sceneOf(splats));
    const std::uint32_t extremes[] = {0, 1, 7, 8, 0x7FFFFFFF, 0x80000000, 0x80000001, 0xFFFFFFFF};
    int opened = 0;
    for (int round = 0; round < 20000; ++round) {
        Bytes bytes = intact;
        for (unsigned changes = 1 + random() % 3; changes > 0; --changes) {
            const std::size_t used = random() % 4 == 0 ? PRO_TABLE_OFFSET + 7 * PRO_SECTION_BYTES : bytes.size();
            const std::size_t offset = random() % used / 4 * 4;
            const bool extreme = random() % 2 == 0;
            storeAt(bytes, offset, extreme ? extremes[random() % 8] : static_cast<std::uint32_t>(random() % 100));
        }
        fixHeaderChecksum(bytes);
        opened += openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).result == PRO_OK;
    }
    EXPECT_GT(opened, 100) << "some damage must pass the first checks";
}

TEST(Hostile, WrongArguments) {
    pro_file* file = nullptr;
    pro_message message{};
    EXPECT_EQ(pro_open(nullptr, 0, &file, &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(pro_open("x", 0, nullptr, nullptr), PRO_BAD_ARGUMENT);
    EXPECT_EQ(pro_open_memory(nullptr, 5, 0, &file, &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(pro_open_memory(tiny().data() + 1, 5, 0, &file, &message), PRO_BAD_ARGUMENT);
    pro_close(nullptr);
}

TEST(Hostile, FilesThatCannotBeRead) {
    const TemporaryFolder folder;
    writeBytes(folder.file("empty.pro"), {});
    ASSERT_EQ(mkfifo((folder.file("pipe.pro")).c_str(), 0600), 0);
    for (const std::string& path :
         {folder.file("missing.pro"), folder.file("empty.pro"), folder.file("pipe.pro"), folder.path.string()}) {
        pro_file* file = nullptr;
        pro_message message{};
        EXPECT_EQ(pro_open(path.c_str(), 0, &file, &message), PRO_CANNOT_READ) << path;
        EXPECT_EQ(message.finding, 0u);
        EXPECT_NE(message.text[0], '\0');
        EXPECT_EQ(file, nullptr);
    }
}

} // namespace
