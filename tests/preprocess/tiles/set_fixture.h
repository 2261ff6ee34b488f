// SPDX-License-Identifier: Apache-2.0
// Small inputs of known points for the steps of baking a set.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "format/base/error.h"
#include "preprocess/cloud/split_mix.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/split.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {

/// The error message, which must be one line; "" and a test failure without an error.
template <typename Work>
std::string reasonOf(const Work& work, ExitCode code) {
    try {
        work();
    } catch (const Error& error) {
        const std::string reason = error.what();
        EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
        EXPECT_EQ(error.code, code) << reason;
        return reason;
    }
    ADD_FAILURE() << "no error was thrown";
    return "";
}

inline std::string bytesOf(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class SetTest : public testing::Test {
protected:
    /// A hill of points on [0, size) x [0, size), moved by an offset; each has a unique intensity.
    std::string writeHill(const std::string& name, std::size_t points, double offset = 0, double size = 100) const {
        std::string text = "x,y,z,intensity\n";
        for (std::size_t i = 0; i < points; ++i) {
            const double x = size * unitShare(mixBits(2 * i + 1)), y = size * unitShare(mixBits(2 * i + 2));
            text += fmt::format("{:.4f},{:.4f},{:.4f},{}\n", offset + x, y, 5 * std::sin(x / 9) * std::cos(y / 7),
                                i % 60'000);
        }
        return folder.write(name, text);
    }

    SetRequest requestOf(const std::vector<std::string>& inputs, std::uint64_t points_per_tile = 1000) const {
        SetRequest request;
        request.inputs = inputs;
        request.output = folder.file("SITE.proset");
        request.points_per_tile = points_per_tile;
        request.settings = R"({"tile-splats":1000})";
        return request;
    }

    /// Plan and buckets, in a separate folder.
    SetPlan splitInto(const std::string& name, SetRequest request, int threads = 0) const {
        std::optional<tbb::global_control> control;
        if (threads > 0) control.emplace(tbb::global_control::max_allowed_parallelism, threads);
        request.output = folder.file(name);
        SetPlan plan = makePlan(request);
        std::filesystem::create_directories(plan.work);
        writePlan(plan);
        splitPoints(plan, request);
        return plan;
    }

    /// All buckets of a plan by name.
    static std::map<std::string, std::string> bucketsOf(const SetPlan& plan) {
        std::map<std::string, std::string> buckets;
        for (const auto& entry : std::filesystem::directory_iterator(plan.work + "/buckets"))
            buckets[entry.path().filename().string()] = bytesOf(entry.path().string());
        return buckets;
    }

    test::TemporaryFolder folder;
};

} // namespace pointrt
