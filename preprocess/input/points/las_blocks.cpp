// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/las_blocks.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

/// Most bytes of records in one block, and in all blocks in flight together. The arrays that records are decoded to are
/// about twice as large as the records: with them and the program itself, reading takes less than 64 MiB.
constexpr std::size_t kMostRecordBytes = std::size_t{8} << 20, kMostUnderWay = std::size_t{12} << 20;
constexpr std::size_t kBlockPoints = std::size_t{1} << 16;

/// A block in the pipeline.
struct Job {
    std::optional<LazChunk> chunk; ///< a whole chunk that is still compressed, if any
    const char* records = nullptr; ///< uncompressed records, in the file or in `unpacked`; null before unpacking
    std::vector<char> unpacked;
    std::size_t points = 0;
    LasBlock block;
    std::exception_ptr failure; ///< rethrown in file order, so that the first error is reported
};
using JobPointer = std::shared_ptr<Job>;

/// Divides the chunks into jobs. Unpacks chunks here, piece by piece, if they are too large for a block or their size
/// is not known.
class Jobs {
public:
    explicit Jobs(const LasPlan& plan) : plan_(plan), record_bytes_(plan.file.header.record_bytes) {}

    /// The next job; null at the end.
    JobPointer next() {
        while (chunk_ < plan_.chunks.size() && done_ == plan_.chunks[chunk_].points) {
            ++chunk_;
            done_ = 0;
            stream_.reset();
        }
        if (failed_ || chunk_ == plan_.chunks.size()) return nullptr;
        JobPointer job = idleJob();
        const LazChunk& chunk = plan_.chunks[chunk_];
        const bool whole =
            plan_.file.header.packed && !plan_.layout.in_one_run && chunk.points <= kMostRecordBytes / record_bytes_;
        const std::uint64_t most = std::min<std::uint64_t>(kBlockPoints, kMostRecordBytes / record_bytes_);
        job->points = whole ? chunk.points : std::min(most, chunk.points - done_);
        if (whole)
            takeChunk(chunk, *job);
        else
            takePiece(chunk, *job);
        done_ += job->points;
        return job;
    }

    /// Returns a job, whose memory is reused.
    void release(const JobPointer& job) {
        const std::lock_guard guard(mutex_);
        idle_.push_back(job);
    }

private:
    JobPointer idleJob() {
        const std::lock_guard guard(mutex_);
        if (idle_.empty()) return std::make_shared<Job>();
        JobPointer job = std::move(idle_.back());
        idle_.pop_back();
        job->chunk.reset();
        job->records = nullptr;
        job->block.done_bytes = 0;
        return job;
    }

    static void takeChunk(const LazChunk& chunk, Job& job) {
        job.chunk = chunk;
        job.block.done_bytes = chunk.at + chunk.bytes;
    }

    void takePiece(const LazChunk& chunk, Job& job) {
        if (!plan_.file.header.packed) {
            const std::uint64_t at = chunk.at + done_ * record_bytes_;
            job.records = plan_.file.bytes.data() + at;
            job.block.done_bytes = at + job.points * record_bytes_;
            return;
        }
        try {
            if (!stream_) stream_ = std::make_unique<LazStream>(plan_.layout, plan_.file.bytes, chunk);
            job.unpacked.resize(job.points * record_bytes_);
            stream_->read(job.unpacked.data(), job.points);
            job.records = job.unpacked.data();
        } catch (...) {
            job.failure = std::current_exception();
            failed_ = true;
        }
    }

    const LasPlan& plan_;
    const std::size_t record_bytes_;
    std::size_t chunk_ = 0;
    std::uint64_t done_ = 0; ///< points of the current chunk
    bool failed_ = false;
    std::unique_ptr<LazStream> stream_;
    std::mutex mutex_;
    std::vector<JobPointer> idle_;
};

void unpackChunk(const LasPlan& plan, Job& job) {
    job.unpacked.resize(job.points * plan.file.header.record_bytes);
    LazStream(plan.layout, plan.file.bytes, *job.chunk).read(job.unpacked.data(), job.points);
    job.records = job.unpacked.data();
}

/// Decodes the points [first, first + count) into the arrays.
void toArrays(const LasPlan& plan, std::size_t first, std::size_t count, Job& job) {
    const LasHeader& header = plan.file.header;
    for (std::size_t i = first; i < first + count; ++i) {
        std::int32_t whole[3];
        std::memcpy(whole, job.records + i * header.record_bytes, sizeof whole);
        for (int axis = 0; axis < 3; ++axis)
            job.block.positions[i][axis] =
                header.scale[std::size_t(axis)] * whole[axis] + header.offset[std::size_t(axis)];
    }
    for (std::size_t f = 0; f < plan.fields.size(); ++f) {
        const LasField& field = plan.fields[f];
        unpackField(field, job.records + first * header.record_bytes, header.record_bytes, count,
                    job.block.values[f].data() + first * fieldBytes(field));
    }
}

/// Decodes a few points at a time, so that their records stay in the cache from field to field.
void toArrays(const LasPlan& plan, Job& job) {
    constexpr std::size_t kAtOnce = 2048; // records of about 30 bytes: with their arrays they fit in a core's own cache
    job.block.positions.resize(job.points);
    job.block.values.resize(plan.fields.size());
    for (std::size_t f = 0; f < plan.fields.size(); ++f)
        job.block.values[f].resize(job.points * fieldBytes(plan.fields[f]));
    for (std::size_t first = 0; first < job.points; first += kAtOnce)
        toArrays(plan, first, std::min(kAtOnce, job.points - first), job);
}

void prepare(const LasPlan& plan, Job& job) {
    if (job.failure) return;
    try {
        if (job.chunk) unpackChunk(plan, job);
        toArrays(plan, job);
    } catch (...) {
        job.failure = std::current_exception();
    }
}

std::size_t jobsAtOnce(const LasPlan& plan) {
    std::uint64_t largest = std::min<std::uint64_t>(kBlockPoints, plan.file.header.point_count);
    for (const LazChunk& chunk : plan.chunks)
        if (chunk.points * plan.file.header.record_bytes <= kMostRecordBytes) largest = std::max(largest, chunk.points);
    const std::uint64_t bytes = std::max<std::uint64_t>(1, largest * plan.file.header.record_bytes);
    const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
    return std::clamp<std::uint64_t>(kMostUnderWay / bytes, 2, 2 * threads);
}

} // namespace

void decodeRecords(const LasPlan& plan, const std::vector<char>& records, LasBlock& block) {
    Job job;
    job.records = records.data();
    job.points = records.size() / plan.file.header.record_bytes;
    job.block = std::move(block);
    toArrays(plan, job);
    block = std::move(job.block);
}

void forLasBlocks(const LasPlan& plan, const std::function<void(const LasBlock&)>& use) {
    Jobs jobs(plan);
    const auto cutJobs = [&](tbb::flow_control& control) {
        JobPointer job = jobs.next();
        if (!job) control.stop();
        return job;
    };
    const auto unpack = [&](JobPointer job) {
        prepare(plan, *job);
        return job;
    };
    const auto handOn = [&](const JobPointer& job) {
        if (job->failure) std::rethrow_exception(job->failure);
        use(job->block);
        jobs.release(job);
    };
    using tbb::filter_mode;
    tbb::parallel_pipeline(jobsAtOnce(plan),
                           tbb::make_filter<void, JobPointer>(filter_mode::serial_in_order, cutJobs) &
                               tbb::make_filter<JobPointer, JobPointer>(filter_mode::parallel, unpack) &
                               tbb::make_filter<JobPointer, void>(filter_mode::serial_in_order, handOn));
}

} // namespace pointrt
