// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops that report progress from the calling thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "preprocess/cloud/stage_progress.h"

namespace pointrt::surface {

/// A stage and the part [from, to] of it that one loop covers.
struct StageShare {
    const StageProgress& progress;
    const char* stage;
    double from = 0, to = 1;

    void report(double share) const {
        if (progress) progress(stage, from + (to - from) * share);
    }
};

/// Calls body(begin, end) over ranges that cover [0, count), on all threads.
/// Reports about 40 times: often enough for a progress line, rarely enough that joining the threads costs no time.
template <typename Body>
void forRanges(std::size_t count, const StageShare& share, const Body& body) {
    constexpr std::size_t kReports = 40, kSmallestBlock = 8192, kGrain = 256;
    const std::size_t block = std::max(kSmallestBlock, (count + kReports - 1) / kReports);
    for (std::size_t begin = 0; begin < count; begin += block) {
        const std::size_t end = std::min(count, begin + block);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, kGrain),
                          [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
        share.report(double(end) / double(count));
    }
}

/// As forRanges, with body(index).
template <typename Body>
void forEach(std::size_t count, const StageShare& share, const Body& body) {
    forRanges(count, share, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

/// Adds the seconds of its lifetime to a sum.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace pointrt::surface
