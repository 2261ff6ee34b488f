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

/// Rays per task, for steps that take little time per ray.
constexpr std::size_t kFewRays = 1u << 14;

/// Calls work(i) for i < count on all cores.
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

/// Rows, from first on, that go to the device in one submission.
struct Chunk {
    std::size_t first = 0, count = 0;
    std::vector<CastRun> runs;
};

/// Divides consecutive queues into chunks for a number of threads.
class ChunkBuilder {
public:
    ChunkBuilder(std::size_t rows, std::size_t threads)
        : most_(std::clamp((rows + threads - 1) / threads, kFewRays, CastSlot::kRays)) {}

    void add(const ResidentInstance* instance, std::uint32_t count) {
        while (count > 0) {
            if (chunks_.empty() || chunks_.back().count == most_ || chunks_.back().runs.size() == CastSlot::kRuns)
                chunks_.push_back({taken_, 0, {}});
            Chunk& chunk = chunks_.back();
            const auto fitting = static_cast<std::uint32_t>(std::min<std::size_t>(count, most_ - chunk.count));
            chunk.runs.push_back({instance, static_cast<std::uint32_t>(chunk.count), fitting});
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
    : scene_(scene), request_(request), first_(first), hits_(count), entries_(count),
      waiting_(scene.resident.list().instances.size()) {}

std::vector<RayHit> CastRounds::run() {
    forRays(hits_.size(), [&](std::size_t i) { begin(i); });
    std::vector<std::uint32_t> waiting(hits_.size());
    std::iota(waiting.begin(), waiting.end(), 0u);
    const auto is_done = [&](std::uint32_t ray) { return entries_[ray].box == kNoEntry; };
    for (std::erase_if(waiting, is_done); !waiting.empty(); std::erase_if(waiting, is_done)) {
        std::vector<Queue> queues = queuesOf(waiting), ready;
        std::copy_if(queues.begin(), queues.end(), std::back_inserter(ready),
                     [&](const Queue& queue) { return scene_.resident.find(queue.instance) != nullptr; });
        if (ready.empty()) {
            loadFor(std::move(queues));
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
    const bool is_known = request_.any_hit && hit.instance != kNothing;
    entries_[i] = is_known ? BoxEntry{0, kNoEntry} : scene_.tree.next(lineOf(ray, t_min), kBeforeAllEntries, hit.t);
}

/// Converts t to lengths of the ray's own direction.
void CastRounds::finish(std::size_t i) { hits_[i].t /= scaledRay(request_.rays, first_ + i).size; }

/// The queues of waiting rays, sorted by instance.
std::vector<CastRounds::Queue> CastRounds::queuesOf(const std::vector<std::uint32_t>& waiting) {
    std::vector<Queue> queues;
    for (const std::uint32_t ray : waiting)
        if (waiting_[entries_[ray].box]++ == 0) queues.push_back({entries_[ray].box, 0});
    for (Queue& queue : queues) queue.count = std::exchange(waiting_[queue.instance], 0);
    std::sort(queues.begin(), queues.end(), [](const Queue& a, const Queue& b) { return a.instance < b.instance; });
    return queues;
}

/// Loads the instances with the longest queues first.
void CastRounds::loadFor(std::vector<Queue> queues) {
    std::stable_sort(queues.begin(), queues.end(), [](const Queue& a, const Queue& b) { return a.count > b.count; });
    std::vector<std::uint32_t> instances;
    for (const Queue& queue : queues) instances.push_back(queue.instance);
    scene_.resident.load(instances);
}

/// Removes the rays of ready queues from waiting. Returns them queue by queue, in their order in waiting.
std::vector<std::uint32_t> CastRounds::takeReady(std::vector<std::uint32_t>& waiting, const std::vector<Queue>& ready) {
    constexpr std::uint32_t kElsewhere = 0xFFFFFFFFu;
    std::vector<std::uint32_t>& place = waiting_; // for each instance, 1 + the row of its next ray
    std::uint32_t total = 0;
    for (const Queue& queue : ready) {
        place[queue.instance] = total + 1;
        total += queue.count;
    }
    std::vector<std::uint32_t> rows(total);
    for (std::uint32_t& ray : waiting)
        if (std::uint32_t& next = place[entries_[ray].box]; next != 0)
            rows[next++ - 1] = std::exchange(ray, kElsewhere);
    for (const Queue& queue : ready) place[queue.instance] = 0;
    std::erase(waiting, kElsewhere);
    return rows;
}

void CastRounds::trace(const std::vector<std::uint32_t>& rows, const std::vector<Queue>& queues) {
    ChunkBuilder cutter(rows.size(), scene_.slots.most());
    for (const Queue& queue : queues) {
        scene_.resident.use(queue.instance);
        cutter.add(scene_.resident.find(queue.instance), queue.count);
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
            packed[row] = packRay(run.instance->frame, ray, limitsOf(rows[row], ray.size), slot.starts[row]);
        }
    traceSlot(slot, scene_.programs, runs, request_.any_hit);
    for (std::size_t row = 0; row < rows.size(); ++row) finishStep(slot, rows[row], row);
}

/// Takes the hit of a ray in its current instance and finds the ray's next instance.
void CastRounds::finishStep(CastSlot& slot, std::uint32_t i, std::size_t row) {
    RayHit& hit = hits_[i];
    BoxEntry& entry = entries_[i];
    if (request_.any_hit && slot.occludedRows(row + 1)[row] != 0) {
        hit.instance = std::exchange(entry, {0, kNoEntry}).box;
        return;
    }
    const ScaledRay ray = scaledRay(request_.rays, first_ + i);
    const RayLimits limits = limitsOf(i, ray.size);
    if (!request_.any_hit) hit = hitOf(slot.hitRows(row + 1)[row], entry.box, slot.starts[row], limits, hit);
    entry = scene_.tree.next(lineOf(ray, limits.t_min), entry, hit.t);
}

} // namespace pointrt
