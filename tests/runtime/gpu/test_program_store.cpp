// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/program_store.h"

#include <gtest/gtest.h>

#include "shaders/scale_words.spv.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

constexpr gpu::SpecId kProgramStoreFactor{0};

class ProgramStoreTest : public DeviceFixture {
protected:
    Program build(std::uint32_t factor) {
        return createProgram(device, "scale_words", scale_words_spv, {{kProgramStoreFactor, factor}});
    }
    void buildAndGiveBack(std::uint32_t factor) {
        Program program = build(factor);
        destroyProgram(device, program);
        EXPECT_EQ(program.pipeline, nullptr);
    }
};

TEST_F(ProgramStoreTest, EqualPrograms_AreShared) {
    Program first = build(3), second = build(3), other = build(4);
    EXPECT_EQ(first.pipeline, second.pipeline);
    EXPECT_NE(first.pipeline, other.pipeline);
    EXPECT_EQ(device.programs->size(), 2u);
    for (Program* program : {&first, &second, &other}) destroyProgram(device, *program);
}

TEST_F(ProgramStoreTest, UndeclaredConstants_AreIgnored) {
    Program first = build(3);
    Program second =
        createProgram(device, "scale_words", scale_words_spv, {{gpu::SpecId{7}, 1}, {kProgramStoreFactor, 3}});
    EXPECT_EQ(first.pipeline, second.pipeline);
    destroyProgram(device, first);
    destroyProgram(device, second);
}

TEST_F(ProgramStoreTest, UnusedPrograms_AreKeptUpToALimit) {
    Program used = build(0);
    const VkPipeline pipeline = used.pipeline;
    for (std::uint32_t factor = 1; factor <= ProgramStore::kUnusedKept; ++factor) buildAndGiveBack(factor);
    EXPECT_EQ(device.programs->size(), ProgramStore::kUnusedKept + 1);
    buildAndGiveBack(1); // 2 is now the oldest
    buildAndGiveBack(ProgramStore::kUnusedKept + 1);
    EXPECT_EQ(device.programs->size(), ProgramStore::kUnusedKept + 1);
    Program again = build(0), kept = build(1);
    EXPECT_EQ(again.pipeline, pipeline) << "a program in use stays";
    EXPECT_EQ(device.programs->size(), ProgramStore::kUnusedKept + 1) << "1 was kept";
    Program gone = build(2);
    EXPECT_EQ(device.programs->size(), ProgramStore::kUnusedKept + 2) << "2 was freed";
    for (Program* program : {&used, &again, &kept, &gone}) destroyProgram(device, *program);
}

TEST_F(ProgramStoreTest, Workers_ShareIt) {
    Device worker = workerDevice(device);
    Program first = build(3),
            second = createProgram(worker, "scale_words", scale_words_spv, {{kProgramStoreFactor, 3}});
    EXPECT_EQ(first.pipeline, second.pipeline);
    destroyProgram(worker, first);
    destroyProgram(device, second);
    destroyWorkerDevice(worker);
}

} // namespace
} // namespace pointrt
