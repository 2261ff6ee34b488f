// SPDX-License-Identifier: Apache-2.0
#include "format/base/require_pro.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "format/base/error.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tiny_scene.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

struct RequirePro : testing::Test {
    TemporaryFolder folder;

    /// The error for path without the name of the folder; "" if there is none.
    std::string refusal(const std::string& path, const std::string& aside = "") {
        try {
            requirePro(path, aside);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            std::string text = error.what();
            const std::string prefix = folder.file("");
            for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
            return text;
        }
        return "";
    }
    std::string refusalOf(const std::string& name, const std::string& content) {
        return refusal(folder.write(name, content));
    }
};

TEST_F(RequirePro, NamesTheKindAndTheBakeCommand) {
    EXPECT_SAYS(refusalOf("a.ply", "ply\nformat ascii 1.0\n"), "a.ply: *PLY; *pointrt-bake a.ply -o a.pro");
    EXPECT_SAYS(refusal(folder.file("a.ply"), ", as the window does"),
                "a.ply: *PLY; *, as the window does: pointrt-bake a.ply -o a.pro");
    EXPECT_SAYS(refusalOf("b.las", "LASF????????"), "b.las: *LAS or LAZ; *pointrt-bake b.las -o b.pro");
    EXPECT_SAYS(refusalOf("c.XYZ", "1 2 3\n"), "c.XYZ: *text; *pointrt-bake c.XYZ -o c.pro");
    EXPECT_SAYS(refusalOf("d.ply.gz", "\x1f\x8b..."), "d.ply.gz: *gzip; *pointrt-bake d.ply.gz -o d.pro");
    EXPECT_SAYS(refusalOf("e", "something else"), "e: *if it is a scan*pointrt-bake e -o e.pro");
    EXPECT_SAYS(refusalOf("f.pro", "ply\nformat"), "f.pro: *PLY; *pointrt-bake f.pro -o SCENE.pro");
}

TEST_F(RequirePro, NamesKindsThatCannotBeBaked) {
    EXPECT_SAYS(refusalOf("a.png", "\x89PNG\r\n"), "a.png: *PNG");
    EXPECT_SAYS(refusalOf("a.toml", "[camera]"), "a.toml: *scene file*pointrt-view");
    EXPECT_SAYS(refusal(folder.path.string()), folder.path.string() + ": *folder");
}

TEST_F(RequirePro, QuotesForTheShell) {
    EXPECT_NE(refusalOf("a b$(x).ply", "ply\n").find("pointrt-bake 'a b$(x).ply' -o 'a b$(x).pro'"), std::string::npos);
    EXPECT_NE(refusalOf("it's.ply", "ply\n").find("pointrt-bake SCAN -o SCENE.pro"), std::string::npos);
    EXPECT_NE(refusalOf("a\nb.ply", "ply\n").find("pointrt-bake SCAN -o SCENE.pro"), std::string::npos);
}

TEST_F(RequirePro, NamesTheProBesideAScan) {
    tinyScene().write(folder.file("a.pro"));
    EXPECT_SAYS(refusalOf("a.ply", "ply\n"), "a.ply: *PLY; *a.pro?");
}

TEST_F(RequirePro, LeavesOtherErrorsToTheReader) {
    tinyScene().write(folder.file("a.pro"));
    std::filesystem::copy(folder.file("a.pro"), folder.file("of.any.name"));
    EXPECT_EQ(refusal(folder.file("a.pro")), "");
    EXPECT_EQ(refusal(folder.file("of.any.name")), "");
    EXPECT_EQ(refusalOf("broken.pro", "neither this nor that"), "");
    EXPECT_EQ(refusalOf("empty.pro", ""), "");
    EXPECT_EQ(refusal(folder.file("missing.ply")), "");
    ASSERT_EQ(mkfifo(folder.file("pipe.ply").c_str(), 0600), 0);
    EXPECT_EQ(refusal(folder.file("pipe.ply")), "") << "and does not wait for a writer";
}

} // namespace
