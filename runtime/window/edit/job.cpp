// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/job.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace pointrt {
namespace {

// Earlier, start-up time would dominate the estimate.
constexpr double kMinSeconds = 0.5, kMinShare = 0.02;

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

} // namespace

void JobControl::setDetail(const std::string& detail) {
    const std::lock_guard lock(mutex_);
    detail_ = detail;
}

void JobControl::setProgress(double done) {
    const std::lock_guard lock(mutex_);
    if (!(done > progress_.value_or(-1))) return;
    progress_ = std::clamp(done, 0.0, 1.0);
    progress_time_ = Clock::now();
}

void JobControl::throwIfCancelled() const {
    if (cancelled()) throw JobCancelled{};
}

Job::Job(std::string title, Work work, bool can_cancel) : title_(std::move(title)), can_cancel_(can_cancel) {
    // holds the thread back until stop_ is set
    const std::lock_guard lock(control_.mutex_);
    thread_ = std::jthread([this, body = std::move(work)] { run(body); });
    control_.stop_ = thread_.get_stop_token();
}

void Job::run(const Work& work) {
    { const std::lock_guard wait(control_.mutex_); }
    try {
        work(control_);
        end(JobState::kDone);
    } catch (const JobCancelled&) {
        end(JobState::kCancelled);
    } catch (const Error& error) {
        end(JobState::kFailed, error.what(), error.code, std::current_exception());
    } catch (const std::bad_alloc&) {
        end(JobState::kFailed, "out of memory");
    } catch (const std::exception& error) {
        end(JobState::kFailed, error.what());
    } catch (...) {
        end(JobState::kFailed, "unknown error");
    }
}

void Job::end(JobState state, const std::string& error, ExitCode code, std::exception_ptr thrown) {
    const std::lock_guard lock(control_.mutex_);
    control_.thrown_ = std::move(thrown);
    control_.error_ = error;
    control_.code_ = code;
    control_.state_ = state;
}

JobState Job::state() const {
    const std::lock_guard lock(control_.mutex_);
    return control_.state_;
}

std::string Job::error() const {
    const std::lock_guard lock(control_.mutex_);
    return control_.error_;
}

ExitCode Job::errorCode() const {
    const std::lock_guard lock(control_.mutex_);
    return control_.code_;
}

std::exception_ptr Job::thrown() const {
    const std::lock_guard lock(control_.mutex_);
    return control_.thrown_;
}

JobStatus Job::status() const {
    const std::lock_guard lock(control_.mutex_);
    JobStatus status;
    status.title = title_;
    status.detail = control_.stop_.stop_requested() ? "cancelling" : control_.detail_;
    status.progress = control_.progress_;
    status.can_cancel = can_cancel_ && !control_.stop_.stop_requested();
    if (control_.progress_)
        status.seconds_left = secondsLeft(*control_.progress_, seconds(control_.progress_time_ - control_.start_),
                                          seconds(JobControl::Clock::now() - control_.start_));
    return status;
}

void throwIfFailed(const Job& job) {
    if (job.state() != JobState::kFailed) return;
    if (const std::exception_ptr thrown = job.thrown()) std::rethrow_exception(thrown);
    throw Error{job.errorCode(), job.error()};
}

std::optional<double> secondsLeft(double share, double reported_s, double now_s) {
    if (now_s < kMinSeconds || share < kMinShare || !(reported_s > 0)) return std::nullopt;
    return std::max(0.0, reported_s * (1 - share) / share - (now_s - reported_s));
}

} // namespace pointrt
