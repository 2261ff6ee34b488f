// SPDX-License-Identifier: GPL-3.0-or-later
// ASTM E2807, "Standard Specification for 3D Imaging Data Exchange, Version 1.0".
#include "format/pointio/e57.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "preprocess/input/e57_columns.h"
#include "preprocess/input/formats.h"
#include "preprocess/input/scalar.h"
#include "preprocess/input/text.h"

namespace pointrt {
namespace {

/// Points read at once: with some 20 columns of 8 bytes they stay in a core's cache.
constexpr std::size_t kBatch = 4096;

/// What a user should know of all scans of a file.
struct Counts {
    std::uint64_t points = 0, invalid = 0, directions = 0; ///< directions: of the invalid ones
    std::uint64_t colors_invalid = 0, values_invalid = 0, colors_beyond = 0;
};

/// Columns of a batch, as read and as numbers.
struct Batch {
    const E57Scan& scan;
    const E57Plan& plan;
    std::vector<std::vector<std::int64_t>> raw; ///< of each wanted column: 8 bytes a number hold all kinds
    std::vector<void*> columns;

    Batch(const E57Scan& of_scan, const E57Plan& by_plan) : scan(of_scan), plan(by_plan), raw(scan.columns.size()) {
        for (std::size_t i = 0; i < raw.size(); ++i) {
            if (plan.wanted[i]) raw[i].resize(kBatch);
            columns.push_back(plan.wanted[i] ? raw[i].data() : nullptr);
        }
    }

    double number(std::size_t column, std::size_t i) const {
        const E57Column& facts = scan.columns[column];
        const char* const at = reinterpret_cast<const char*>(raw[column].data());
        switch (facts.kind) {
        case E57Kind::kWhole:
            return static_cast<double>(raw[column][i]);
        case E57Kind::kScaled:
            return static_cast<double>(raw[column][i]) * facts.scale + facts.offset;
        case E57Kind::kSingle:
            return loadScalar(at + i * sizeof(float), Scalar::kF32, false);
        case E57Kind::kDouble:
            break;
        }
        return loadScalar(at + i * sizeof(double), Scalar::kF64, false);
    }

    Vec3d numbers(const E57Triple& triple, std::size_t i) const {
        return {number(triple[0], i), number(triple[1], i), number(triple[2], i)};
    }

    /// 0 where no column says otherwise.
    double state(const std::optional<std::size_t>& column, std::size_t i) const {
        return column ? number(*column, i) : 0;
    }
};

/// From range, azimuth and elevation in radians.
Vec3d fromSpherical(const Vec3d& spherical) {
    const double range = spherical[0], azimuth = spherical[1], elevation = spherical[2];
    const double flat = range * std::cos(elevation);
    return {flat * std::cos(azimuth), flat * std::sin(azimuth), range * std::sin(elevation)};
}

void setPosition(Row& row, const Vec3d& position) { std::copy_n(position.data(), 3, &row[kX]); }

struct Reader {
    const Batch& batch;
    Counts& counts;
    Row row{};
    std::vector<char> values;

    Reader(const Batch& of_batch, Counts& into) : batch(of_batch), counts(into), values(batch.plan.value_bytes) {}

    /// NaN, which is left out and counted, where the file marks both kinds of coordinates as invalid: 1 stands for a
    /// direction alone, 2 for nothing.
    void readPosition(std::size_t i) {
        const E57Plan& plan = batch.plan;
        const double cartesian = plan.cartesian ? batch.state(plan.cartesian_invalid, i) : 2;
        if (cartesian == 0) return setPosition(row, batch.numbers(*plan.cartesian, i));
        const double spherical = plan.spherical ? batch.state(plan.spherical_invalid, i) : 2;
        if (spherical == 0) return setPosition(row, fromSpherical(batch.numbers(*plan.spherical, i)));
        ++counts.invalid;
        counts.directions += cartesian == 1 || spherical == 1;
        setPosition(row, Vec3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    }

    /// In [0, 1] between the scan's limits.
    double shareOf(const E57Limits& limits, double value) {
        const double share = (value - limits.least) / (limits.most - limits.least);
        counts.colors_beyond += share < 0 || share > 1;
        return share > 0 ? std::min(share, 1.0) : 0.0;
    }

    void setColor(std::size_t channel, double share) {
        if (!batch.plan.rgb16_offset) {
            row[kRed + channel] = 255 * share;
            return;
        }
        const auto wide = static_cast<std::uint16_t>(std::lround(65535 * share));
        std::memcpy(values.data() + *batch.plan.rgb16_offset + channel * sizeof wide, &wide, sizeof wide);
        row[kRed + channel] = wide >> 8;
    }

    void readColor(std::size_t i) {
        constexpr double kGrey = 200; // as points of other files without colours
        const E57Plan& plan = batch.plan;
        const bool invalid = batch.state(plan.color_invalid, i) != 0;
        counts.colors_invalid += invalid;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double value = batch.number((*plan.colors)[channel], i);
            if (!plan.scaled_colors)
                row[kRed + channel] = invalid ? 0 : value;
            else
                setColor(channel, invalid ? kGrey / 255 : shareOf(*batch.scan.color_limits[channel], value));
        }
    }

    void readAttribute(const E57Attribute& attribute, std::size_t i) {
        char* const into = values.data() + attribute.offset;
        const bool invalid = batch.state(attribute.invalid, i) != 0;
        counts.values_invalid += invalid;
        if (isReal(attribute.type)) {
            const double value = batch.number(attribute.column, i);
            storeScalar(into, attribute.type, invalid ? std::numeric_limits<double>::quiet_NaN() : value);
        } else {
            const std::int64_t value = invalid ? 0 : batch.raw[attribute.column][i] + attribute.add;
            storeWhole(into, attribute.type, static_cast<std::uint64_t>(value));
        }
    }

    void read(std::size_t i) {
        readPosition(i);
        if (batch.plan.normals) {
            const Vec3d normal = batch.numbers(*batch.plan.normals, i);
            std::copy_n(normal.data(), 3, &row[kNormalX]);
        }
        if (batch.plan.colors) readColor(i);
        for (const E57Attribute& attribute : batch.plan.attributes) readAttribute(attribute, i);
    }
};

/// Runs work whose errors lack the file's name and the place.
template <typename Work>
auto naming(const Source& source, const std::string& place, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code, fmt::format("{}{}: {}", source.name, place.empty() ? "" : ":" + place, error.what()));
    }
}

Pose poseOf(const Source& source, const E57Scan& scan, const std::string& title) {
    const auto [w, x, y, z] = scan.rotation;
    const Eigen::Quaterniond rotation(w, x, y, z);
    const Vec3d translation(scan.translation[0], scan.translation[1], scan.translation[2]);
    if (!(rotation.norm() > 0) || !std::isfinite(rotation.norm()) || !translation.allFinite())
        refuseAt(source, title, "its pose is no rotation and translation");
    return {rotation.normalized().toRotationMatrix(), translation};
}

/// The columns of the grid's indices, where these are whole numbers.
struct GridColumns {
    std::size_t row, column;
};

std::optional<GridColumns> gridColumnsOf(const E57Scan& scan) {
    std::optional<std::size_t> row, column;
    for (std::size_t i = 0; i < scan.columns.size(); ++i) {
        if (scan.columns[i].kind != E57Kind::kWhole) continue;
        if (scan.columns[i].name == kE57RowIndex) row = i;
        if (scan.columns[i].name == kE57ColumnIndex) column = i;
    }
    if (!row || !column) return std::nullopt;
    return GridColumns{*row, *column};
}

/// Whether the frame's origin is where the scanner stood. Scans that were put together to one have coordinates of a
/// common frame, and a pose that says nothing if any.
bool isScannerFrame(const E57Scan& scan, const E57Plan& plan, const Pose& pose) {
    const auto is_index = [](const E57Column& column) {
        return column.name == kE57RowIndex || column.name == kE57ColumnIndex;
    };
    const bool is_grid = std::count_if(scan.columns.begin(), scan.columns.end(), is_index) == 2;
    return is_grid || plan.spherical || !pose.linear.isIdentity() || !pose.translation.isZero();
}

/// What to call a scan in messages: its name, or its number from 1.
std::string titleOf(const E57File& file, std::size_t number) {
    const std::string& name = file.scans[number].name;
    return name.empty() ? fmt::format("scan {}", number + 1) : inQuotes(name);
}

/// A scan's points, batch by batch.
struct Stream {
    E57Points points;
    LetGoBehind let_go;

    Stream(const Source& source, const E57File& file, std::size_t number)
        : points(e57Points(file, number)), let_go{source} {}

    std::size_t read(const std::vector<void*>& columns) {
        let_go(e57Position(points));
        return readE57Points(points, kBatch, columns.data());
    }
};

/// Converters of LAS keep its numbers of returns, which start with 1: some are then as large as their count. It takes
/// one reading of these two columns to know.
bool countsReturnsFromOne(const Source& source, const E57File& file, std::size_t number) {
    const std::vector<E57Column>& columns = file.scans[number].columns;
    std::array<std::int64_t, kBatch> indices, counts;
    std::vector<void*> wanted;
    for (const E57Column& column : columns) {
        const bool whole = column.kind == E57Kind::kWhole;
        wanted.push_back(whole && column.name == kE57ReturnIndex   ? indices.data()
                         : whole && column.name == kE57ReturnCount ? counts.data()
                                                                   : nullptr);
    }
    if (std::count(wanted.begin(), wanted.end(), nullptr) + 2 != std::ssize(wanted)) return false;
    Stream stream(source, file, number);
    while (const std::size_t count = stream.read(wanted))
        for (std::size_t i = 0; i < count; ++i)
            if (counts[i] > 0 && indices[i] >= counts[i]) return true;
    return false;
}

/// The cells of a scan's indices.
struct GridFrame {
    std::int64_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;

    std::uint64_t rows() const {
        return 1 + static_cast<std::uint64_t>(last_row) - static_cast<std::uint64_t>(first_row);
    }
    std::uint64_t columns() const {
        return 1 + static_cast<std::uint64_t>(last_column) - static_cast<std::uint64_t>(first_column);
    }

    /// A grid has points in one of so many cells at least: a box of the street in the sphere of a scanner. That bounds
    /// the memory by the size of the file.
    bool fits(std::uint64_t points) const {
        constexpr std::uint64_t kCellsPerPoint = 16;
        std::uint64_t cells = 0;
        return first_row <= last_row && first_column <= last_column && rows() > 0 && columns() > 0 &&
               !__builtin_mul_overflow(rows(), columns(), &cells) && cells / kCellsPerPoint <= points;
    }
};

/// As the points have them, for files whose limits say nothing: it takes one reading of these two columns.
GridFrame readGridFrame(const Source& source, const E57File& file, std::size_t number, const GridColumns& indices) {
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min(),
                           kMost = std::numeric_limits<std::int64_t>::max();
    std::array<std::int64_t, kBatch> rows, columns;
    std::vector<void*> wanted(file.scans[number].columns.size());
    wanted[indices.row] = rows.data();
    wanted[indices.column] = columns.data();
    GridFrame frame{kMost, kLeast, kMost, kLeast};
    Stream stream(source, file, number);
    while (const std::size_t count = stream.read(wanted))
        for (std::size_t i = 0; i < count; ++i) {
            frame.first_row = std::min(frame.first_row, rows[i]);
            frame.last_row = std::max(frame.last_row, rows[i]);
            frame.first_column = std::min(frame.first_column, columns[i]);
            frame.last_column = std::max(frame.last_column, columns[i]);
        }
    return frame;
}

GridFrame gridFrameOf(const Source& source, const E57File& file, std::size_t number, const GridColumns& indices) {
    const E57Scan& scan = file.scans[number];
    const E57Column &row = scan.columns[indices.row], &column = scan.columns[indices.column];
    const GridFrame by_limits{row.least, row.most, column.least, column.most};
    return by_limits.fits(scan.points) ? by_limits : readGridFrame(source, file, number, indices);
}

/// Puts a scan's points into their cells.
struct GridFiller {
    std::optional<GridColumns> indices;
    GridFrame frame;

    /// Begins the grid, where the scan has one.
    GridFiller(const Source& source, const E57File& file, std::size_t number, Sink& sink)
        : indices(gridColumnsOf(file.scans[number])) {
        if (indices) frame = gridFrameOf(source, file, number, *indices);
        if (indices && !frame.fits(file.scans[number].points)) indices.reset();
        if (indices) beginGrid(sink, frame.rows(), frame.columns());
    }

    void add(const Batch& batch, std::size_t i, std::uint32_t vertex, Sink& sink) const {
        if (!indices) return;
        const auto from = [](std::int64_t index, std::int64_t first) {
            return static_cast<std::uint64_t>(index) - static_cast<std::uint64_t>(first);
        };
        setCell(sink, from(batch.raw[indices->row][i], frame.first_row),
                from(batch.raw[indices->column][i], frame.first_column), vertex);
    }
};

/// Arrays that grow scan by scan leave holes behind them, and are copied over and over.
void makeRoomForAll(Sink& sink, std::size_t points) {
    if (sink.batches) return;
    Cloud& cloud = sink.cloud;
    cloud.positions.reserve(points);
    if (sink.traits.normals) cloud.normals.reserve(points);
    if (sink.traits.colors) cloud.colors.reserve(points);
    if (sink.sensor) cloud.sensor_of_point.reserve(points);
    for (const Columns::Column& column : sink.columns.wanted) {
        Attribute& attribute = cloud.attributes[column.attribute];
        attribute.values.reserve(points * attribute.bytesEach());
    }
}

/// @param room of all points that the cloud will have after the file, 0 where that is not known
void readScan(const Source& source, const E57File& file, std::size_t number, std::size_t room, Sink& sink,
              Counts& counts) {
    const E57Scan& scan = file.scans[number];
    const std::string title = titleOf(file, number);
    const E57Plan plan =
        naming(source, title, [&] { return planE57(scan, countsReturnsFromOne(source, file, number)); });
    const Pose pose = poseOf(source, scan, title);
    Stream stream = naming(source, title, [&] { return Stream(source, file, number); });
    sink.world_from_scan = pose;
    beginScan(sink, source, plan.traits);
    if (isScannerFrame(scan, plan, pose)) sink.sensor = Vec3d::Zero();
    makeRoomForAll(sink, room);
    Batch batch(scan, plan);
    Reader reader(batch, counts);
    const GridFiller grid = naming(source, title, [&] { return GridFiller(source, file, number, sink); });
    const auto next = [&] { return stream.read(batch.columns); };
    while (const std::size_t count = naming(source, title, next))
        for (std::size_t i = 0; i < count; ++i) {
            reader.read(i);
            grid.add(batch, i, addVertex(sink, reader.row, reader.values.data()), sink);
        }
    const bool alone = file.scans.size() == 1 && scan.name.empty();
    finishScan(sink, source, alone ? "" : scan.name.empty() ? title : scan.name, Emptiness::kAllowed);
    sink.world_from_scan.reset();
    counts.points += scan.points;
}

void readScans(const Source& source, const E57File& file, Sink& sink, Counts& counts) {
    std::uint64_t all = 0, before = 0; // points
    for (const E57Scan& scan : file.scans) all += scan.points;
    const std::size_t room = sink.filter.drops() ? 0 : sink.cloud.positions.size() + all;
    const auto share_of = [&](std::uint64_t points) {
        return static_cast<double>(points) / static_cast<double>(std::max<std::uint64_t>(all, 1));
    };
    const auto progress = sink.progress;
    for (std::size_t i = 0; i < file.scans.size(); ++i) {
        const double first = share_of(before), last = share_of(before += file.scans[i].points);
        if (progress) sink.progress = [&](double share) { progress(first + share * (last - first)); };
        readScan(source, file, i, room, sink, counts);
    }
    sink.progress = progress;
}

/// Well-known text, or the number of a register: else the field holds something that no other program would know.
bool isCoordinateSystem(std::string_view text) {
    return text.starts_with("EPSG:") || (!text.empty() && text.back() == ']' && text.find('[') != text.npos);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

/// E57 is in metres; that z is up is what scanners and their programs do, the standard leaves it open.
void frameWorld(const Source& source, const E57File& file, Sink& sink) {
    const std::string_view system = trimmed(file.coordinate_metadata);
    const bool is_known = isCoordinateSystem(system);
    if (!system.empty() && !is_known)
        addNote(sink.cloud, source.name, fmt::format("its coordinate system is not understood: {}", inQuotes(system)));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.up_by_custom = !is_known;
    frame.metres_per_unit = 1;
    if (is_known) frame.crs = system;
    setWorldFrame(sink, source, frame);
}

void note(const Source& source, Sink& sink, const Counts& counts, std::size_t images) {
    const auto say = [&](std::uint64_t count, const std::string& text) {
        if (count > 0) addNote(sink.cloud, source.name, text);
    };
    say(counts.invalid, fmt::format("{} of its {} points are marked invalid, {} of them as directions alone: left out",
                                    counts.invalid, counts.points, counts.directions));
    say(counts.colors_invalid,
        fmt::format("{} of its colours are marked invalid: those points are grey", counts.colors_invalid));
    say(counts.colors_beyond,
        fmt::format("{} of its colour values are beyond the limits that it gives for them: cut off",
                    counts.colors_beyond));
    say(counts.values_invalid,
        fmt::format("{} of its intensities or times are marked invalid: they are kept as NaN, or 0 where whole",
                    counts.values_invalid));
    say(images, fmt::format("holds {} pictures too, which are not read", images));
}

void requireKept(const Source& source, const Counts& counts, std::size_t kept) {
    if (kept > 0) return;
    if (counts.points == 0) refuse(source, "holds no points");
    if (counts.invalid == counts.points)
        refuse(source, fmt::format("all of its {} points are marked invalid", counts.points));
    refuse(source, fmt::format("none of its {} points is finite and asked for", counts.points));
}

bool isE57Start(std::string_view bytes) { return bytes.starts_with("ASTM-E57"); }

void readE57(const Source& source, Sink& sink) {
    const E57File file = naming(source, "", [&] { return openE57(source.bytes); });
    if (file.scans.empty())
        refuse(source,
               file.images == 0 ? "holds no scans" : fmt::format("holds {} pictures and no scans", file.images));
    const std::uint64_t before = keptPoints(sink);
    Counts counts;
    frameWorld(source, file, sink);
    readScans(source, file, sink, counts);
    requireKept(source, counts, keptPoints(sink) - before);
    note(source, sink, counts, file.images);
}

} // namespace

const FormatReader readers::kE57{.isStart = isE57Start, .read = readE57, .readsInBatches = alwaysInBatches};

} // namespace pointrt
