// SPDX-License-Identifier: Apache-2.0
// Parallel loops.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace pointrt {

/// Calls work(k) for k in [0, count) in any order; rethrows the first exception. If starting a thread fails, the
/// threads already running do all the work.
/// @param threads maximum number, including this one; 0: one per core
template <typename Work>
void forAll(std::size_t count, const Work& work, std::size_t threads = 0) {
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
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> others(std::max<std::size_t>(1, std::min(count, threads)) - 1);
    try {
        for (auto& thread : others) thread = std::jthread(loop);
    } catch (const std::system_error&) {
    }
    loop();
    others.clear();
    if (failure) std::rethrow_exception(failure);
}

} // namespace pointrt
