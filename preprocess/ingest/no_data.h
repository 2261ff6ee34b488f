// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates that mark missing data, such as -9999 for a height.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Points of a scan whose coordinate on an axis of the scan's frame marks missing data, or that are at its origin.
struct NoData {
    bool is_origin = false; ///< pulses without a return: limit is how near the origin
    int axis = 0;
    double value = 0;
    std::uint64_t points = 0;
    bool is_low = false; ///< below all other values
    double limit = 0;    ///< halfway to them
    /// Whether programs commonly use the value for missing data. Otherwise it is as far away and as frequent, but may
    /// be valid.
    bool is_customary = false;

    bool marks(const Vec3d& in_scan) const {
        if (is_origin) return in_scan.cwiseAbs().maxCoeff() < limit;
        return is_low ? in_scan[axis] < limit : in_scan[axis] > limit;
    }
};

/// The extreme values of each coordinate of a scan, and the values next to them.
class NoDataSurvey {
public:
    void add(const Vec3d& in_scan) {
        ++points_;
        zeros_ += in_scan.x() == 0 && in_scan.y() == 0 && in_scan.z() == 0;
        if ((in_scan.array() >= inner_low_.array()).all() && (in_scan.array() <= inner_high_.array()).all()) return;
        addExtremes(in_scan);
    }

    /// Values that two or more points share and that are far from all others. A customary value must be farther away
    /// than the extent of the others; x = y = 0, or z = 0 for a few points, ten times as far; any other value, for a
    /// few points, a hundred times as far, and it does not count as customary.
    std::vector<NoData> find() const;

    /// Points at 0, 0, 0 among the others, which drivers of scanners write for pulses without a return: then the
    /// scanner is there. nullopt if they may be on a surface: fewer than one in a hundred, or fewer than 16.
    std::optional<NoData> findNoReturns() const;

private:
    /// The lowest value, how many points have it, and the next higher one.
    struct Extreme {
        double lowest = std::numeric_limits<double>::infinity(), next = std::numeric_limits<double>::infinity();
        std::uint64_t count = 0;

        void add(double value) {
            if (value > lowest) {
                if (value < next) next = value;
            } else if (value == lowest) {
                ++count;
            } else {
                next = lowest;
                lowest = value;
                count = 1;
            }
        }
    };

    void addExtremes(const Vec3d& in_scan);
    std::optional<NoData> zeroPlace() const;
    bool hasZeroHeight(bool is_low) const;
    NoData candidate(std::size_t axis, bool is_low) const;
    double timesAsFar(std::size_t axis, bool is_low) const;

    std::uint64_t points_ = 0, zeros_ = 0;
    std::array<Extreme, 3> low_, high_; ///< high_: for the negated values
    /// The values next to the extremes: points between them, which are nearly all points of a scan, change nothing.
    Vec3d inner_low_ = Vec3d::Constant(std::numeric_limits<double>::infinity()), inner_high_ = -inner_low_;
};

/// "z = -9999".
std::string nameOf(const NoData& no_data);

} // namespace pointrt
