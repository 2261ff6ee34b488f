// SPDX-License-Identifier: Apache-2.0
// Work that takes long, on a thread of its own, while the window goes on.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "format/base/error.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Thrown out of work that is cancelled.
struct JobCancelled {};

enum class JobState { kRunning, kDone, kFailed, kCancelled };

/// What work says of itself, from its thread.
class JobControl {
public:
    /// detail: stage or count, may be empty.
    void setDetail(const std::string& detail);
    /// done: 0 to 1. It never goes back: less than before changes nothing.
    void setProgress(double done);
    bool cancelled() const { return stop_.stop_requested(); }
    /// Throws JobCancelled where the user has had enough.
    void throwIfCancelled() const;

private:
    friend class Job;
    using Clock = std::chrono::steady_clock;

    mutable std::mutex mutex_; ///< guards all below but stop_
    std::string detail_, error_;
    std::optional<double> progress_;
    Clock::time_point start_ = Clock::now(), progress_time_;
    ExitCode code_ = ExitCode::kDone;
    JobState state_ = JobState::kRunning;
    std::stop_token stop_;
};

/// A piece of work under way. Nothing that it throws leaves its thread.
class Job {
public:
    using Work = std::function<void(JobControl&)>;

    /// Starts work. what: "Baking statue.ply". Work that fails throws; where it throws Error, that is its reason.
    Job(std::string title, Work work, bool can_cancel = true);
    /// Cancels, and waits until the work has noticed.
    ~Job() = default;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Asks the work to end; it does when it next looks.
    void cancel() { thread_.request_stop(); }
    JobState state() const;
    bool ended() const { return state() != JobState::kRunning; }
    /// Why it failed; empty unless it did.
    std::string error() const;
    /// What a program that ends with that error says.
    ExitCode errorCode() const;
    JobStatus status() const;

private:
    void run(const Work& work);
    void end(JobState state, const std::string& error = {}, ExitCode code = ExitCode::kCannotRun);

    const std::string title_;
    const bool can_cancel_;
    JobControl control_;
    std::jthread thread_; ///< last: the others outlive it
};

/// Throws its error where it failed.
void throwIfFailed(const Job& job);

/// What is left at now_s of work of which share was done at said_s, if it goes on as it did; seconds since its start.
/// Nothing while that would be a mere guess.
std::optional<double> secondsLeft(double share, double said_s, double now_s);

} // namespace pointrt
