// SPDX-License-Identifier: Apache-2.0
// Runs pointrt-rays in a folder with a plane to cast rays at.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/runtime/rays/array_file.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {

struct Outcome {
    int code = 0;
    std::string out, err;
};

/// plane.pro is a plane at z = 164 over (500000, 4500000), 102 m square around its cube's middle.
class CastCommand : public testing::Test {
protected:
    CastCommand() { writeScan(folder.file("plane.pro"), planeSplats(20, 0.5f), {}); }

    std::string text(const std::string& name) const {
        std::ifstream file(folder.file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    /// Runs shell words in the folder.
    Outcome run(const std::string& words) const {
        const std::string command = "cd '" + folder.path.string() + "' && " + words + " >.out 2>.err";
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), text(".out"), text(".err")};
    }
    Outcome cast(const std::string& words) const { return run(POINTRT_RAYS " cast plane.pro " + words); }

    /// Expects this exit code, a single error line that says reason (says.h), no new files and an unchanged out.npz.
    void expectRefused(int code, const std::string& reason, const std::string& words) const {
        folder.write("out.npz", "precious");
        const std::size_t before = folder.entries();
        const Outcome result = run(words);
        EXPECT_EQ(result.code, code) << words;
        EXPECT_SAYS(result.err, "pointrt-rays: error: " + reason + "\n") << words;
        EXPECT_EQ(result.out, "") << words;
        EXPECT_EQ(text("out.npz"), "precious") << words;
        EXPECT_LE(folder.entries(), before + 2) << words; // .out and .err
    }

    TemporaryFolder folder;
};

/// One ray straight down onto the plane from 36 m above, with a direction of length 2, and one miss.
inline const std::vector<double> kTwoRays{500064, 4500064, 200, 0, 0, -2, 500064, 4500064, 200, 0, 0, 1};

} // namespace pointrt::test
