// SPDX-License-Identifier: GPL-3.0-or-later
// .splat files of Gaussians: 32 bytes each and nothing else, as antimatter15's viewer made them common.
#include <cmath>
#include <cstring>

#include "preprocess/input/formats.h"
#include "preprocess/input/gaussians.h"

namespace pointrt {
namespace {

/// One Gaussian of a file: centre, deviations, colour with opacity, rotation w x y z around 128.
struct Record {
    float position[3], deviations[3];
    std::uint8_t color[4], rotation[4];
};
static_assert(sizeof(Record) == 32);

Record recordAt(std::string_view bytes, std::size_t index) {
    Record record;
    std::memcpy(&record, bytes.data() + index * sizeof record, sizeof record);
    return record;
}

Eigen::Quaternionf rotationOf(const Record& record) {
    const auto part = [&](int i) { return (static_cast<float>(record.rotation[i]) - 128) / 128; };
    return {part(0), part(1), part(2), part(3)};
}

/// The format has no mark, but rotations of unit length to the last bit or two (1 / 128 for each part), deviations
/// above zero and coordinates that are numbers.
bool isPlausible(const Record& record) {
    constexpr float kRounding = 0.05f;
    if (std::abs(rotationOf(record).norm() - 1) > kRounding) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const bool sane =
            std::abs(record.position[axis]) < 1e9f && record.deviations[axis] >= 0 && record.deviations[axis] < 1e9f;
        if (!sane) return false;
    }
    return true;
}

/// Some have no rotation, or are broken. Where most are, it is another kind of file.
bool areSplats(std::string_view bytes, std::size_t first_of) {
    const std::size_t count = std::min(bytes.size() / sizeof(Record), first_of);
    std::size_t plausible = 0;
    for (std::size_t i = 0; i < count; ++i) plausible += isPlausible(recordAt(bytes, i));
    return bytes.size() % sizeof(Record) == 0 && 2 * plausible > count;
}

/// By chance a record looks like one a few times in a hundred.
bool isSplatStart(std::string_view bytes) {
    constexpr std::size_t kTelling = 64;
    return bytes.size() >= kTelling * sizeof(Record) && areSplats(bytes, kTelling);
}

Gaussian gaussianOf(const Record& record) {
    Gaussian gaussian;
    for (int axis = 0; axis < 3; ++axis) {
        gaussian.position[axis] = static_cast<double>(record.position[axis]);
        gaussian.deviations[axis] = record.deviations[axis];
        gaussian.color[axis] = static_cast<float>(record.color[axis]) / 255;
    }
    gaussian.opacity = static_cast<float>(record.color[3]) / 255;
    gaussian.rotation = rotationOf(record);
    return gaussian;
}

void readSplat(const Source& source, Sink& sink) {
    const std::size_t count = source.bytes.size() / sizeof(Record);
    if (source.bytes.size() % sizeof(Record) != 0)
        refuse(source,
               fmt::format("is cut short or no .splat file: {} bytes are no multiple of 32", source.bytes.size()));
    if (!areSplats(source.bytes, count)) refuse(source, "is no .splat file: most of its records are no Gaussians");
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (std::size_t i = 0; i < count; ++i) use(gaussianOf(recordAt(source.bytes, i)));
    };
    readGaussians(source, {count, -Vec3d::UnitY(), ""}, each, sink);
}

} // namespace

const FormatReader readers::kSplat{.isStart = isSplatStart, .read = readSplat};

} // namespace pointrt
