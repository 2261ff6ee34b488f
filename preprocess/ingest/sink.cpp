// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/sink.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "preprocess/ingest/cloud_origin.h"
#include "preprocess/ingest/cloud_storage.h"
#include "preprocess/ingest/notes.h"
#include "preprocess/ingest/scalar.h"

namespace pointrt {
namespace {

/// Larger coordinates mark missing data, such as 1e30 and 1.70141e38 in files of some programs. A .pro allows up to
/// 1e30, including the cubes around discs.
constexpr double kFarthest = 1e25;

/// Runs for every point: three comparisons, which NaN fails.
bool isWithinReach(const Vec3d& position) {
    return std::abs(position.x()) < kFarthest && std::abs(position.y()) < kFarthest &&
           std::abs(position.z()) < kFarthest;
}

/// US survey feet are longer than international feet by 2e-6.
constexpr double kSameUnit = 1e-5;

/// Grows by at least half, so that many small files do not copy the cloud over and over.
template <typename Item>
void reserveAtLeast(std::vector<Item>& items, std::size_t length) {
    if (length > items.capacity()) items.reserve(std::max(length, items.capacity() + items.capacity() / 2));
}

/// A class number; 0 (never classified) if it is not in [0, 255].
std::uint8_t loadClass(const char* value, Scalar type) {
    const double number = loadScalar(value, type, false);
    return number >= 0 && number <= 255 ? static_cast<std::uint8_t>(number) : std::uint8_t{0};
}

WorldFrame transformed(const WorldFrame& frame, const Eigen::Affine3d& world_from_input) {
    WorldFrame moved = frame;
    const Eigen::Matrix3d linear = world_from_input.linear();
    moved.up = (linear * frame.up).stableNormalized();
    moved.metres_per_unit = frame.metres_per_unit / std::cbrt(std::abs(linear.determinant()));
    moved.crs.clear(); // valid only for the file's own coordinates
    return moved;
}

/// Keeps only the values of `world` that `other` agrees with.
void intersect(WorldFrame& world, const WorldFrame& other) {
    if (world.crs != other.crs) world.crs.clear();
    if (!world.up.isApprox(other.up)) world.up.setZero();
    world.up_by_custom &= other.up_by_custom;
    world.from_above &= other.from_above;
    if (world.metres_per_unit != other.metres_per_unit) world.metres_per_unit = 0;
}

} // namespace

Sink::Sink(Cloud& all_files, const SinkOptions& options)
    : cloud(all_files), attributes(options.attributes), level(options.level), skim(options.skim),
      scales_degrees(options.scales_degrees), gaussians_as_discs(options.gaussians_as_discs),
      drops_withheld(options.drops_withheld), salvages(options.salvages), filter(options.filter),
      storage_(std::make_unique<CloudStorage>(cloud, columns, paint)) {
    transform.world_from_input = options.world_from_input;
}

Sink::Sink(Cloud& all_files, const SinkOptions& options, BatchOptions batches) : Sink(all_files, options) {
    auto storage = std::make_unique<BatchStorage>(cloud, columns, paint, std::move(batches));
    batch_storage_ = storage.get();
    storage_ = std::move(storage);
}

void Sink::beginScan(const InputFile& input, const ScanTraits& traits) {
    if (keepsPoints() && traits.vertices > kMaxPoints - cloud.positions.size() && !filter.drops())
        refuse(input, fmt::format("more than {} points in all", kMaxPoints));
    scan_.number = scans.size();
    scan_.traits = traits;
    scan_.vertices = scan_.non_finite = scan_.withheld = scan_.no_data = 0;
    survey_ = {};
    dropped_.clear();
    for (const ScanNoData& each : known_no_data)
        if (each.scan == scan_.number) dropped_.push_back(each.points);
    scan_.first_position = cloud.positions.size();
    scan_.points_before = pointCount();
    scan_.sensor.reset();
    scan_.faces.begin(cloud, traits.faces);
    grid = {};
    storage_->beginScan();
    transform.update();
    // It is not known beforehand how many vertices pass a filter.
    const std::size_t length = storage_->lengthFor(filter.drops() ? 0 : traits.vertices);
    reserveArrays(length);
    beginColumns(input, length);
    scan_.colors.begin(traits, columns, cloud);
}

/// Arrays that the scan has, but the cloud had not, are filled for the earlier points.
void Sink::reserveArrays(std::size_t length) {
    const ScanTraits& traits = scan_.traits;
    const std::size_t count = scan_.first_position;
    reserveAtLeast(cloud.positions, length);
    if (traits.normals) {
        reserveAtLeast(cloud.normals, length);
        cloud.normals.resize(count, Vec3f::Zero());
        cloud.normal_sides = cloud.normal_sides && traits.normal_sides;
    }
    if (traits.colors) {
        reserveAtLeast(cloud.colors, length);
        cloud.colors.resize(count, kGreyColor);
    }
    if (traits.radii) {
        reserveAtLeast(cloud.radii, length);
        cloud.radii.resize(count, 0.0f);
    }
}

void Sink::beginColumns(const InputFile& input, std::size_t length) {
    class_column_ = findColumn(scan_.traits, kClassification);
    withheld_column_.reset();
    if (scan_.traits.withholds && drops_withheld) withheld_column_ = findColumn(scan_.traits, kWithheld);
    if (filter.selectsClasses() && !class_column_) refuse(input, "has no classes to select from");
    try {
        pointrt::beginColumns(columns, cloud, scan_.traits.columns, attributes, length);
    } catch (const Error& error) {
        refuse(input, error.what());
    }
}

void Sink::reserve(std::size_t points) {
    if (!keepsPoints()) return;
    cloud.positions.reserve(points);
    if (scan_.traits.normals) cloud.normals.reserve(points);
    if (scan_.traits.colors) cloud.colors.reserve(points);
    if (scan_.sensor) cloud.sensor_of_point.reserve(points);
    for (const Columns::Column& column : columns.selected) {
        Attribute& attribute = cloud.attributes[column.attribute];
        attribute.values.reserve(points * attribute.bytesEach());
    }
}

std::uint8_t Sink::classOf(const char* values) const {
    return class_column_ ? loadClass(values + class_column_->offset, class_column_->type) : std::uint8_t{0};
}

/// Positions that are not finite are not filtered: addPosition drops and counts them.
bool Sink::passesFilter(const Vec3d& position, std::uint8_t point_class) {
    return !position.allFinite() || filter.keeps(position, point_class);
}

bool Sink::addPosition(const Vec3d& position) {
    if (!isWithinReach(position)) return false;
    if (cloud.positions.empty()) cloud.origin = wholeNumbers(position);
    const Vec3f local = (position - cloud.origin).cast<float>();
    if (!local.allFinite()) return false;
    cloud.positions.push_back(local);
    storage_->positionAdded(position);
    return true;
}

/// The survey includes the points that are dropped, so that every pass finds and notes the same.
bool Sink::dropsNoData(const Vec3d& in_scan, const Vec3d& position) {
    const auto marks = [&](const NoData& each) { return each.marks(in_scan); };
    if (std::none_of(dropped_.begin(), dropped_.end(), marks) || !isWithinReach(position)) return false;
    survey_.add(in_scan);
    ++scan_.no_data;
    return true;
}

void Sink::reportProgress(std::uint64_t vertex) const {
    if (progress && scan_.traits.vertices > 0)
        progress(std::min(1.0, static_cast<double>(vertex) / static_cast<double>(scan_.traits.vertices)));
}

std::uint32_t Sink::addVertex(const Row& row, const char* values) {
    const Vec3d position = transform.position(row);
    const std::uint64_t index = scan_.vertices++;
    constexpr std::uint64_t kStep = 1 << 16; // often enough for a progress line, too rarely to cost time
    if (index % kStep == 0) reportProgress(index);
    if (index >= kMaxPoints && keepsPoints())
        throw Error(ExitCode::kBadInput, fmt::format("more than {} points in one file", kMaxPoints));
    if (filter.drops() && !passesFilter(position, classOf(values))) {
        scan_.faces.drop(index);
        return RangeGrid::kFilteredOut;
    }
    const Vec3d in_scan(row[kX], row[kY], row[kZ]);
    if (!dropped_.empty() && dropsNoData(in_scan, position)) {
        scan_.faces.drop(index);
        return RangeGrid::kFilteredOut;
    }
    if (!addPosition(position)) {
        ++scan_.non_finite;
        scan_.faces.drop(index);
        return RangeGrid::kNoPoint;
    }
    survey_.add(in_scan);
    if (scan_.traits.normals) cloud.normals.push_back(transform.normal(row));
    if (scan_.traits.radii) cloud.radii.push_back(transform.radius(row));
    if (scan_.traits.colors) scan_.colors.add(cloud, row, values);
    if (!columns.selected.empty()) addValues(columns, cloud, values);
    storage_->verticesAdded(scan_);
    return static_cast<std::uint32_t>(cloud.positions.size() - 1);
}

void Sink::addVertices(std::span<const Vec3d> positions, std::span<const char* const> arrays) {
    const bool filters = filter.drops();
    const char* const classes = filters && class_column_ ? arrays[class_column_->column] : nullptr;
    const char* const withheld = withheld_column_ ? arrays[withheld_column_->column] : nullptr;
    const std::size_t class_size = classes ? scalarSize(class_column_->type) : 0;
    std::vector<std::uint32_t> kept;
    kept.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (withheld && withheld[i] != 0) {
            ++scan_.withheld;
            continue;
        }
        const Vec3d position = transform.position(positions[i]);
        const std::uint8_t point_class =
            classes ? loadClass(classes + i * class_size, class_column_->type) : std::uint8_t{0};
        if (filters && !passesFilter(position, point_class)) continue;
        if (!dropped_.empty() && dropsNoData(positions[i], position)) continue;
        if (addPosition(position)) {
            kept.push_back(static_cast<std::uint32_t>(i));
            survey_.add(positions[i]);
        } else {
            ++scan_.non_finite;
        }
    }
    scan_.colors.addColumn(arrays, kept);
    addColumns(columns, cloud, arrays, kept, positions.size());
    storage_->verticesAdded(scan_);
    scan_.vertices += positions.size();
    if (scan_.vertices > kMaxPoints && keepsPoints())
        throw Error(ExitCode::kBadInput, fmt::format("more than {} points in one file", kMaxPoints));
    reportProgress(scan_.vertices);
}

void Sink::requirePoints(const InputFile& input, std::size_t kept) const {
    if (scan_.vertices == 0) refuse(input, "holds no points");
    if (kept > 0) return;
    if (scan_.non_finite == scan_.vertices)
        refuse(input, fmt::format("none of its {} points is finite and within {:g}", scan_.vertices, kFarthest));
    if (scan_.withheld == scan_.vertices)
        refuse(input,
               fmt::format("all of its {} points are flagged withheld; --keep-withheld keeps them", scan_.vertices));
    refuse(input, fmt::format("none of its {} points passes the filters", scan_.vertices));
}

void Sink::finishScan(const InputFile& input, const std::string& title, Emptiness emptiness) {
    const std::size_t kept = pointCount() - scan_.points_before;
    if (emptiness == Emptiness::kRefused) requirePoints(input, kept);
    if (cloud.positions.size() > kMaxPoints) refuse(input, fmt::format("more than {} points in all", kMaxPoints));
    storage_->finishScan(scan_, input);
    fillMissing(cloud, columns);
    cloud.points_read += scan_.vertices;
    cloud.points_non_finite += scan_.non_finite;
    cloud.points_withheld += scan_.withheld;
    cloud.points_no_data += scan_.no_data;
    cloud.points_filtered += scan_.vertices - scan_.non_finite - scan_.withheld - scan_.no_data - kept;
    scans.push_back({input.name, scan_.points_before, kept, scan_.faces.any(cloud)});
    cloud.scans.push_back({title.empty() ? input.name : input.name + ": " + title, {}, scan_.points_before});
    findNoReturns(input);
    if (scan_.sensor) setSensor(transform.position(*scan_.sensor));
    finishGrid(*this, input);
    findNoData(input);
    noteWithheld(input);
    storage_->releaseScan(scan_, input);
}

/// Splats and meshes have no missing points.
bool Sink::mayLackData() const { return finds_no_data && !scan_.traits.radii && !scan_.faces.any(cloud); }

/// Pulses without a return, which tell where the scanner is.
void Sink::findNoReturns(const InputFile& input) {
    const auto found = mayLackData() ? survey_.findNoReturns() : std::nullopt;
    if (!found) return;
    no_data.push_back({scans.size() - 1, *found, transform.scanFromWorld()});
    if (!scan_.sensor) scan_.sensor = Vec3d::Zero();
    note(input, fmt::format("has {} points with {}, which mark pulses without a return: they are left out, and the "
                            "scanner is assumed to be at that point",
                            found->points, nameOf(*found)));
}

/// Customary values are left out once all files are read or, if points are handed on before that, in the next pass.
void Sink::findNoData(const InputFile& input) {
    if (!mayLackData()) return;
    for (const NoData& each : survey_.find()) {
        if (each.is_customary) {
            no_data.push_back({scans.size() - 1, each, transform.scanFromWorld()});
            note(input, fmt::format("has points with {}, which marks missing data: they are left out", nameOf(each)));
        } else {
            note(input, fmt::format("has {} points with {}, far from all others: if this marks missing data, leave "
                                    "them out with --bounds",
                                    each.points, nameOf(each)));
        }
    }
}

void Sink::noteWithheld(const InputFile& input) {
    if (scan_.withheld > 0) note(input, "has points flagged withheld, which are left out; --keep-withheld keeps them");
}

void Sink::acceptShort(const InputFile& input, std::uint64_t found, std::uint64_t promised, const std::string& fault) {
    if (!salvages || found == 0)
        refuse(input, fmt::format("{}: found {} of {} points{}", fault, found, promised,
                                  found > 0 ? "; --salvage reads these" : ""));
    note(input, fmt::format("{}: {} of {} points are read", fault, found, promised));
    points_promised += promised;
}

void Sink::note(const InputFile& input, const std::string& text) { addNote(cloud, input.name, text); }

void Sink::addDegrees(const InputFile& input) {
    if (!scales_degrees) note(input, "is in degrees: x and y have a different unit from z");
    ++files_in_degrees;
}

void Sink::setWorldFrame(const InputFile& input, const WorldFrame& frame) {
    const WorldFrame moved = transform.world_from_input ? transformed(frame, *transform.world_from_input) : frame;
    files_with_crs += !frame.crs.empty();
    WorldFrame& world = cloud.world;
    if (!std::exchange(has_world_frame_, true)) {
        world = moved;
        return;
    }
    if (world.crs != moved.crs && !world.crs.empty() && !moved.crs.empty())
        note(input, "is in a different coordinate system from an earlier file");
    const bool other_unit = world.metres_per_unit > 0 && moved.metres_per_unit > 0 &&
                            std::abs(world.metres_per_unit / moved.metres_per_unit - 1) > kSameUnit;
    if (other_unit) note(input, "is in a different unit of length from an earlier file");
    intersect(world, moved);
}

void Sink::setSensor(const Vec3d& world_position) {
    const ScanRange& scan = scans.back();
    const Vec3f local = (world_position - cloud.origin).cast<float>();
    if (!local.allFinite()) return;
    cloud.scans.back().sensor = world_position;
    if (!keepsPoints()) return; // the cloud's points are gone, but the scan still has its sensor
    cloud.sensor_of_point.resize(cloud.positions.size(), kNoSensor);
    const auto first = cloud.sensor_of_point.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
    std::fill_n(first, scan.position_count, static_cast<std::uint32_t>(cloud.sensors.size()));
    cloud.sensors.push_back(local);
}

void Sink::setSensorAlongZ() {
    // From this far or farther, the directions to all points are within atan(0.5 / 10), 3 degrees.
    constexpr double kSensorDiagonals = 10;
    const ScanRange& scan = scans.back();
    const Eigen::Affine3d scan_from_world = transform.scanFromWorld();
    Eigen::AlignedBox3d box; // in the scan's frame
    for (std::size_t i = 0; i < scan.position_count; ++i)
        box.extend(scan_from_world * (cloud.origin + cloud.positions[scan.first_position + i].cast<double>()));
    setSensor(transform.position(Vec3d(box.center() + Vec3d(0, 0, kSensorDiagonals * box.diagonal().norm()))));
}

} // namespace pointrt
