// SPDX-License-Identifier: Apache-2.0
#include "format/base/near_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using pointrt::nearestName;

const std::vector<std::string_view> kNames = {"output", "force", "threads", "orient", "outliers", "seed", "spp"};

TEST(NearName, FindsMistypedNames) {
    EXPECT_EQ(nearestName("otuput", kNames), "output") << "two letters swapped";
    EXPECT_EQ(nearestName("ouput", kNames), "output");
    EXPECT_EQ(nearestName("outputs", kNames), "output");
    EXPECT_EQ(nearestName("theads", kNames), "threads");
    EXPECT_EQ(nearestName("outlier", kNames), "outliers");
    EXPECT_EQ(nearestName("sead", kNames), "seed");
    EXPECT_EQ(nearestName("seed", kNames), "seed");
}

TEST(NearName, CompletesPrefixes) {
    EXPECT_EQ(nearestName("thr", kNames), "threads");
    EXPECT_EQ(nearestName("ou", kNames), "output") << "the first of two";
}

TEST(NearName, RejectsDistantNames) {
    EXPECT_EQ(nearestName("frobnicate", kNames), "");
    EXPECT_EQ(nearestName("x", kNames), "");
    EXPECT_EQ(nearestName("o", kNames), "") << "a single letter is ambiguous";
    EXPECT_EQ(nearestName("", kNames), "");
    EXPECT_EQ(nearestName("seed", {}), "");
    EXPECT_EQ(nearestName(std::string(100000, 'o'), kNames), "") << "without a long computation";
}

} // namespace
