// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/tile_scheduler.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pointrt {
namespace {

/// Largest number of threads that worked at once with a budget of 100 points, of which each reserves some.
int mostAtOnce(std::uint64_t points) {
    PointBudget budget(100);
    std::atomic<int> inside{0}, most{0};
    std::vector<std::jthread> threads;
    for (int i = 0; i < 6; ++i)
        threads.emplace_back([&] {
            for (int round = 0; round < 20; ++round) {
                const PointBudget::Reservation reservation = budget.reserve(points);
                const int now = ++inside;
                for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
                }
                std::this_thread::sleep_for(std::chrono::microseconds(100));
                --inside;
            }
        });
    threads.clear();
    return most;
}

TEST(PointBudget, HoldsAsManyAsFit) {
    EXPECT_LE(mostAtOnce(30), 3);
    EXPECT_GE(mostAtOnce(30), 2) << "of six threads with 20 reservations each";
    EXPECT_EQ(mostAtOnce(51), 1);
}

TEST(PointBudget, ARequestAboveTheBudgetRunsAlone) { EXPECT_EQ(mostAtOnce(1000), 1); }

TEST(ForTiles, RunsEachOnceAndReportsFromTheCaller) {
    std::vector<std::atomic<int>> times(50);
    const std::thread::id caller = std::this_thread::get_id();
    double share = 0;
    forTiles(
        times.size(), 4, "tiles",
        [&](const char* stage, double now) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_STREQ(stage, "tiles");
            EXPECT_GE(now, share);
            share = now;
        },
        [&](std::size_t k) { ++times[k]; });
    EXPECT_EQ(share, 1);
    for (const auto& each : times) EXPECT_EQ(each, 1);
}

TEST(ForTiles, OneThreadMeansOneTileAtATime) {
    int inside = 0;
    forTiles(20, 1, "tiles", {}, [&](std::size_t) {
        EXPECT_EQ(++inside, 1);
        --inside;
    });
}

TEST(ForTiles, RethrowsTheExceptionOfATile) {
    EXPECT_THROW(forTiles(10, 4, "tiles", {},
                          [](std::size_t k) {
                              if (k == 3) throw std::runtime_error("of tile 3");
                          }),
                 std::runtime_error);
}

} // namespace
} // namespace pointrt
