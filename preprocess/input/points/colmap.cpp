// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse points of COLMAP: points3D.bin or .txt, with the cameras in images.bin or .txt beside them.
#include "preprocess/input/points/colmap.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/points/byte_cursor.h"
#include "preprocess/input/points/colmap_images.h"

namespace pointrt {
namespace {

constexpr std::string_view kTextMark = "# 3D point list";
constexpr std::uint64_t kSightBytes = 8; // IMAGE_ID, POINT2D_IDX

struct ColmapPoint {
    Row row{};
    float error = 0;          ///< of reprojection, pixels
    std::uint32_t sights = 0; ///< photographs that show the point
    std::uint32_t image = 0;  ///< the first of them
};

/// POINT3D_ID, X, Y, Z, R, G, B, ERROR and the sights, at most as many as the bytes hold.
ColmapPoint takeBinaryPoint(ByteCursor& bytes) {
    ColmapPoint point;
    bytes.take<std::uint64_t>(); // POINT3D_ID
    for (std::size_t axis = 0; axis < 3; ++axis) point.row[kX + axis] = bytes.take<double>();
    for (std::size_t i = 0; i < 3; ++i) point.row[kRed + i] = bytes.take<std::uint8_t>();
    point.error = static_cast<float>(bytes.take<double>());
    const auto sights = bytes.take<std::uint64_t>();
    const std::string_view track = bytes.takeArray(sights, kSightBytes);
    point.sights = static_cast<std::uint32_t>(std::min<std::uint64_t>(sights, ~std::uint32_t{0}));
    if (sights > 0) point.image = static_cast<std::uint32_t>(loadScalar(track.data(), Scalar::kU32, false));
    return point;
}

bool isPlausible(const ColmapPoint& point) {
    bool finite = std::isfinite(point.error) && (point.error >= 0 || point.error == -1);
    for (std::size_t axis = 0; axis < 3; ++axis) finite = finite && std::isfinite(point.row[kX + axis]);
    return finite && point.sights > 0;
}

/// Whether the bytes start with a number of points and plausible ones, or end with the last of them.
bool isBinaryModel(std::string_view bytes) {
    constexpr std::uint64_t kTested = 32, kLeastBytes = 51; // of a point, with one sight
    InputFile file;
    file.bytes = bytes;
    ByteCursor cursor{file, bytes};
    if (bytes.size() < 8) return false;
    const auto count = cursor.take<std::uint64_t>();
    if (count == 0 || count > cursor.rest.size() / kLeastBytes) return false;
    try {
        for (std::uint64_t i = 0; i < std::min(count, kTested); ++i)
            if (!isPlausible(takeBinaryPoint(cursor))) return false;
    } catch (const Error&) {
        return false;
    }
    return count > kTested || cursor.rest.empty();
}

/// The numbers of a line of points3D.txt, whose sights follow.
ColmapPoint textPoint(const InputFile& input, std::string_view line) {
    const char* const place = line.data();
    ColmapPoint point;
    std::uint64_t id = 0;
    double error = 0;
    bool good = wholeInteger(nextWord(line), id);
    for (std::size_t axis = 0; axis < 3; ++axis) good = good && wholeNumber(nextWord(line), point.row[kX + axis]);
    for (std::size_t i = 0; i < 3; ++i) good = good && wholeNumber(nextWord(line), point.row[kRed + i]);
    good = good && wholeNumber(nextWord(line), error);
    if (!good) refuseLine(input, place, "a point needs POINT3D_ID, X, Y, Z, R, G, B and ERROR");
    point.error = static_cast<float>(error);
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line)) {
        if (point.sights++ == 0 && !wholeInteger(word, point.image))
            refuseLine(input, place, fmt::format("{} is not an IMAGE_ID", inQuotes(word)));
        nextWord(line); // POINT2D_IDX
    }
    return point;
}

/// Calls use(point) for each point. Returns the number of points that the file declares.
template <typename Use>
std::uint64_t forEachPoint(const InputFile& input, bool salvages, const Use& use) {
    if (!isBinaryModel(input.bytes) && input.bytes.starts_with(kTextMark)) {
        std::uint64_t count = 0;
        Lines lines{input.bytes, true};
        for (std::string_view line; lines.next(line); ++count) use(textPoint(input, line));
        return count;
    }
    ByteCursor bytes{input, input.bytes};
    const auto count = bytes.take<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
        ColmapPoint point;
        try {
            point = takeBinaryPoint(bytes);
        } catch (const Error&) {
            if (!salvages || i == 0)
                refuse(input, fmt::format("truncated: found {} of {} points{}", i, count,
                                          i > 0 ? "; --salvage reads these" : ""));
            break;
        }
        use(point);
    }
    return count;
}

/// The cameras beside the points; none if the file is missing.
ColmapImages imagesBeside(const InputFile& input, Sink& sink) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(input.name).parent_path();
    const bool is_text = input.bytes.starts_with(kTextMark);
    std::error_code failure;
    for (const char* const name : {is_text ? "images.txt" : "images.bin", is_text ? "images.bin" : "images.txt"})
        if (fs::is_regular_file(folder / name, failure))
            return readColmapImages(openInputFile((folder / name).string(), NamedBy::kFile));
    sink.note(input, "has no images.bin or images.txt beside it: the positions of its cameras are unknown");
    return {};
}

/// Points grouped by the first camera that saw them, which serves as the station of their scan.
using PointsOfImage = std::map<std::uint32_t, std::vector<ColmapPoint>>;
constexpr std::uint32_t kNoImage = ~std::uint32_t{0};

void addScan(const InputFile& input, const ColmapImages& images, std::uint32_t id,
             const std::vector<ColmapPoint>& points, Sink& sink) {
    ScanTraits traits;
    traits.faces = false;
    traits.colors = true;
    traits.vertices = points.size();
    traits.columns = {{"error", Scalar::kF32}, {"track_length", Scalar::kU32}};
    sink.beginScan(input, traits);
    const auto image = images.find(id);
    if (image != images.end()) sink.setScanSensor(image->second.center);
    for (const ColmapPoint& point : points) {
        char values[sizeof point.error + sizeof point.sights];
        std::memcpy(values, &point.error, sizeof point.error);
        std::memcpy(values + sizeof point.error, &point.sights, sizeof point.sights);
        sink.addVertex(point.row, values);
    }
    sink.finishScan(input, image == images.end() ? "" : image->second.name, Emptiness::kAllowed);
}

/// count: number of points of all scans, which share one progress
void addScans(const InputFile& input, const ColmapImages& images, const PointsOfImage& scans, std::uint64_t count,
              Sink& sink) {
    const auto progress = std::exchange(sink.progress, nullptr);
    std::uint64_t done = 0;
    for (const auto& [id, points] : scans) {
        addScan(input, images, id, points, sink);
        done += points.size();
        if (progress) progress(static_cast<double>(done) / static_cast<double>(count));
    }
    sink.progress = progress;
}

/// The up direction of most photographs, if they agree.
Vec3d upOf(const ColmapImages& images) {
    // length of the mean of unit vectors; photographs taken all around have a shorter one
    constexpr double kAgreement = 0.5;
    Vec3d sum = Vec3d::Zero();
    for (const auto& [id, image] : images) sum += image.up;
    const bool agrees = !images.empty() && sum.norm() > kAgreement * static_cast<double>(images.size());
    return agrees ? sum.normalized() : Vec3d::Zero();
}

void readColmap(const InputFile& input, Sink& sink) {
    const ColmapImages images = imagesBeside(input, sink);
    PointsOfImage scans;
    std::uint64_t found = 0;
    const std::uint64_t promised = forEachPoint(input, sink.salvages, [&](const ColmapPoint& point) {
        ++found;
        scans[point.sights > 0 && images.contains(point.image) ? point.image : kNoImage].push_back(point);
    });
    if (found == 0) refuse(input, "holds no points");
    if (found < promised) sink.acceptShort(input, found, promised);
    const std::size_t before = sink.pointCount();
    addScans(input, images, scans, found, sink);
    if (sink.pointCount() == before) refuse(input, fmt::format("none of its {} points passes the filters", found));
    WorldFrame frame;
    frame.up = upOf(images);
    frame.up_by_custom = true; // photographs are mostly upright
    sink.setWorldFrame(input, frame);
}

} // namespace

bool isColmap(std::string_view bytes) { return bytes.starts_with(kTextMark) || isBinaryModel(bytes); }

const FormatReader readers::kColmap{.isStart = isColmap, .read = readColmap, .readsInBatches = alwaysInBatches};

} // namespace pointrt
