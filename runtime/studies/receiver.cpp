// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// Calls act(column of a, same column of b) for each column.
template <typename A, typename B, typename Act>
void forColumns(A& a, B& b, const Act& act) {
    act(a.positions, b.positions);
    act(a.times, b.times);
    act(a.ranges, b.ranges);
    act(a.intensities, b.intensities);
    act(a.powers, b.powers);
    act(a.incidences_deg, b.incidences_deg);
    act(a.scan_angles_deg, b.scan_angles_deg);
    act(a.return_numbers, b.return_numbers);
    act(a.numbers_of_returns, b.numbers_of_returns);
    act(a.rings, b.rings);
    act(a.pulses, b.pulses);
    act(a.splat_ids, b.splat_ids);
    act(a.instance_ids, b.instance_ids);
    act(a.tile_ids, b.tile_ids);
}

double squared(double x) { return x * x; }

std::uint16_t intensityOf(double number) {
    return static_cast<std::uint16_t>(std::lround(std::min(number, 65535.0))); // 16 bits in LAS files
}

} // namespace

LidarReceiver::LidarReceiver(const LidarSensor& sensor, std::uint64_t seed, double metres_per_unit)
    : sensor_(sensor), random_(seed), metres_per_unit_(metres_per_unit) {
    const double reference_m = sensor.reference_range_m > 0 ? sensor.reference_range_m : sensor.max_range_m / 2;
    reference_range_ = reference_m / metres_per_unit;
}

void LidarReceiver::receive(const FiredPulse& pulse, const PulseHits& hits, LidarPoints& points) {
    if (sensor_.drop_probability > 0 && random_.uniform(pulse.number, LidarDraw::kDrop) < sensor_.drop_probability)
        return;
    collectEchoes(pulse, hits);
    findReturns(echoes_, sensor_.range_resolution_m / metres_per_unit_, returns_);
    selectReturns();
    for (std::size_t i = 0; i < returns_.size(); ++i) append(pulse, i, !hits.tile_ids.empty(), points);
}

void LidarReceiver::collectEchoes(const FiredPulse& pulse, const PulseHits& hits) {
    echoes_.clear();
    const double share = 1.0 / static_cast<double>(hits.t.size());
    for (std::size_t i = 0; i < hits.t.size(); ++i) {
        if (hits.instance_ids[i] == kNoHit || hits.t[i] < sensor_.min_range_m / metres_per_unit_) continue;
        const float* n = &hits.normals[3 * i];
        const double cosine = std::min(1.0, std::abs(dot(pulse.axis, {n[0], n[1], n[2]})));
        const double near =
            squared(reference_range_ / std::max(hits.t[i], 1e-9 * reference_range_)); // finite for t = 0, too
        echoes_.push_back({hits.t[i], share * static_cast<double>(hits.reflectances[i]) * cosine * near,
                           static_cast<float>(cosine), hits.splat_ids[i], hits.instance_ids[i],
                           hits.tile_ids.empty() ? kNoHit : hits.tile_ids[i]});
    }
}

/// Keeps the returns that the sensor detects and records.
void LidarReceiver::selectReturns() {
    std::erase_if(returns_, [&](const LidarReturn& each) { return each.power < sensor_.detection_threshold; });
    if (returns_.size() > sensor_.most_returns) returns_.resize(sensor_.most_returns);
    if (returns_.size() < 2 || sensor_.kept == LidarKept::kAll) return;
    LidarReturn one = returns_.front();
    if (sensor_.kept == LidarKept::kLast) one = returns_.back();
    if (sensor_.kept == LidarKept::kStrongest)
        one = *std::max_element(returns_.begin(), returns_.end(),
                                [](const LidarReturn& a, const LidarReturn& b) { return a.power < b.power; });
    returns_.assign(1, one);
}

void LidarReceiver::append(const FiredPulse& pulse, std::size_t number, bool has_tiles, LidarPoints& points) const {
    const LidarReturn& each = returns_[number];
    const double sigma = sensor_.range_noise_m / metres_per_unit_ + sensor_.range_noise_per_m * each.range;
    double range = each.range;
    if (sigma > 0)
        range += sigma * random_.gaussian(pulse.number, LidarDraw::kRange, static_cast<std::uint32_t>(number));
    range = std::max(range, 0.0);
    const Vec3 position = pulse.origin + range * pulse.axis;
    points.positions.insert(points.positions.end(), {position.x, position.y, position.z});
    points.times.push_back(pulse.time);
    points.ranges.push_back(range);
    const double corrected = sensor_.range_corrected ? squared(each.range / reference_range_) : 1;
    points.intensities.push_back(intensityOf(sensor_.white_intensity * each.power * corrected));
    points.powers.push_back(static_cast<float>(each.power));
    points.incidences_deg.push_back(std::acos(each.strongest.cosine) * 180 / std::numbers::pi_v<float>);
    points.scan_angles_deg.push_back(pulse.scan_angle_deg);
    points.return_numbers.push_back(static_cast<std::uint8_t>(number + 1));
    points.numbers_of_returns.push_back(static_cast<std::uint8_t>(returns_.size()));
    points.rings.push_back(pulse.ring);
    points.pulses.push_back(pulse.number);
    points.splat_ids.push_back(each.strongest.splat);
    points.instance_ids.push_back(each.strongest.instance);
    if (has_tiles) points.tile_ids.push_back(each.strongest.tile);
}

void LidarPoints::append(const LidarPoints& other) {
    forColumns(*this, other, [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); });
    pulses_done = other.pulses_done;
    pulses_total = other.pulses_total;
}

void LidarPoints::clear() {
    forColumns(*this, *this, [](auto& column, const auto&) { column.clear(); });
}

} // namespace pointrt
