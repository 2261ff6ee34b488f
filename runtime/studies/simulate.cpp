// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "format/base/parallel.h"
#include "runtime/studies/pulse_rays.h"
#include "runtime/studies/receiver.h"
#include "runtime/studies/reflectance.h"
#include "runtime/studies/sensor_check.h"

namespace pointrt {
namespace {

/// Doubles hold all integers up to here.
constexpr double kMostPulses = 0x1p53;
/// Tasks of a block: enough for many cores, but each takes much longer than starting it.
constexpr std::size_t kSlices = 64;

/// Pulses of all periods that start before the end. Times are rounded, so a period that starts within a millionth of a
/// period before the end does not count.
std::uint64_t pulsesWithin(double duration_s, const FiringTimes& times) {
    const double periods = std::ceil(duration_s / times.period_s * (1 - 1e-12) - 1e-6);
    const double pulses = std::max(periods, 1.0) * static_cast<double>(times.pulses);
    if (!(pulses <= kMostPulses))
        throw TraceError(TraceError::Kind::kBadUsage,
                         "a run of " + std::to_string(duration_s) + " s fires more pulses than can be counted");
    return static_cast<std::uint64_t>(pulses);
}

double durationOf(const LidarSensor& sensor, const LidarRun& run) {
    if (run.duration_s) return *run.duration_s;
    if (run.trajectory.size() == 1) return firingTimes(sensor.pattern).cycle_s;
    return run.trajectory.back().time - run.start_s.value_or(run.trajectory.front().time);
}

double unitOf(const TraceScene& scene, const LidarRun& run) {
    if (run.metres_per_unit > 0) return run.metres_per_unit;
    return scene.metresPerUnit() > 0 ? scene.metresPerUnit() : 1;
}

/// Consecutive pulses with their rays and hits.
struct Block {
    std::vector<FiredPulse> pulses_fired;
    std::vector<double> rays, t;
    std::vector<std::uint32_t> splat_ids, instance_ids, tile_ids;
    std::vector<float> normals, reflectances;

    void resize(std::size_t pulses, std::size_t rays_per_pulse, bool has_tiles) {
        const std::size_t count = pulses * rays_per_pulse;
        pulses_fired.resize(pulses);
        rays.resize(6 * count);
        t.resize(count);
        splat_ids.resize(count);
        instance_ids.resize(count);
        if (has_tiles) tile_ids.resize(count);
        normals.resize(3 * count);
        reflectances.resize(count);
    }
    PulseHits hitsOf(std::size_t pulse, std::size_t rays_per_pulse) const {
        const std::size_t first = pulse * rays_per_pulse;
        const auto part = [&](const auto& all, std::size_t width) {
            return std::span(all).subspan(width * first, width * rays_per_pulse);
        };
        const auto tiles = tile_ids.empty() ? std::span<const std::uint32_t>() : part(tile_ids, 1);
        return {part(t, 1), part(splat_ids, 1), part(instance_ids, 1), tiles, part(normals, 3), part(reflectances, 1)};
    }
};

/// Calls work(first, end, slice) on all cores for each slice [first, end) of [0, count).
template <typename Work>
void inSlices(std::size_t count, const Work& work) {
    forAll(kSlices, [&](std::size_t s) { work(count * s / kSlices, count * (s + 1) / kSlices, s); });
}

class Simulation {
public:
    Simulation(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run)
        : scene_(scene), sensor_(sensor), unit_(unitOf(scene, run)), generator_(sensor, run),
          reflectance_(scene, sensor.reflectance), receivers_(kSlices, LidarReceiver(sensor, run.seed, unit_)),
          parts_(kSlices) {}

    void fire(std::uint64_t first, std::size_t pulses, LidarPoints& points) {
        const std::size_t rays = generator_.raysPerPulse();
        block_.resize(pulses, rays, scene_.hasTiles());
        inSlices(pulses, [&](std::size_t from, std::size_t end, std::size_t) { generateRays(first, from, end); });
        scene_.castRays(std::span<const double>(block_.rays), {0, sensor_.max_range_m / unit_},
                        {block_.t, block_.splat_ids, block_.instance_ids, block_.normals, {}, block_.tile_ids});
        reflectance_.lookUp({block_.splat_ids, block_.instance_ids, block_.tile_ids}, block_.reflectances);
        inSlices(pulses, [&](std::size_t from, std::size_t end, std::size_t slice) {
            parts_[slice].clear();
            for (std::size_t i = from; i < end; ++i)
                receivers_[slice].receive(block_.pulses_fired[i], block_.hitsOf(i, rays), parts_[slice]);
        });
        points.clear();
        for (const LidarPoints& part : parts_) points.append(part);
    }

private:
    void generateRays(std::uint64_t first, std::size_t from, std::size_t end) {
        const std::size_t numbers = 6 * generator_.raysPerPulse();
        for (std::size_t i = from; i < end; ++i) {
            block_.pulses_fired[i] = generator_.pulse(first + i);
            generator_.rays(block_.pulses_fired[i], std::span(block_.rays).subspan(i * numbers, numbers));
        }
    }

    const TraceScene& scene_;
    const LidarSensor& sensor_;
    double unit_;
    PulseRayGenerator generator_;
    ReflectanceLookup reflectance_;
    std::vector<LidarReceiver> receivers_;
    std::vector<LidarPoints> parts_;
    Block block_;
};

} // namespace

std::uint64_t lidarPulseCount(const LidarSensor& sensor, const LidarRun& run) {
    requireSensor(sensor);
    requireRun(run);
    return pulsesWithin(durationOf(sensor, run), firingTimes(sensor.pattern));
}

void simulateLidar(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run,
                   const std::function<void(const LidarPoints&)>& take) {
    const std::uint64_t total = lidarPulseCount(sensor, run);
    Simulation simulation(scene, sensor, run);
    const std::uint64_t at_once = std::max<std::uint64_t>(1, run.rays_at_once / sensor.rays);
    LidarPoints points;
    for (std::uint64_t first = 0; first < total; first += at_once) {
        const std::uint64_t count = std::min(at_once, total - first);
        simulation.fire(first, static_cast<std::size_t>(count), points);
        points.pulses_done = first + count;
        points.pulses_total = total;
        take(points);
    }
}

} // namespace pointrt
