// SPDX-License-Identifier: Apache-2.0
// Long tasks on their own threads, while the window stays responsive.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "format/base/error.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Thrown by work to end a cancelled job.
struct JobCancelled {};

enum class JobState { kRunning, kDone, kFailed, kCancelled };

/// Used by the work, on its thread, to report progress and to check for cancellation.
class JobControl {
public:
    /// detail: stage or count; may be empty.
    void setDetail(const std::string& detail);
    /// done: 0 to 1. Never decreases: smaller values are ignored.
    void setProgress(double done);
    bool cancelled() const { return stop_.stop_requested(); }
    /// Throws JobCancelled if the user has cancelled the job.
    void throwIfCancelled() const;

private:
    friend class Job;
    using Clock = std::chrono::steady_clock;

    mutable std::mutex mutex_; ///< guards everything below except stop_
    std::string detail_, error_;
    std::optional<double> progress_;
    Clock::time_point start_ = Clock::now(), progress_time_;
    std::exception_ptr thrown_; ///< an Error that the work failed with
    ExitCode code_ = ExitCode::kDone;
    JobState state_ = JobState::kRunning;
    std::stop_token stop_;
};

/// A running or finished job. Catches all exceptions of its work.
class Job {
public:
    using Work = std::function<void(JobControl&)>;

    /// Starts work. title: "Baking statue.ply". Work fails by throwing; the text of an Error becomes the job's error.
    Job(std::string title, Work work, bool can_cancel = true);
    /// Cancels the work and waits for it to end.
    ~Job() = default;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Requests cancellation; the work ends at its next check.
    void cancel() { thread_.request_stop(); }
    JobState state() const;
    bool ended() const { return state() != JobState::kRunning; }
    /// Why the job failed; empty if it did not.
    std::string error() const;
    /// The exit code for error().
    ExitCode errorCode() const;
    /// The exception that ended the job, with its original type; null if the job did not fail.
    std::exception_ptr thrown() const;
    JobStatus status() const;

private:
    void run(const Work& work);
    void end(JobState state, const std::string& error = {}, ExitCode code = ExitCode::kCannotRun,
             std::exception_ptr thrown = {});

    const std::string title_;
    const bool can_cancel_;
    JobControl control_;
    std::jthread thread_; ///< declared last, so that it ends before the others are destroyed
};

/// Throws the job's error if it failed.
void throwIfFailed(const Job& job);

/// Estimated seconds left at now_s, if share was done at reported_s and the speed stays the same; both in seconds since
/// the start. nullopt while it is too early for an estimate.
std::optional<double> secondsLeft(double share, double reported_s, double now_s);

} // namespace pointrt
