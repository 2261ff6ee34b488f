// SPDX-License-Identifier: Apache-2.0
// Damaged and hostile tracing indexes are refused with the right finding, or stay in bounds.
#include <gtest/gtest.h>

#include <random>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_index.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

Bytes bytesOf(Index index) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    index.write(scene, folder.file("a.pro"));
    return readBytes(folder.file("a.pro"));
}

const Bytes& indexed() {
    static const Bytes bytes = bytesOf(tinyIndex());
    return bytes;
}

void expectFinding(const Bytes& bytes, std::uint32_t finding) {
    for (const std::uint32_t flags : {0u, std::uint32_t{PRO_OPEN_TRACE}}) {
        const OpenResult opened = openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | flags);
        EXPECT_EQ(opened.result, PRO_INVALID) << opened.message.text;
        EXPECT_EQ(opened.message.finding, finding) << opened.message.text;
    }
    EXPECT_TRUE(has(findingsOf(bytes), finding));
}

/// Changes one value, fixes the checksums, and expects this finding.
template <typename T>
void expectRefusedIndex(std::size_t offset, T value, std::uint32_t finding) {
    SCOPED_TRACE("offset " + std::to_string(offset) + " value " + std::to_string(value));
    Bytes bytes = indexed();
    ASSERT_NE(loadAt<T>(bytes, offset), value);
    storeAt(bytes, offset, value);
    fixHeaderChecksum(bytes);
    expectFinding(bytes, finding);
}

std::size_t indexRecord(std::uint32_t kind, std::size_t field) { return recordOf(indexed(), kind) + field; }
std::size_t indexWord(std::uint32_t kind, std::size_t index) { return sectionOf(indexed(), kind) + 4 * index; }

constexpr std::uint32_t kKinds[] = {PRO_KIND_ENTR, PRO_KIND_BRKS, PRO_KIND_CELS, PRO_KIND_SLBS,
                                    PRO_KIND_DSCS, PRO_KIND_DSPL, PRO_KIND_BLDS};

TEST(HostileIndex, TheIntactFileOpens) {
    EXPECT_EQ(openCopy(indexed()).result, PRO_OK);
    EXPECT_EQ(openCopy(indexed(), PRO_OPEN_TRACE).result, PRO_OK);
    EXPECT_TRUE(findingsOf(indexed()).empty());
}

TEST(HostileIndex, EveryFlippedByteIsFound) {
    const auto expectFound = [](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Bytes bytes = indexed();
            bytes[i] ^= std::byte{0x10};
            ASSERT_FALSE(findingsOf(bytes).empty()) << "byte " << i;
        }
    };
    expectFound(PRO_OFF_OLD_GRID, PRO_OFF_UP);
    expectFound(PRO_OFF_GRID_SHIFT, PRO_FIELDS_END + 4);
    for (const std::uint32_t kind : kKinds) { // and the first padding bytes
        expectFound(recordOf(indexed(), kind), recordOf(indexed(), kind) + PRO_SECTION_BYTES);
        const auto length = loadAt<std::uint64_t>(indexed(), indexRecord(kind, PRO_SEC_OFF_LENGTH));
        expectFound(sectionOf(indexed(), kind), sectionOf(indexed(), kind) + length + 4);
    }
}

TEST(HostileIndex, Frame) {
    for (const std::uint32_t shift : {0u, PRO_GRID_SHIFT_MIN - 1, PRO_POSITION_BITS, 22u, ~0u})
        expectRefusedIndex(PRO_OFF_GRID_SHIFT, shift, 1015); // at PRO_POSITION_BITS two cells do not fit
    expectRefusedIndex(PRO_OFF_GRID_ORIGIN, 1u, 1015);
    expectRefusedIndex(PRO_OFF_GRID_ORIGIN + 8, ~0u, 1015);
    expectRefusedIndex(PRO_OFF_GRID_UNEVEN, 2u, 1015);
    expectRefusedIndex(PRO_OFF_GRID_SIZE, 0u, 2009);
    expectRefusedIndex(PRO_OFF_GRID_SIZE + 4, 2u, 2009);
    expectRefusedIndex(PRO_OFF_GRID_SIZE + 8, ~0u, 2009);
    expectRefusedIndex(PRO_OFF_GRID_UNEVEN, 0u, 2009); // but there are groups
    for (const std::uint32_t bricks : {0u, 2u, 0x10000000u, ~0u}) {
        Bytes bytes = indexed();
        storeAt(bytes, PRO_OFF_BRICK_COUNT, bricks);
        fixHeaderChecksum(bytes);
        EXPECT_EQ(openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).result, PRO_INVALID) << bricks;
    }
}

/// The writer refuses the index for the tiny scene with this finding.
void expectWriterRefuses(Index& index, std::uint32_t finding) {
    Scene scene = tinyScene();
    const pro_view view = scene.view();
    const pro_index pointers = index.view();
    pro_message message{};
    EXPECT_EQ(pro_write_indexed("unused.pro", &scene.info, &view, &pointers, &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(message.finding, finding);
}

TEST(HostileIndex, GridThatIsTooLarge) {
    Index index = tinyIndex();
    index.frame.shift = 12;
    for (std::uint32_t axis = 0; axis < 3; ++axis) index.frame.size[axis] = axis < 2 ? 256 : 257;
    expectWriterRefuses(index, 1015u);
}

TEST(HostileIndex, FrameWithoutSections) {
    Bytes bytes = indexed();
    for (const std::uint32_t kind : kKinds) storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_KIND), 0x78787878u);
    fixHeaderChecksum(bytes);
    expectFinding(bytes, 1015);
}

TEST(HostileIndex, AllSectionsOrNone) {
    for (const std::uint32_t kind : kKinds) {
        Bytes bytes = indexed();
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_KIND), 0x78787878u);
        fixHeaderChecksum(bytes);
        expectFinding(bytes, 2013);
    }
}

TEST(HostileIndex, SectionCounts) {
    for (const std::uint32_t kind : kKinds) {
        const auto count = loadAt<std::uint64_t>(indexed(), indexRecord(kind, PRO_SEC_OFF_COUNT));
        const auto stride = loadAt(indexed(), indexRecord(kind, PRO_SEC_OFF_STRIDE));
        for (const std::uint64_t other : {std::uint64_t{0}, count - 1, count + 1}) {
            Bytes bytes = indexed();
            storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_COUNT), other);
            storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_LENGTH), other * stride);
            fixHeaderChecksum(bytes);
            EXPECT_EQ(openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS).result, PRO_INVALID) << std::hex << kind << " " << other;
        }
        Bytes bytes = indexed();
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_STRIDE), 2 * stride);
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_LENGTH), 2 * stride * count);
        fixHeaderChecksum(bytes);
        expectFinding(bytes, 2009);
    }
    for (const std::uint32_t kind : {PRO_KIND_SLBS, PRO_KIND_DSPL}) { // their counts are those of CELS and DSCS
        Bytes bytes = indexed();
        const auto stride = loadAt(indexed(), indexRecord(kind, PRO_SEC_OFF_STRIDE));
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_COUNT), std::uint64_t{2});
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_LENGTH), std::uint64_t{2} * stride);
        fixHeaderChecksum(bytes);
        expectFinding(bytes, 2009);
    }
}

TEST(HostileIndex, GridWords) {
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 1), 1u << PRO_GRID_BRICK_SHIFT, 9101);
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 1), 0xFFFFFFF0u, 9101);
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 0), 0u, 9101);           // named twice
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 1), kNothingNear, 9101); // never named
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 0), 0x10111111u, 9102);
    expectRefusedIndex(indexWord(PRO_KIND_ENTR, 0), 1u, 9102);
}

TEST(HostileIndex, BrickWords) {
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 3), 0x01111111u, 9102);
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 8 * PRO_GROUP_WORDS + 1), 0x11111101u, 9102);
    for (const std::uint32_t cell : {1u, 2u, 4u, 0x7FFFFFFu}) {
        expectRefusedIndex(indexWord(PRO_KIND_BRKS, 0), cellWord(cell), 9103);
        expectRefusedIndex(indexWord(PRO_KIND_BRKS, 8 * PRO_GROUP_WORDS), cellWord(cell == 2 ? 0 : cell), 9103);
    }
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 3), cellWord(4), 9103);
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 2), kNothingNear, 9103); // cell 3 is not named
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 1), kNothingNear, 9103); // groups are not named
    for (const std::uint32_t group : {0u, 7u, 8u, 10u, 0x7FFFFFFu})
        expectRefusedIndex(indexWord(PRO_KIND_BRKS, 1), groupWord(group), 9103);
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 3), groupWord(9), 9103); // named twice
}

TEST(HostileIndex, TraversalsOfGroupsEnd) {
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 8 * PRO_GROUP_WORDS), groupWord(9), 9103); // a cycle with cell 1
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 9 * PRO_GROUP_WORDS), groupWord(9), 9104); // a cycle without cells
    expectRefusedIndex(indexWord(PRO_KIND_BRKS, 9 * PRO_GROUP_WORDS + 3), groupWord(8),
                       9103); // no cycle, but a group named twice
    EXPECT_EQ(openCopy(bytesOf(deepIndex(PRO_INDEX_HALVINGS_MAX))).result, PRO_OK);
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    Index deep = deepIndex(PRO_INDEX_HALVINGS_MAX + 1);
    const pro_view view = scene.view();
    const pro_index index = deep.view();
    pro_message message{};
    EXPECT_EQ(pro_write_indexed((folder.file("a.pro")).c_str(), &scene.info, &view, &index, &message),
              PRO_BAD_ARGUMENT);
    EXPECT_EQ(message.finding, 9104u);
}

TEST(HostileIndex, Cells) {
    const auto cell = [](std::size_t index, std::size_t field) {
        return indexWord(PRO_KIND_CELS, PRO_CELL_WORDS * index + field);
    };
    constexpr std::uint32_t kOne = 0x3C00u << PRO_CELL_CODES_SHIFT;
    expectRefusedIndex(cell(0, PRO_CELL_FIRST), 6u, 9109);
    expectRefusedIndex(cell(2, PRO_CELL_FIRST), 4u, 9109); // the last of three is out of range
    expectRefusedIndex(cell(1, PRO_CELL_FIRST), 0xFFFFFFFEu, 9109);
    expectRefusedIndex(cell(3, PRO_CELL_COUNT), kOne, 9109);
    expectRefusedIndex(cell(3, PRO_CELL_COUNT), kOne | 3, 9109);
    expectRefusedIndex(cell(3, PRO_CELL_COUNT), kOne | 0xFFFF, 9109);
    for (const std::uint32_t half : {0u, 0x7C00u, 0x7E00u, 0x8001u, 0xBC00u})
        expectRefusedIndex(cell(0, PRO_CELL_COUNT), half << PRO_CELL_CODES_SHIFT | 1, 9106);
    expectRefusedIndex(cell(0, PRO_CELL_BLENDING_COUNT), 0x80000000u, 9110);
}

TEST(HostileIndex, ListedSplats) {
    for (std::size_t i = 0; i < 6; ++i)
        for (const std::uint32_t splat : {5u, 0x80000000u, 0xFFFFFFFFu})
            expectRefusedIndex(indexWord(PRO_KIND_DSPL, i), splat, 9107);
}

/// Cell 1 has number 0 and cell 2 has numbers 2 and 3 of the four; they start at near
/// splats 1 and 2 of 6.
TEST(HostileIndex, BlendingSplats) {
    const auto cell = [](std::size_t index, std::size_t field) {
        return indexWord(PRO_KIND_CELS, PRO_CELL_WORDS * index + field);
    };
    constexpr std::uint32_t kOffset = 3u << PRO_CELL_OFFSET_SHIFT;
    expectRefusedIndex(cell(1, PRO_CELL_BLENDING), 1u, 9111);
    expectRefusedIndex(cell(1, PRO_CELL_BLENDING), 4u, 9111);
    expectRefusedIndex(cell(1, PRO_CELL_BLENDING), 0xFFFFFFFEu, 9111);
    expectRefusedIndex(cell(2, PRO_CELL_BLENDING_COUNT), kOffset | 3, 9111); // too many
    expectRefusedIndex(cell(2, PRO_CELL_BLENDING_COUNT), kOffset, 9111);     // numbers that belong to no cell
    expectRefusedIndex(cell(0, PRO_CELL_BLENDING_COUNT), kOffset | 0xFFFF, 9111);
    expectRefusedIndex(indexWord(PRO_KIND_BLDS, 0), 0xFFFEu, 9111); // 2 before cell 1's first, which is 1
    expectRefusedIndex(indexWord(PRO_KIND_BLDS, 0), 5u, 9111);
    expectRefusedIndex(indexWord(PRO_KIND_BLDS, 1), 0x8000FFFFu, 9111);
    expectRefusedIndex(indexWord(PRO_KIND_BLDS, 1), 0x00040000u, 9111);
}

TEST(HostileIndex, RandomDamageStaysInBounds) {
    std::mt19937 random(12);
    const std::uint32_t extremes[] = {0, 1, 16, 0x11111111, 0x7FFFFFFF, 0x80000000, 0xFFFFFFF0, 0xFFFFFFFF};
    const std::size_t first = sectionOf(indexed(), PRO_KIND_ENTR);
    int opened = 0;
    for (int round = 0; round < 20000; ++round) {
        Bytes bytes = indexed();
        for (unsigned changes = 1 + random() % 2; changes > 0; --changes) {
            const std::size_t kind = random() % 8, used = PRO_TABLE_OFFSET + 14 * PRO_SECTION_BYTES;
            const std::size_t start = kind < 7 ? sectionOf(indexed(), kKinds[kind]) : 0;
            const std::size_t offset = start + random() % (kind < 7 ? 320 : used) / 4 * 4;
            ASSERT_TRUE(start == 0 || start >= first);
            const auto value = random() % 2 ? extremes[random() % 8] : static_cast<std::uint32_t>(random() % 400);
            storeAt(bytes, offset, value);
        }
        fixHeaderChecksum(bytes);
        opened += openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | (round % 2 ? 0u : std::uint32_t{PRO_OPEN_TRACE})).result ==
                  PRO_OK;
    }
    EXPECT_GT(opened, 100) << "some damage must pass the first checks";
}

TEST(Index, TracersDoNotReadTheOctree) {
    Bytes bytes = indexed();
    for (const std::uint32_t kind : {PRO_KIND_NODE, PRO_KIND_LEAF, PRO_KIND_REFS, PRO_KIND_ORDR, PRO_KIND_META})
        storeAt(bytes, sectionOf(bytes, kind), 0xFFFFFFFFu);
    EXPECT_EQ(openCopy(bytes).result, PRO_INVALID);
    EXPECT_EQ(openCopy(bytes, PRO_OPEN_TRACE).result, PRO_OK) << "neither read nor checked";
    pro_file* file = nullptr;
    ASSERT_EQ(pro_open_memory(bytes.data(), bytes.size(), PRO_OPEN_TRACE, &file, nullptr), PRO_OK);
    pro_view view;
    pro_get_view(file, &view);
    EXPECT_EQ(view.nodes, nullptr);
    EXPECT_EQ(view.order, nullptr);
    EXPECT_EQ(view.metadata_bytes, 0u);
    EXPECT_NE(view.splats, nullptr);
    EXPECT_NE(view.materials, nullptr);
    pro_close(file);
    bytes[sectionOf(bytes, PRO_KIND_DSCS)] ^= std::byte{1};
    EXPECT_EQ(openCopy(bytes, PRO_OPEN_TRACE).message.finding, 2012u);
}

TEST(Index, FilesWithoutOneAreTracedFromTheirOctree) {
    const TemporaryFolder folder;
    tinyScene().write(folder.file("a.pro"));
    Bytes bytes = readBytes(folder.file("a.pro"));
    pro_file* file = nullptr;
    ASSERT_EQ(pro_open_memory(bytes.data(), bytes.size(), PRO_OPEN_TRACE, &file, nullptr), PRO_OK);
    pro_view view;
    pro_index index;
    pro_get_view(file, &view);
    EXPECT_EQ(pro_get_index(file, &index), 0);
    EXPECT_EQ(index.grid, nullptr);
    EXPECT_NE(view.nodes, nullptr);
    pro_close(file);
}

TEST(Index, SectionsAreNotRequired) {
    Bytes bytes = indexed();
    for (const std::uint32_t kind : kKinds) {
        EXPECT_EQ(loadAt(bytes, indexRecord(kind, PRO_SEC_OFF_FLAGS)), 0u) << "not required";
        storeAt(bytes, indexRecord(kind, PRO_SEC_OFF_KIND), 0x78787878u);
    }
    for (std::size_t offset = PRO_OFF_GRID_SHIFT; offset < PRO_FIELDS_END; offset += 4) storeAt(bytes, offset, 0u);
    fixHeaderChecksum(bytes);
    EXPECT_EQ(openCopy(bytes).result, PRO_OK);
}

} // namespace
