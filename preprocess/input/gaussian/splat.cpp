// SPDX-License-Identifier: GPL-3.0-or-later
// .splat files of Gaussians, 32 bytes each without a header, the format of antimatter15's viewer.
#include <cmath>
#include <cstring>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/gaussian/gaussians.h"

namespace pointrt {
namespace {

/// One Gaussian: centre, standard deviations, colour with opacity, rotation w x y z around 128.
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

/// Whether a record is plausible: the format has no signature, but rotations have unit length to the last bit or two (1
/// / 128 in each component), deviations are positive and coordinates finite.
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

/// Some records have no rotation or are invalid. If most are, the file is of another format.
bool areSplats(std::string_view bytes, std::size_t first_of) {
    const std::size_t count = std::min(bytes.size() / sizeof(Record), first_of);
    std::size_t plausible = 0;
    for (std::size_t i = 0; i < count; ++i) plausible += isPlausible(recordAt(bytes, i));
    return bytes.size() % sizeof(Record) == 0 && 2 * plausible > count;
}

/// Random bytes look like a record in a few cases out of a hundred.
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

void readSplat(const InputFile& input, Sink& sink) {
    const std::size_t count = input.bytes.size() / sizeof(Record);
    if (input.bytes.size() % sizeof(Record) != 0)
        refuse(input, fmt::format("is truncated or not a .splat file: its size of {} bytes is not a multiple of 32",
                                  input.bytes.size()));
    if (!areSplats(input.bytes, count)) refuse(input, "is not a .splat file: most of its records are not Gaussians");
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (std::size_t i = 0; i < count; ++i) use(gaussianOf(recordAt(input.bytes, i)));
    };
    readGaussians(input, {count, -Vec3d::UnitY(), 0}, each, sink);
}

} // namespace

const FormatReader readers::kSplat{.isStart = isSplatStart, .read = readSplat};

} // namespace pointrt
