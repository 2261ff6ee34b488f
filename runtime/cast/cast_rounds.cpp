// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/cast_rounds.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "format/base/parallel.h"
#include "runtime/cast/shape_hit.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Rays that a thread takes at once where each is little work.
constexpr std::size_t kFewRays = 1u << 14;

/// work(i) for each of count, on all cores.
template <typename Work>
void forRays(std::size_t count, const Work& work) {
    forAll((count + kFewRays - 1) / kFewRays, [&](std::size_t part) {
        const std::size_t end = std::min(count, (part + 1) * kFewRays);
        for (std::size_t i = part * kFewRays; i < end; ++i) work(i);
    });
}

Line lineOf(const ScaledRay& ray, double t_min) {
    return {ray.origin, {1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z}, t_min};
}

/// A part of the rows, from first on, that goes to the device at once.
struct Chunk {
    std::size_t first = 0, count = 0;
    std::vector<CastRun> runs;
};

/// Cuts queues that follow each other into chunks for so many threads.
class Cutter {
public:
    Cutter(std::size_t rows, std::size_t threads)
        : most_(std::clamp((rows + threads - 1) / threads, kFewRays, CastSlot::kRays)) {}

    void add(const PlacedTarget* target, std::uint32_t count) {
        while (count > 0) {
            if (chunks_.empty() || chunks_.back().count == most_ || chunks_.back().runs.size() == CastSlot::kRuns)
                chunks_.push_back({taken_, 0, {}});
            Chunk& chunk = chunks_.back();
            const auto fitting = static_cast<std::uint32_t>(std::min<std::size_t>(count, most_ - chunk.count));
            chunk.runs.push_back({target, static_cast<std::uint32_t>(chunk.count), fitting});
            chunk.count += fitting;
            taken_ += fitting;
            count -= fitting;
        }
    }

    const std::vector<Chunk>& chunks() const { return chunks_; }

private:
    std::size_t most_, taken_ = 0;
    std::vector<Chunk> chunks_;
};

} // namespace

CastRounds::CastRounds(const CastScene& scene, const CastRequest& request, std::size_t first, std::size_t count)
    : scene_(scene), request_(request), first_(first), hits_(count), stops_(count),
      waiting_(scene.resident.list().targets.size()) {}

std::vector<RayHit> CastRounds::run() {
    forRays(hits_.size(), [&](std::size_t i) { begin(i); });
    std::vector<std::uint32_t> waiting(hits_.size());
    std::iota(waiting.begin(), waiting.end(), 0u);
    const auto is_done = [&](std::uint32_t ray) { return stops_[ray].box == kNoStop; };
    for (std::erase_if(waiting, is_done); !waiting.empty(); std::erase_if(waiting, is_done)) {
        std::vector<Queue> queues = queuesOf(waiting), ready;
        std::copy_if(queues.begin(), queues.end(), std::back_inserter(ready),
                     [&](const Queue& queue) { return scene_.resident.find(queue.target) != nullptr; });
        if (ready.empty()) {
            bringFor(std::move(queues));
            continue;
        }
        const std::vector<std::uint32_t> rows = takeReady(waiting, ready);
        trace(rows, ready);
        waiting.insert(waiting.end(), rows.begin(), rows.end());
    }
    forRays(hits_.size(), [&](std::size_t i) { finish(i); });
    return std::move(hits_);
}

void CastRounds::begin(std::size_t i) {
    const ScaledRay ray = scaledRay(request_.rays, first_ + i);
    RayHit& hit = hits_[i];
    hit.t = request_.limits.t_max * ray.size;
    const double t_min = request_.limits.t_min * ray.size;
    const std::vector<ShapeDescription>& shapes = scene_.resident.list().shapes;
    if (const auto shape = firstShape(shapes, ray.origin, ray.direction, t_min, hit.t))
        hit = {shape->t, kShape, shape->shape, 0};
    const bool is_known = request_.any_hit && hit.target != kNothing;
    stops_[i] = is_known ? Stop{0, kNoStop} : scene_.tree.next(lineOf(ray, t_min), kBeforeAll, hit.t);
}

/// In lengths of its own direction.
void CastRounds::finish(std::size_t i) { hits_[i].t /= scaledRay(request_.rays, first_ + i).size; }

/// By the number of their targets.
std::vector<CastRounds::Queue> CastRounds::queuesOf(const std::vector<std::uint32_t>& waiting) {
    std::vector<Queue> queues;
    for (const std::uint32_t ray : waiting)
        if (waiting_[stops_[ray].box]++ == 0) queues.push_back({stops_[ray].box, 0});
    for (Queue& queue : queues) queue.count = std::exchange(waiting_[queue.target], 0);
    std::sort(queues.begin(), queues.end(), [](const Queue& a, const Queue& b) { return a.target < b.target; });
    return queues;
}

/// The longest first.
void CastRounds::bringFor(std::vector<Queue> queues) {
    std::stable_sort(queues.begin(), queues.end(), [](const Queue& a, const Queue& b) { return a.count > b.count; });
    std::vector<std::uint32_t> targets;
    for (const Queue& queue : queues) targets.push_back(queue.target);
    scene_.resident.bring(targets);
}

/// Out of waiting, in the order of their queues, each in the rays' own.
std::vector<std::uint32_t> CastRounds::takeReady(std::vector<std::uint32_t>& waiting, const std::vector<Queue>& ready) {
    constexpr std::uint32_t kElsewhere = 0xFFFFFFFFu;
    std::vector<std::uint32_t>& place = waiting_; // where the next ray of each target goes, from 1 on
    std::uint32_t total = 0;
    for (const Queue& queue : ready) {
        place[queue.target] = total + 1;
        total += queue.count;
    }
    std::vector<std::uint32_t> rows(total);
    for (std::uint32_t& ray : waiting)
        if (std::uint32_t& next = place[stops_[ray].box]; next != 0) rows[next++ - 1] = std::exchange(ray, kElsewhere);
    for (const Queue& queue : ready) place[queue.target] = 0;
    std::erase(waiting, kElsewhere);
    return rows;
}

void CastRounds::trace(const std::vector<std::uint32_t>& rows, const std::vector<Queue>& queues) {
    Cutter cutter(rows.size(), scene_.slots.most());
    for (const Queue& queue : queues) {
        scene_.resident.use(queue.target);
        cutter.add(scene_.resident.find(queue.target), queue.count);
    }
    const std::vector<Chunk>& chunks = cutter.chunks();
    forAll(
        chunks.size(),
        [&](std::size_t k) {
            const auto part = std::span(rows).subspan(chunks[k].first, chunks[k].count);
            scene_.slots.with([&](CastSlot& slot) { traceChunk(slot, part, chunks[k].runs); });
        },
        scene_.slots.most());
}

RayLimits CastRounds::limitsOf(std::uint32_t ray, double size) const {
    return {request_.limits.t_min * size, hits_[ray].t};
}

void CastRounds::traceChunk(CastSlot& slot, std::span<const std::uint32_t> rows, std::span<const CastRun> runs) {
    const std::span<gpu::CastRay> packed = slot.rayRows(rows.size());
    for (const CastRun& run : runs)
        for (std::size_t row = run.first; row < run.first + run.count; ++row) {
            const ScaledRay ray = scaledRay(request_.rays, first_ + rows[row]);
            packed[row] = packRay(run.target->frame, ray, limitsOf(rows[row], ray.size), slot.starts[row]);
        }
    traceSlot(slot, scene_.programs, runs, request_.any_hit);
    for (std::size_t row = 0; row < rows.size(); ++row) settle(slot, rows[row], row);
}

/// What has come of a ray at its stop, and where it goes from there.
void CastRounds::settle(CastSlot& slot, std::uint32_t i, std::size_t row) {
    RayHit& hit = hits_[i];
    Stop& stop = stops_[i];
    if (request_.any_hit && slot.stoppedRows(row + 1)[row] != 0) {
        hit.target = std::exchange(stop, {0, kNoStop}).box;
        return;
    }
    const ScaledRay ray = scaledRay(request_.rays, first_ + i);
    const RayLimits limits = limitsOf(i, ray.size);
    if (!request_.any_hit) hit = hitOf(slot.hitRows(row + 1)[row], stop.box, slot.starts[row], limits, hit);
    stop = scene_.tree.next(lineOf(ray, limits.t_min), stop, hit.t);
}

} // namespace pointrt
