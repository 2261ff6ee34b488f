// SPDX-License-Identifier: Apache-2.0
// Pipelines that drivers compile are kept between runs. The layer reports how many pipelines its cache held when it was
// opened.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/gpu/program.h"
#include "shaders/scale_words.spv.h"
#include "tests/gpu/offline/pretended.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt::test {
namespace {

namespace fs = std::filesystem;

class PipelineCaches : public testing::Test {
protected:
    /// Opens a device of that type and builds programs. Returns the number of pipelines that its cache held before.
    std::uint64_t keptBefore(std::uint32_t programs, const char* type = "discrete") {
        auto variables = layered({{"POINTRT_LAYER_TYPE", type}, {"POINTRT_LAYER_PIPELINES", "1"}});
        variables["XDG_CACHE_HOME"] = folder.path.string();
        const Environment environment(variables);
        const Counts counts;
        ValidatedDevice validated;
        for (std::uint32_t factor = 0; factor < programs; ++factor) {
            Program program =
                createProgram(validated.device, "scale_words", scale_words_spv, {{gpu::SpecId{0}, factor}});
            destroyProgram(validated.device, program);
        }
        return counts.of("kept_pipelines");
    }

    /// The cache files, without those of Mesa, which has its cache in the same folder.
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        if (!fs::exists(ours())) return found;
        for (const auto& entry : fs::recursive_directory_iterator(ours()))
            if (entry.is_regular_file()) found.push_back(entry.path());
        return found;
    }
    fs::path ours() const { return folder.path / "pointrt"; }

    /// Changes a byte of the only file; offset: from its start, or from its end if negative.
    void damage(std::streamoff offset) const {
        std::fstream stream(files().at(0), std::ios::in | std::ios::out | std::ios::binary);
        const auto from = offset < 0 ? std::ios::end : std::ios::beg;
        stream.seekg(offset, from);
        const char changed = static_cast<char>(stream.get() ^ 1);
        stream.seekp(offset, from);
        stream.put(changed);
    }

    TemporaryFolder folder;
};

TEST_F(PipelineCaches, KeepWhatWasCompiled) {
    EXPECT_EQ(keptBefore(3), 0u);
    EXPECT_EQ(files().size(), 1u);
    EXPECT_EQ(keptBefore(2), 3u);
    EXPECT_EQ(keptBefore(0), 5u);
}

TEST_F(PipelineCaches, StayAsTheyAreIfNothingIsNew) {
    keptBefore(3);
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(files().at(0), old);
    keptBefore(0);
    EXPECT_EQ(fs::last_write_time(files().at(0)), old);
}

TEST_F(PipelineCaches, ThatAreDamagedOrForeign_AreIgnoredAndReplaced) {
    constexpr std::streamoff kDriverVersion = 16, kUuid = 24; // in FileHeader
    for (const std::streamoff offset : {std::streamoff{0}, kDriverVersion, kUuid, std::streamoff{-1}}) {
        SCOPED_TRACE(offset);
        fs::remove_all(ours());
        keptBefore(3);
        damage(offset);
        EXPECT_EQ(keptBefore(2), 0u);
        EXPECT_EQ(keptBefore(0), 2u);
    }
    for (const std::uintmax_t bytes : {0u, 20u, 70u}) { // the header has 56
        SCOPED_TRACE(bytes);
        fs::remove_all(ours());
        keptBefore(3);
        fs::resize_file(files().at(0), bytes);
        EXPECT_EQ(keptBefore(0), 0u);
    }
}

TEST_F(PipelineCaches, ThatCannotBeWritten_AreDoneWithout) {
    std::ofstream(ours()) << "a file in the folder's place";
    EXPECT_EQ(keptBefore(1), 0u);
    EXPECT_EQ(keptBefore(1), 0u);
}

/// Mesa's driver for CPUs has a cache of its own.
TEST_F(PipelineCaches, AreNotForCpus) {
    keptBefore(3, "");
    EXPECT_TRUE(files().empty());
}

} // namespace
} // namespace pointrt::test
