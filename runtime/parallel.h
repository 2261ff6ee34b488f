// SPDX-License-Identifier: Apache-2.0
// Work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace pointrt {

/// Runs work(k) for k in [0, count), in any order; rethrows the first exception.
template <typename Work>
void forAll(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr failure;
    const auto loop = [&] {
        try {
            for (std::size_t k = next++; k < count && !failed; k = next++) work(k);
        } catch (...) {
            if (!failed.exchange(true)) failure = std::current_exception();
        }
    };
    std::vector<std::jthread> threads(std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency())));
    for (auto& thread : threads) thread = std::jthread(loop);
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

} // namespace pointrt
