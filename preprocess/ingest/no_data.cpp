// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/no_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

constexpr double kFarZero = 10;   // a zero is far if it is this many times the extent of the others away
constexpr std::uint64_t kFew = 4; // fewer than one in 4 points

/// Whether programs use a value for missing data: three nines or more, the ends of 16- and 32-bit integers, powers of
/// ten from 1e5 on. Values of LAS files are off by rounding.
bool isCustomaryValue(double value) {
    const double size = std::abs(value);
    std::string digits = fmt::format("{:.3f}", size);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
    const bool nines = size >= 999 && digits.find_first_not_of("9.") == std::string::npos;
    const auto is = [&](double other) { return std::abs(size - other) <= 1e-6 * other; };
    const bool integer_end = is(32767) || is(32768) || is(0x1p31) || is(0x1p31 - 1);
    const bool power = size >= 1e5 && is(std::pow(10, std::round(std::log10(size))));
    return nines || integer_end || power;
}

} // namespace

void NoDataSurvey::addExtremes(const Vec3d& in_scan) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        low_[axis].add(in_scan[i]);
        high_[axis].add(-in_scan[i]);
        inner_low_[i] = low_[axis].next;
        inner_high_[i] = -high_[axis].next;
    }
}

NoData NoDataSurvey::candidate(std::size_t axis, bool is_low) const {
    const Extreme& extreme = (is_low ? low_ : high_)[axis];
    const double sign = is_low ? 1 : -1;
    NoData found;
    found.axis = static_cast<int>(axis);
    found.value = sign * extreme.lowest;
    found.points = extreme.count;
    found.is_low = is_low;
    found.limit = sign * (extreme.lowest / 2 + extreme.next / 2);
    return found;
}

/// The distance of an extreme value from the others, relative to their extent; 0 unless two or more points share it and
/// there are others.
double NoDataSurvey::timesAsFar(std::size_t axis, bool is_low) const {
    const Extreme &extreme = (is_low ? low_ : high_)[axis], &opposite = (is_low ? high_ : low_)[axis];
    if (extreme.count < 2 || extreme.count == points_) return 0;
    const double others = -opposite.lowest - extreme.next, gap = extreme.next - extreme.lowest;
    return others > 0 ? gap / others : 0;
}

/// Points at x = y = 0 far from the others, which some programs write for missing returns.
std::optional<NoData> NoDataSurvey::zeroPlace() const {
    for (const bool x_low : {true, false})
        for (const bool y_low : {true, false}) {
            const NoData x = candidate(0, x_low), y = candidate(1, y_low);
            if (x.value != 0 || y.value != 0 || x.points != y.points) continue;
            if (timesAsFar(0, x_low) > kFarZero && timesAsFar(1, y_low) > kFarZero) return x;
        }
    return std::nullopt;
}

/// Points with a height of 0 far from the others.
bool NoDataSurvey::hasZeroHeight(bool is_low) const {
    return candidate(2, is_low).value == 0 && timesAsFar(2, is_low) > kFarZero;
}

std::vector<NoData> NoDataSurvey::find() const {
    constexpr double kVeryFar = 100;
    std::vector<NoData> all;
    const auto zero = zeroPlace();
    if (zero) all.push_back(*zero);
    if (zero) all.back().is_customary = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool is_low : {true, false}) {
            const double far = timesAsFar(axis, is_low);
            if (!(far > 1)) continue;
            NoData found = candidate(axis, is_low);
            if (zero && found.points == zero->points) continue;
            const bool few = kFew * found.points < points_, height_0 = axis == 2 && hasZeroHeight(is_low);
            found.is_customary = isCustomaryValue(found.value) || (height_0 && few);
            if (found.is_customary || (few && far > kVeryFar)) all.push_back(found);
        }
    return all;
}

std::optional<NoData> NoDataSurvey::findNoReturns() const {
    // The soup of a mesh's triangles has six times as many points as the mesh: a vertex at the origin 6 of them.
    constexpr std::uint64_t kFewest = 16, kInHundred = 100;
    constexpr double kNear = 1e-5; // of the farthest coordinate: a millimetre in 100 m, which no scanner measures
    if (zeros_ < kFewest || zeros_ == points_ || kInHundred * zeros_ < points_) return {};
    if (zeroPlace() || hasZeroHeight(true) || hasZeroHeight(false)) return {}; // far from the others
    double farthest = 0;
    for (const auto* sides : {&low_, &high_})
        for (const Extreme& side : *sides) farthest = std::max(farthest, std::abs(side.lowest));
    NoData found;
    found.is_origin = found.is_customary = true;
    found.points = zeros_;
    found.limit = kNear * farthest;
    return found;
}

std::string nameOf(const NoData& no_data) {
    if (no_data.is_origin) return "x = y = z = 0";
    return fmt::format("{} = {:.10g}", "xyz"[no_data.axis], no_data.value);
}

} // namespace pointrt
