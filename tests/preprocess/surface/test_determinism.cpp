// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <thread>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

/// A noisy sphere with an outlier, normals on some points and a sensor for others: every stage has work.
Cloud mixedCloud(std::size_t count) {
    Shape shape = randomSphere(count);
    Random random(9);
    for (Vec3f& p : shape.positions) p *= float(1 + 0.01 * uniform(random));
    shape.add(Vec3d(9, 9, 9), Vec3d::UnitZ());
    Cloud cloud = shape.cloud();
    cloud.sensors = {Vec3f(0, 0, 10)};
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        cloud.normals.push_back(i % 50 == 0 ? shape.normals[i] : Vec3f(0, 0, 0));
        cloud.sensor_of_point.push_back(cloud.positions[i].z() > 0.7f ? 0 : kNoSensor);
    }
    return cloud;
}

Splats estimateWithThreads(const Cloud& cloud, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return estimate(cloud);
}

void expectSame(const Splats& a, const Splats& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.radii, b.radii);
    EXPECT_EQ(a.input_index, b.input_index);
}

TEST(Determinism, OneAndTwoThreadsAgree) {
    const Cloud cloud = mixedCloud(30'000);
    expectSame(estimateWithThreads(cloud, 1), estimateWithThreads(cloud, 2));
}

TEST(Determinism, LargeCloudsToo) { // which are oriented by another algorithm
    const Cloud cloud = mixedCloud(120'000);
    expectSame(estimateWithThreads(cloud, 1), estimateWithThreads(cloud, 2));
}

TEST(Progress, GrowsToOneInEachStageOnTheCallingThread) {
    std::vector<std::pair<std::string, double>> calls;
    const auto caller = std::this_thread::get_id();
    SurfaceReport report;
    estimateSplats(randomSphere(50'000).cloud(), {}, report, [&](const char* stage, double share) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        calls.emplace_back(stage, share);
    });
    std::vector<std::string> finished;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        const bool last = i + 1 == calls.size() || calls[i + 1].first != calls[i].first;
        if (last) {
            finished.push_back(calls[i].first);
            EXPECT_NEAR(calls[i].second, 1, 1e-9) << calls[i].first;
        } else {
            EXPECT_LE(calls[i].second, calls[i + 1].second) << calls[i].first;
        }
    }
    EXPECT_EQ(finished, (std::vector<std::string>{"neighbors", "normals", "orientation", "radii"}));
    EXPECT_LT(calls.size(), 1000u);
}

} // namespace
} // namespace pointrt::test
