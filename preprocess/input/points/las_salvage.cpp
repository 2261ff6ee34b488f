// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/las_salvage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

/// The box that the header states: low and high for each axis.
std::array<std::array<double, 2>, 3> boundsOf(const LasFile& file) {
    constexpr std::size_t kMaxX = 179; // then min x, max y, min y, max z, min z
    std::array<std::array<double, 2>, 3> bounds{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        bounds[axis] = {loadAt<double>(file.bytes, kMaxX + 16 * axis + 8),
                        loadAt<double>(file.bytes, kMaxX + 16 * axis)};
    return bounds;
}

bool isWithinBounds(const LasFile& file, const char* record) {
    const auto bounds = boundsOf(file);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(bounds[axis][0] < bounds[axis][1])) continue; // was not filled in
        std::int32_t whole = 0;
        std::memcpy(&whole, record + axis * sizeof whole, sizeof whole);
        const double value = file.header.offset[axis] + file.header.scale[axis] * whole;
        const double step = std::abs(file.header.scale[axis]);
        if (value < bounds[axis][0] - step || value > bounds[axis][1] + step) return false;
    }
    return true;
}

/// A layered chunk starts with a point and the number of its points.
std::uint64_t pointsOf(const LasPlan& plan, const LazChunk& chunk) {
    if (!plan.layout.layered || plan.layout.in_one_run || !liesIn(plan.layout.record_bytes, 4, chunk.bytes))
        return chunk.points;
    return std::min<std::uint64_t>(chunk.points,
                                   loadAt<std::uint32_t>(plan.file.bytes, chunk.at + plan.layout.record_bytes));
}

class Salvager {
public:
    Salvager(const LasPlan& plan, const std::function<void(const LasBlock&)>& use) : plan_(plan), use_(use) {}

    SalvagedLas run() {
        for (const LazChunk& chunk : plan_.chunks) readChunk(chunk);
        return result_;
    }

private:
    void readChunk(const LazChunk& chunk) {
        constexpr std::size_t kPointsAtOnce = 1 << 14;
        const std::size_t record = plan_.file.header.record_bytes;
        std::uint64_t done = 0;
        try {
            LazStream stream(plan_.layout, plan_.file.bytes, chunk);
            for (const std::uint64_t points = pointsOf(plan_, chunk); done < points; ++done) {
                records_.resize(records_.size() + record);
                stream.read(records_.data() + records_.size() - record, 1);
                if (records_.size() == kPointsAtOnce * record) handOn();
            }
        } catch (const Error& error) {
            records_.resize(records_.size() - record);
            while (!records_.empty() && !isWithinBounds(plan_.file, records_.data() + records_.size() - record))
                records_.resize(records_.size() - record);
            if (result_.fault.empty()) result_.fault = error.what();
        }
        handOn();
    }

    void handOn() {
        if (records_.empty()) return;
        decodeRecords(plan_, records_, block_);
        result_.points += block_.positions.size();
        use_(block_);
        records_.clear();
    }

    const LasPlan& plan_;
    const std::function<void(const LasBlock&)>& use_;
    SalvagedLas result_;
    std::vector<char> records_;
    LasBlock block_;
};

} // namespace

SalvagedLas salvageLas(const LasPlan& plan, const std::function<void(const LasBlock&)>& use) {
    return Salvager(plan, use).run();
}

} // namespace pointrt
