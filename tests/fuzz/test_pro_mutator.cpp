// SPDX-License-Identifier: Apache-2.0
// Enough mutants of .pro files pass the header.
#include <gtest/gtest.h>

#include "tests/format/file_bytes.h"
#include "tests/fuzz/header_share.h"
#include "tests/fuzz/pro_mutator.h"

namespace pointrt {
namespace {

std::vector<std::uint8_t> goldenFile(const char* name) {
    const test::Bytes bytes = test::readBytes(std::string(POINTRT_GOLDEN_DIR) + "/" + name);
    const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return {first, first + bytes.size()};
}

TEST(ProMutator, MostMutantsPassTheHeader) {
    std::mt19937 random(7);
    const fuzz::ChangeBytes flip = [&](std::uint8_t* data, std::size_t size, std::size_t) {
        if (size > 0) data[random() % size] ^= static_cast<std::uint8_t>(1 + random() % 255);
        return size;
    };
    int passed = 0, opened = 0;
    constexpr int kMutants = 3000;
    for (const char* name : {"tiny_compact.pro", "tiny_compact_scan.pro", "tiny_v1_4.pro", "tiny_v1_4_scan.pro",
                             "tiny_v1_5.pro", "exact_gaussians.pro"}) {
        std::vector<std::uint8_t> file = goldenFile(name);
        for (int i = 0; i < kMutants / 6; ++i) {
            const std::vector<std::uint8_t> mutant = fuzz::mutatePro(file, 1 << 18, random, flip);
            const auto* const first = reinterpret_cast<const std::byte*>(mutant.data());
            const test::OpenResult result = test::openCopy({first, first + mutant.size()});
            passed += fuzz::passedHeader(result.result, result.message.finding);
            opened += result.result == PRO_OK;
        }
    }
    EXPECT_GT(passed, kMutants / 3);
    EXPECT_GT(opened, kMutants / 20) << "some changes are allowed ones";
    RecordProperty("passed", passed);
    RecordProperty("opened", opened);
}

} // namespace
} // namespace pointrt
