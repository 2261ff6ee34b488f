// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/sink.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "preprocess/input/scalar.h"

namespace pointrt {
namespace {

constexpr std::uint64_t kMaxPoints = kNoSensor - 1;

/// Grows by half at least, so that many small files do not copy the cloud over and over.
template <typename Item>
void makeRoom(std::vector<Item>& items, std::size_t room) {
    if (room > items.capacity()) items.reserve(std::max(room, items.capacity() + items.capacity() / 2));
}

/// The fill for vertices of files without the attribute, up to the current number of positions.
void fillMissing(Cloud& cloud, const Columns& columns) {
    const std::size_t count = cloud.positions.size();
    if (!cloud.normals.empty()) cloud.normals.resize(count, Vec3f::Zero());
    if (!cloud.colors.empty()) cloud.colors.resize(count, kGreyColor);
    if (!cloud.radii.empty()) cloud.radii.resize(count, 0.0f);
    fillAttributes(cloud, columns);
    if (!cloud.sensor_of_point.empty()) cloud.sensor_of_point.resize(count, kNoSensor);
}

Vec3d wholeNumbers(const Vec3d& position) {
    // Adding zero turns -0 into 0.
    return position.array().unaryExpr([](double value) { return std::trunc(value) + 0.0; });
}

/// Coordinates from there on stand for no data, as 1e30 and 1.70141e38 do in files of some programs: a .pro ends at
/// 1e30, cubes round discs included.
constexpr double kFarthest = 1e25;

/// Enough to tell the place of a scan from a mark for no data at its start.
constexpr std::size_t kFirstPositions = 256;

/// Each once: marks for no data come in numbers.
std::vector<Vec3d> distinct(std::vector<Vec3d> positions) {
    const auto key = [](const Vec3d& position) { return std::array{position.x(), position.y(), position.z()}; };
    std::sort(positions.begin(), positions.end(), [&](const Vec3d& a, const Vec3d& b) { return key(a) < key(b); });
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    return positions;
}

/// The middle one of each coordinate.
Vec3d medianOf(const std::vector<Vec3d>& positions) {
    Vec3d median;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const Vec3d& position : positions) values.push_back(position[axis]);
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        median[axis] = *middle;
    }
    return median;
}

/// The origin is the first position, unless that is a thousand times as far from the others as they are from each
/// other: 0 0 0 ahead of a scan in a national grid would round all of it to half a metre.
void settleOrigin(Sink& sink) {
    constexpr double kFar = 1000;
    sink.origin_settled = true;
    const std::vector<Vec3d> positions = std::exchange(sink.first_positions, {});
    const std::vector<Vec3d> places = distinct(positions);
    const Vec3d median = medianOf(places);
    std::vector<double> distances;
    for (const Vec3d& place : places) distances.push_back((place - median).norm());
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle == 0 || !((positions.front() - median).norm() > kFar * *middle)) return;
    Cloud& cloud = sink.cloud;
    cloud.origin = wholeNumbers(median);
    for (std::size_t i = 0; i < positions.size(); ++i) cloud.positions[i] = (positions[i] - cloud.origin).cast<float>();
}

bool addPosition(Sink& sink, const Vec3d& position) {
    Cloud& cloud = sink.cloud;
    if (!(position.cwiseAbs().maxCoeff() < kFarthest) || !position.allFinite()) return false;
    if (cloud.positions.empty()) cloud.origin = wholeNumbers(position);
    const Vec3f local = (position - cloud.origin).cast<float>();
    if (!local.allFinite()) return false;
    cloud.positions.push_back(local);
    if (sink.batches) {
        sink.batches->positions.push_back(position);
        return true;
    }
    if (sink.origin_settled) return true;
    sink.first_positions.push_back(position);
    if (sink.first_positions.size() == kFirstPositions) settleOrigin(sink);
    return true;
}

Vec3f cleanNormal(const Sink& sink, const Row& row) {
    const Vec3d normal(row[kNormalX], row[kNormalY], row[kNormalZ]);
    if (!normal.allFinite()) return Vec3f::Zero();
    // where nothing moves not even the sign of a zero does
    const bool moves = sink.world_from_scan || sink.world_from_input;
    const Vec3f rounded = (moves ? Vec3d(sink.normal_from_vertex * normal) : normal).cast<float>();
    return rounded.allFinite() ? rounded : Vec3f(Vec3f::Zero());
}

/// Zero, which stands for none, for what is no radius.
float cleanRadius(const Sink& sink, const Row& row) {
    const auto radius =
        static_cast<float>(row[kRadius] * std::cbrt(std::abs(sink.world_from_vertex.linear().determinant())));
    return std::isfinite(radius) && radius > 0 ? radius : 0.0f;
}

std::uint8_t toByte(double value) {
    if (!(value > 0)) return 0;
    return value < 255 ? static_cast<std::uint8_t>(value + 0.5) : std::uint8_t{255};
}

void addColor(Sink& sink, const Row& row, const char* values) {
    switch (sink.traits.color_scale) {
    case ColorScale::kByte:
        return sink.cloud.colors.push_back({toByte(row[kRed]), toByte(row[kGreen]), toByte(row[kBlue])});
    case ColorScale::k16Bit:
        if (!sink.rgb16_attribute)
            std::memcpy(sink.rgb16.emplace_back().data(), values + *sink.rgb16_offset, sizeof sink.rgb16.back());
        return;
    default:
        sink.wide_colors.push_back(
            {static_cast<float>(row[kRed]), static_cast<float>(row[kGreen]), static_cast<float>(row[kBlue])});
    }
}

void addColors16(Sink& sink, const char* column, std::span<const std::uint32_t> kept) {
    const std::size_t before = sink.rgb16.size();
    sink.rgb16.resize(before + kept.size());
    auto* to = sink.rgb16.data() + before;
    for (const std::uint32_t vertex : kept) std::memcpy(to++, column + vertex * sizeof *to, sizeof *to);
}

/// Of 16 bits the upper 8, as a shift would give them.
std::uint8_t upperByte(float value) { return toByte(std::floor(value / 256.0)); }

float largestWideColor(const Sink& sink) {
    float largest = 0;
    for (const auto& color : sink.wide_colors)
        for (const float value : color)
            if (std::isfinite(value)) largest = std::max(largest, value);
    return largest;
}

/// @param largest of all of the scan's colours
void scaleWideColors(Sink& sink, float largest) {
    const bool shares = sink.traits.color_scale == ColorScale::kReal && largest <= 1;
    const bool wide = largest > 255;
    auto scaled = [&](float value) { return shares ? toByte(255.0 * value) : wide ? upperByte(value) : toByte(value); };
    for (const auto& color : sink.wide_colors)
        sink.cloud.colors.push_back({scaled(color[0]), scaled(color[1]), scaled(color[2])});
    sink.wide_colors = {};
}

using Rgb16 = std::array<std::uint16_t, 3>;

/// The 16-bit colours of the scan's points that the cloud has.
struct Colors16 {
    const char* first;
    std::size_t count;

    explicit Colors16(const Sink& sink)
        : first(sink.rgb16_attribute
                    ? sink.cloud.attributes[*sink.rgb16_attribute].values.data() + sink.first_position * sizeof(Rgb16)
                    : reinterpret_cast<const char*>(sink.rgb16.data())),
          count(sink.cloud.positions.size() - sink.first_position) {}

    Rgb16 at(std::size_t i) const {
        Rgb16 color;
        std::memcpy(color.data(), first + i * sizeof color, sizeof color);
        return color;
    }

    std::uint16_t largest() const {
        std::uint16_t value = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb16 color = at(i);
            value = std::max({value, color[0], color[1], color[2]});
        }
        return value;
    }
};

void noteBlack(Sink& sink, const Source& source) {
    addNote(sink.cloud, source.name, "has room for colours, but all are black: it is read as one without");
}

/// @param largest of all of the scan's colours; where that is 0 there are none
void scale16BitColors(Sink& sink, float largest) {
    const Colors16 colors(sink);
    const int shift = largest > 255 ? 8 : 0;
    const auto scaled = [shift](std::uint16_t value) { return static_cast<std::uint8_t>(value >> shift); };
    for (std::size_t i = 0; i < colors.count && largest > 0; ++i) {
        const Rgb16 color = colors.at(i);
        sink.cloud.colors.push_back({scaled(color[0]), scaled(color[1]), scaled(color[2])});
    }
    sink.rgb16 = {};
}

float largestColor(const Sink& sink) {
    return sink.traits.color_scale == ColorScale::k16Bit ? Colors16(sink).largest() : largestWideColor(sink);
}

bool isScaledLater(const Sink& sink) { return sink.traits.colors && sink.traits.color_scale != ColorScale::kByte; }

void scaleColors(Sink& sink, float largest) {
    if (sink.traits.color_scale == ColorScale::k16Bit)
        scale16BitColors(sink, largest);
    else
        scaleWideColors(sink, largest);
}

void settleColors(Sink& sink, const Source& source) {
    if (!isScaledLater(sink)) return;
    const float largest = largestColor(sink);
    const bool is_black = sink.traits.color_scale == ColorScale::k16Bit && largest == 0;
    if (is_black && sink.cloud.positions.size() > sink.first_position) noteBlack(sink, source); // then grey, or none
    scaleColors(sink, largest);
}

/// Colours of the points that are to be handed on, by what an earlier reading found or, in that one, none.
void settleBatchColors(Sink& sink) {
    if (!isScaledLater(sink)) return;
    Batches& batches = *sink.batches;
    const std::size_t scan = sink.scans.size();
    if (batches.scales_known) return scaleColors(sink, batches.largest_color.at(scan));
    batches.largest_color.resize(scan + 1);
    batches.largest_color[scan] = std::max(batches.largest_color[scan], largestColor(sink));
    sink.wide_colors.clear();
    sink.rgb16.clear();
}

/// Hands on what the cloud has of the scan.
void handOn(Sink& sink) {
    if (sink.cloud.positions.empty()) return;
    Batches& batches = *sink.batches;
    settleBatchColors(sink);
    fillMissing(sink.cloud, sink.columns);
    for (const Vec3d& position : batches.positions) batches.scan_box.extend(position);
    batches.take({sink.cloud, batches.positions, sink.scans.size(), sink.columns.loose});
    batches.handed_on += batches.positions.size();
    batches.empty(sink.cloud);
}

void handOnIfFull(Sink& sink) {
    if (sink.batches && sink.cloud.positions.size() >= sink.batches->points) handOn(sink);
}

/// What only the first reading tells, and only at the end of a scan.
void finishBatches(Sink& sink, const Source& source) {
    if (!sink.cloud.triangles.empty()) refuse(source, "has faces, of which no points can be handed on");
    handOn(sink);
    Batches& batches = *sink.batches;
    const std::size_t scan = sink.scans.size();
    batches.largest_color.resize(std::max(batches.largest_color.size(), scan + 1));
    const bool is_black = isScaledLater(sink) && sink.traits.color_scale == ColorScale::k16Bit &&
                          batches.largest_color[scan] == 0 && keptPoints(sink) > sink.kept_before;
    if (is_black) noteBlack(sink, source);
    batches.colors |= sink.traits.colors && !is_black;
}

/// File indices to cloud indices. False when a corner was dropped; the others are bereft.
bool settleTriangle(Sink& sink, const Source& source, std::array<std::uint32_t, 3>& triangle) {
    std::size_t there = 0;
    for (const std::uint32_t corner : triangle) {
        if (corner >= sink.vertices) refuse(source, fmt::format("face: vertex index {} is out of range", corner));
        const auto before = std::lower_bound(sink.dropped.begin(), sink.dropped.end(), corner);
        if (before != sink.dropped.end() && *before == corner) continue;
        triangle[there++] = static_cast<std::uint32_t>(corner - (before - sink.dropped.begin()) + sink.first_position);
    }
    if (there < 3) sink.bereft.insert(sink.bereft.end(), triangle.begin(), triangle.begin() + std::ptrdiff_t(there));
    return there == 3;
}

/// A triangle with a dropped vertex goes.
void settleTriangles(Sink& sink, const Source& source) {
    auto& triangles = sink.cloud.triangles;
    std::size_t kept = sink.first_triangle;
    for (std::size_t i = sink.first_triangle; i < triangles.size(); ++i) {
        auto triangle = triangles[i];
        if (settleTriangle(sink, source, triangle)) triangles[kept++] = triangle;
    }
    triangles.resize(kept);
}

std::optional<std::size_t> columnOf(const ScanTraits& traits, std::string_view name) {
    for (std::size_t i = 0; i < traits.columns.size(); ++i)
        if (traits.columns[i].name == name) return i;
    return std::nullopt;
}

/// Where a column's value lies in a vertex's packed values.
std::optional<std::size_t> offsetOf(const ScanTraits& traits, std::string_view name) {
    std::size_t offset = 0;
    for (const ColumnTraits& column : traits.columns) {
        if (column.name == name) return offset;
        offset += scalarSize(column.type) * column.components;
    }
    return std::nullopt;
}

void beginAttributes(Sink& sink, const Source& source, const ScanTraits& traits, std::size_t room) {
    sink.rgb16_offset = offsetOf(traits, kRgb16);
    sink.class_offset = offsetOf(traits, kClassification);
    sink.rgb16_column = columnOf(traits, kRgb16);
    sink.class_column = columnOf(traits, kClassification);
    for (const ColumnTraits& column : traits.columns)
        if (column.name == kClassification) sink.class_type = column.type;
    if (sink.filter.choosesClasses() && !sink.class_offset) refuse(source, "has no classes to choose from");
    try {
        beginColumns(sink.columns, sink.cloud, traits.columns, sink.attributes, room);
    } catch (const Error& error) {
        refuse(source, error.what());
    }
    sink.rgb16_attribute.reset();
    for (const Columns::Column& column : sink.columns.wanted)
        if (sink.cloud.attributes[column.attribute].name == kRgb16 && column.type == Scalar::kU16 &&
            sink.cloud.attributes[column.attribute].type == Scalar::kU16)
            sink.rgb16_attribute = column.attribute;
}

void placeScan(Sink& sink) {
    sink.world_from_vertex = sink.world_from_input.value_or(Eigen::Affine3d::Identity());
    if (sink.world_from_scan) {
        Eigen::Affine3d pose(sink.world_from_scan->linear);
        pose.translation() = sink.world_from_scan->translation;
        sink.world_from_vertex = sink.world_from_vertex * pose;
    }
    // Normals are turned by the inverse transpose; a rotation is its own, and keeps every bit.
    const Eigen::Matrix3d linear = sink.world_from_vertex.linear();
    const bool rigid = (linear * linear.transpose()).isIdentity(1e-9);
    sink.normal_from_vertex = rigid ? linear : Eigen::Matrix3d(linear.inverse().transpose());
}

/// The class of a vertex; 0, never classified, where it is none of the 256 that there are.
std::uint8_t classAt(const char* value, Scalar type) {
    const double number = loadScalar(value, type, false);
    return number >= 0 && number <= 255 ? static_cast<std::uint8_t>(number) : std::uint8_t{0};
}

std::uint8_t classOf(const Sink& sink, const char* values) {
    return sink.class_offset ? classAt(values + *sink.class_offset, sink.class_type) : std::uint8_t{0};
}

/// A vertex that does not stay; faces have to know which.
void drop(Sink& sink, std::uint64_t index) {
    if (sink.traits.faces) sink.dropped.push_back(static_cast<std::uint32_t>(index));
}

void requirePoints(const Sink& sink, const Source& source, std::size_t kept) {
    if (sink.vertices == 0) refuse(source, "holds no points");
    if (kept > 0) return;
    if (sink.non_finite == sink.vertices)
        refuse(source, fmt::format("none of its {} points is finite and within {:g}", sink.vertices, kFarthest));
    refuse(source, fmt::format("none of its {} points is asked for", sink.vertices));
}

} // namespace

std::uint64_t keptPoints(const Sink& sink) {
    return (sink.batches ? sink.batches->handed_on : 0) + sink.cloud.positions.size();
}

ScanBox boxOfScan(const Sink& sink) {
    if (sink.batches) return {sink.batches->scan_box.center(), sink.batches->scan_box.sizes()};
    Eigen::AlignedBox3f box;
    for (std::size_t i = sink.scans.back().first_position; i < sink.cloud.positions.size(); ++i)
        box.extend(sink.cloud.positions[i]);
    return {sink.cloud.origin + box.center().cast<double>(), box.sizes().cast<double>()};
}

void beginScan(Sink& sink, const Source& source, const ScanTraits& traits) {
    Cloud& cloud = sink.cloud;
    if (!sink.batches && traits.vertices > kMaxPoints - cloud.positions.size() && !sink.filter.drops())
        refuse(source, fmt::format("more than {} points in all", kMaxPoints));
    sink.traits = traits;
    sink.vertices = sink.non_finite = 0;
    sink.dropped.clear();
    sink.wide_colors.clear();
    sink.rgb16.clear();
    sink.sensor.reset();
    sink.grid = {};
    sink.first_position = cloud.positions.size();
    sink.first_triangle = cloud.triangles.size();
    sink.kept_before = keptPoints(sink);
    if (sink.batches) sink.batches->scan_box.setEmpty();
    placeScan(sink);
    // what a filter leaves is not known before
    const std::uint64_t vertices = sink.filter.drops() ? 0 : traits.vertices;
    const std::size_t room =
        sink.batches ? std::min<std::uint64_t>(vertices, sink.batches->points) : sink.first_position + vertices;
    makeRoom(cloud.positions, room);
    if (traits.normals) {
        makeRoom(cloud.normals, room);
        cloud.normals.resize(sink.first_position, Vec3f::Zero());
        cloud.normal_sides = cloud.normal_sides && traits.normal_sides;
    }
    if (traits.colors) {
        makeRoom(cloud.colors, room);
        cloud.colors.resize(sink.first_position, kGreyColor);
    }
    if (traits.radii) {
        makeRoom(cloud.radii, room);
        cloud.radii.resize(sink.first_position, 0.0f);
    }
    beginAttributes(sink, source, traits, room);
}

std::uint32_t addVertex(Sink& sink, const Row& row, const char* values) {
    const Vec3d position = sink.world_from_vertex * Vec3d(row[kX], row[kY], row[kZ]);
    const std::uint64_t index = sink.vertices++;
    constexpr std::uint64_t kStep = 1 << 16; // often enough for a progress line, too rarely to cost time
    if (index % kStep == 0 && sink.progress && sink.traits.vertices > 0)
        sink.progress(std::min(1.0, static_cast<double>(index) / static_cast<double>(sink.traits.vertices)));
    if (index >= kMaxPoints && !sink.batches)
        throw Error(ExitCode::kBadInput, fmt::format("more than {} points in one file", kMaxPoints));
    if (sink.filter.drops() && position.allFinite() && !sink.filter.keeps(position, classOf(sink, values))) {
        drop(sink, index);
        return RangeGrid::kLeftOut;
    }
    if (!addPosition(sink, position)) {
        ++sink.non_finite;
        drop(sink, index);
        return RangeGrid::kNoPoint;
    }
    if (sink.traits.normals) sink.cloud.normals.push_back(cleanNormal(sink, row));
    if (sink.traits.radii) sink.cloud.radii.push_back(cleanRadius(sink, row));
    if (sink.traits.colors) addColor(sink, row, values);
    if (!sink.columns.wanted.empty()) addValues(sink.columns, sink.cloud, values);
    handOnIfFull(sink);
    return static_cast<std::uint32_t>(sink.cloud.positions.size() - 1);
}

void addVertices(Sink& sink, std::span<const Vec3d> positions, std::span<const char* const> columns) {
    const std::size_t size = scalarSize(sink.class_type);
    std::vector<std::uint32_t> kept;
    kept.reserve(positions.size());
    const bool filters = sink.filter.drops();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3d position = sink.world_from_vertex * positions[i];
        const std::uint8_t point_class = filters && sink.class_column
                                             ? classAt(columns[*sink.class_column] + i * size, sink.class_type)
                                             : std::uint8_t{0};
        if (filters && position.allFinite() && !sink.filter.keeps(position, point_class)) continue;
        if (addPosition(sink, position))
            kept.push_back(static_cast<std::uint32_t>(i));
        else
            ++sink.non_finite;
    }
    if (sink.traits.colors && !sink.rgb16_attribute) addColors16(sink, columns[*sink.rgb16_column], kept);
    addColumns(sink.columns, sink.cloud, columns, kept, positions.size());
    handOnIfFull(sink);
    sink.vertices += positions.size();
    if (sink.vertices > kMaxPoints && !sink.batches)
        throw Error(ExitCode::kBadInput, fmt::format("more than {} points in one file", kMaxPoints));
    if (sink.progress && sink.traits.vertices > 0)
        sink.progress(std::min(1.0, static_cast<double>(sink.vertices) / static_cast<double>(sink.traits.vertices)));
}

void skipVertex(Sink& sink) { drop(sink, sink.vertices++); }

void addPolygon(Sink& sink, std::span<const std::uint32_t> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        sink.cloud.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void finishScan(Sink& sink, const Source& source, const std::string& title, Emptiness emptiness) {
    Cloud& cloud = sink.cloud;
    const std::size_t kept = keptPoints(sink) - sink.kept_before;
    if (emptiness == Emptiness::kRefused) requirePoints(sink, source, kept);
    if (cloud.positions.size() > kMaxPoints) refuse(source, fmt::format("more than {} points in all", kMaxPoints));
    if (sink.batches) {
        finishBatches(sink, source);
    } else {
        if (!sink.origin_settled && kept > 0) settleOrigin(sink);
        settleColors(sink, source);
        settleTriangles(sink, source);
    }
    fillMissing(cloud, sink.columns);
    cloud.points_read += sink.vertices;
    cloud.points_non_finite += sink.non_finite;
    cloud.points_filtered += sink.vertices - sink.non_finite - kept;
    sink.scans.push_back({source.name, sink.kept_before, kept, cloud.triangles.size() > sink.first_triangle});
    cloud.scans.push_back({title.empty() ? source.name : source.name + ": " + title, {}, sink.kept_before});
    if (sink.sensor) setSensor(sink, sink.world_from_vertex * *sink.sensor);
    finishGrid(sink, source);
}

void addNote(Cloud& cloud, const std::string& file, const std::string& text) {
    for (Note& note : cloud.notes) {
        if (note.text != text) continue;
        note.more_files += note.file != file;
        return;
    }
    cloud.notes.push_back({file, text});
}

void setWorldFrame(Sink& sink, const Source& source, const WorldFrame& frame) {
    WorldFrame placed = frame;
    if (sink.world_from_input) {
        const Eigen::Matrix3d linear = sink.world_from_input->linear();
        placed.up = (linear * frame.up).stableNormalized();
        placed.metres_per_unit = frame.metres_per_unit / std::cbrt(std::abs(linear.determinant()));
        placed.crs.clear(); // it says where the file's own coordinates are
    }
    WorldFrame& world = sink.cloud.world;
    if (std::exchange(sink.first_frame, false)) {
        world = placed;
        return;
    }
    if (world.crs != placed.crs) {
        if (!world.crs.empty() && !placed.crs.empty())
            addNote(sink.cloud, source.name, "is in another coordinate system than a file before it");
        world.crs.clear();
    }
    if (!world.up.isApprox(placed.up)) world.up.setZero();
    world.up_by_custom &= placed.up_by_custom;
    world.from_above &= placed.from_above;
    if (world.metres_per_unit != placed.metres_per_unit) world.metres_per_unit = 0;
}

void setSensor(Sink& sink, const Vec3d& world_position) {
    Cloud& cloud = sink.cloud;
    const ScanRange& scan = sink.scans.back();
    const Vec3f local = (world_position - cloud.origin).cast<float>();
    if (!local.allFinite()) return;
    cloud.scans.back().sensor = world_position;
    if (sink.batches) return; // the scan tells, its points are gone
    cloud.sensor_of_point.resize(cloud.positions.size(), kNoSensor);
    const auto first = cloud.sensor_of_point.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
    std::fill_n(first, scan.position_count, static_cast<std::uint32_t>(cloud.sensors.size()));
    cloud.sensors.push_back(local);
}

void setSensorAlongZ(Sink& sink) {
    // So many diagonals of the scan away it sees all of it within 3 degrees of its direction (atan(0.5 / 10)).
    constexpr double kSensorDiagonals = 10;
    const Cloud& cloud = sink.cloud;
    const ScanRange& scan = sink.scans.back();
    const Eigen::Affine3d scan_from_world = sink.world_from_vertex.inverse();
    Eigen::AlignedBox3d box; // in the scan's frame
    for (std::size_t i = 0; i < scan.position_count; ++i)
        box.extend(scan_from_world * (cloud.origin + cloud.positions[scan.first_position + i].cast<double>()));
    setSensor(sink, sink.world_from_vertex * (box.center() + Vec3d(0, 0, kSensorDiagonals * box.diagonal().norm())));
}

} // namespace pointrt
