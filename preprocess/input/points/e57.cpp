// SPDX-License-Identifier: GPL-3.0-or-later
// ASTM E2807, "Standard Specification for 3D Imaging Data Exchange, Version 1.0".
#include "format/pointio/e57.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/points/e57_columns.h"

namespace pointrt {
namespace {

/// Points read at once: about 20 columns of 8 bytes fit in a core's cache.
constexpr std::size_t kBatch = 4096;
/// The same for a file that is salvaged, where a damaged batch is lost as a whole. A page of 1 KiB holds some 30
/// points.
constexpr std::size_t kSalvageBatch = 16;

/// Counts over all scans of a file, for notes.
struct ScanCounts {
    std::uint64_t points = 0, invalid = 0, directions = 0; ///< directions: invalid points with a valid direction
    std::uint64_t colors_invalid = 0, values_invalid = 0, colors_beyond = 0;
};

/// A batch of points, by columns.
struct Batch {
    const E57Scan& scan;
    const E57Plan& plan;
    std::vector<std::vector<std::int64_t>> raw; ///< [columns], for those in use; 8 bytes per number can hold every kind
    std::vector<void*> columns;

    Batch(const E57Scan& of_scan, const E57Plan& by_plan) : scan(of_scan), plan(by_plan), raw(scan.columns.size()) {
        for (std::size_t i = 0; i < raw.size(); ++i) {
            if (plan.used[i]) raw[i].resize(kBatch);
            columns.push_back(plan.used[i] ? raw[i].data() : nullptr);
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

    /// The value of a state column; 0 without one.
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

struct BatchReader {
    const Batch& batch;
    ScanCounts& counts;
    Row row{};
    std::vector<char> values;

    BatchReader(const Batch& of_batch, ScanCounts& into)
        : batch(of_batch), counts(into), values(batch.plan.value_bytes) {}

    /// Sets NaN, which is dropped and counted, if both kinds of coordinates are marked invalid: 1 means that only the
    /// direction is valid, 2 that nothing is.
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

    /// The value's share of the range between the scan's limits, clamped to [0, 1].
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
        constexpr double kGrey = 200; // as kGreyColor
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

/// Runs work and prefixes its errors with the file's name and the place.
template <typename Work>
auto naming(const InputFile& input, const std::string& place, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code, fmt::format("{}{}: {}", input.name, place.empty() ? "" : ":" + place, error.what()));
    }
}

Pose poseOf(const InputFile& input, const E57Scan& scan, const std::string& title) {
    const auto [w, x, y, z] = scan.rotation;
    const Eigen::Quaterniond rotation(w, x, y, z);
    const Vec3d translation(scan.translation[0], scan.translation[1], scan.translation[2]);
    if (!(rotation.norm() > 0) || !std::isfinite(rotation.norm()) || !translation.allFinite())
        refuseAt(input, title, "its pose is not a rotation and translation");
    return {rotation.normalized().toRotationMatrix(), translation};
}

/// The columns of the grid indices, if these are integers.
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

/// Whether the scanner was at the origin of the scan's frame. Merged scans have coordinates of a common frame, and an
/// identity pose or none.
bool isScannerFrame(const E57Scan& scan, const E57Plan& plan, const Pose& pose) {
    const auto is_index = [](const E57Column& column) {
        return column.name == kE57RowIndex || column.name == kE57ColumnIndex;
    };
    const bool is_grid = std::count_if(scan.columns.begin(), scan.columns.end(), is_index) == 2;
    return is_grid || plan.spherical || !pose.linear.isIdentity() || !pose.translation.isZero();
}

/// Title of a scan in messages: its name, or its number from 1.
std::string titleOf(const E57File& file, std::size_t number) {
    const std::string& name = file.scans[number].name;
    return name.empty() ? fmt::format("scan {}", number + 1) : inQuotes(name);
}

/// Reads a scan's points in batches.
struct ScanStream {
    E57Points points;
    ReleasePagesBehind release_pages;
    bool salvages;
    std::string fault; ///< the error that ended a scan which is salvaged

    ScanStream(const InputFile& input, const E57File& file, std::size_t number, bool does_salvage)
        : points(e57Points(file, number)), release_pages{input}, salvages(does_salvage) {}

    std::size_t read(const std::vector<void*>& columns) {
        release_pages(e57Position(points));
        if (!salvages) return readE57Points(points, kBatch, columns.data());
        if (!fault.empty()) return 0;
        try {
            return readE57Points(points, kSalvageBatch, columns.data());
        } catch (const Error& error) {
            fault = error.what();
            return 0;
        }
    }
};

/// Whether return indices start at 1, as in files converted from LAS, instead of at 0. Then the index of a pulse's last
/// return equals the number of its returns. Reads these two columns to find out.
bool countsReturnsFromOne(const InputFile& input, const E57File& file, std::size_t number, bool salvages) {
    const std::vector<E57Column>& columns = file.scans[number].columns;
    std::array<std::int64_t, kBatch> indices, counts;
    std::vector<void*> buffers;
    for (const E57Column& column : columns) {
        const bool whole = column.kind == E57Kind::kWhole;
        buffers.push_back(whole && column.name == kE57ReturnIndex   ? indices.data()
                          : whole && column.name == kE57ReturnCount ? counts.data()
                                                                    : nullptr);
    }
    if (std::count(buffers.begin(), buffers.end(), nullptr) + 2 != std::ssize(buffers)) return false;
    ScanStream stream(input, file, number, salvages);
    while (const std::size_t count = stream.read(buffers))
        for (std::size_t i = 0; i < count; ++i)
            if (counts[i] > 0 && indices[i] >= counts[i]) return true;
    return false;
}

/// The range of a scan's grid indices.
struct GridFrame {
    std::int64_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;

    std::uint64_t rows() const {
        return 1 + static_cast<std::uint64_t>(last_row) - static_cast<std::uint64_t>(first_row);
    }
    std::uint64_t columns() const {
        return 1 + static_cast<std::uint64_t>(last_column) - static_cast<std::uint64_t>(first_column);
    }

    /// Whether at least one in kCellsPerPoint cells has a point; few do, for example, in a part of a street cut from a
    /// scanner's sphere. Bounds memory by the size of the file.
    bool fits(std::uint64_t points) const {
        constexpr std::uint64_t kCellsPerPoint = 16;
        std::uint64_t cells = 0;
        return first_row <= last_row && first_column <= last_column && rows() > 0 && columns() > 0 &&
               !__builtin_mul_overflow(rows(), columns(), &cells) && cells / kCellsPerPoint <= points;
    }
};

/// Measured in a pass over these two columns, for files without usable limits.
GridFrame readGridFrame(const InputFile& input, const E57File& file, std::size_t number, const GridColumns& indices,
                        bool salvages) {
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min(),
                           kMost = std::numeric_limits<std::int64_t>::max();
    std::array<std::int64_t, kBatch> rows, columns;
    std::vector<void*> buffers(file.scans[number].columns.size());
    buffers[indices.row] = rows.data();
    buffers[indices.column] = columns.data();
    GridFrame frame{kMost, kLeast, kMost, kLeast};
    ScanStream stream(input, file, number, salvages);
    while (const std::size_t count = stream.read(buffers))
        for (std::size_t i = 0; i < count; ++i) {
            frame.first_row = std::min(frame.first_row, rows[i]);
            frame.last_row = std::max(frame.last_row, rows[i]);
            frame.first_column = std::min(frame.first_column, columns[i]);
            frame.last_column = std::max(frame.last_column, columns[i]);
        }
    return frame;
}

GridFrame gridFrameOf(const InputFile& input, const E57File& file, std::size_t number, const GridColumns& indices,
                      bool salvages) {
    const E57Scan& scan = file.scans[number];
    const E57Column &row = scan.columns[indices.row], &column = scan.columns[indices.column];
    const GridFrame by_limits{row.least, row.most, column.least, column.most};
    return by_limits.fits(scan.points) ? by_limits : readGridFrame(input, file, number, indices, salvages);
}

/// Puts a scan's points into the cells of its grid.
struct GridFiller {
    std::optional<GridColumns> indices;
    GridFrame frame;

    /// Begins the grid, if the scan has one.
    GridFiller(const InputFile& input, const E57File& file, std::size_t number, Sink& sink)
        : indices(gridColumnsOf(file.scans[number])) {
        if (indices) frame = gridFrameOf(input, file, number, *indices, sink.salvages);
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

/// Notes the fault; other scans of the file may be complete.
void noteFault(const InputFile& input, const std::string& title, const std::string& fault, std::uint64_t found,
               std::uint64_t promised, Sink& sink) {
    sink.note(input, fmt::format("{}: {}: {} of {} points are read", title, fault, found, promised));
    sink.points_promised += promised;
}

/// @param room number of points that the cloud will have after the file, 0 if unknown
void readScan(const InputFile& input, const E57File& file, std::size_t number, std::size_t room, Sink& sink,
              ScanCounts& counts) {
    const E57Scan& scan = file.scans[number];
    const std::string title = titleOf(file, number);
    const E57Plan plan =
        naming(input, title, [&] { return planE57(scan, countsReturnsFromOne(input, file, number, sink.salvages)); });
    const Pose pose = poseOf(input, scan, title);
    ScanStream stream = naming(input, title, [&] { return ScanStream(input, file, number, sink.salvages); });
    sink.transform.input_from_scan = pose;
    sink.beginScan(input, plan.traits);
    if (isScannerFrame(scan, plan, pose)) sink.setScanSensor(Vec3d::Zero());
    sink.reserve(room); // arrays that grow scan by scan would leave holes in memory and be copied again and again
    Batch batch(scan, plan);
    BatchReader reader(batch, counts);
    const GridFiller grid = naming(input, title, [&] { return GridFiller(input, file, number, sink); });
    const auto next = [&] {
        try {
            return stream.read(batch.columns);
        } catch (const Error& error) {
            throw Error(error.code, fmt::format("{}; {} of its {} points before it are intact: --salvage reads these",
                                                error.what(), sink.vertexCount(), scan.points));
        }
    };
    while (const std::size_t count = naming(input, title, next))
        for (std::size_t i = 0; i < count; ++i) {
            reader.read(i);
            grid.add(batch, i, sink.addVertex(reader.row, reader.values.data()), sink);
        }
    if (!stream.fault.empty()) noteFault(input, title, stream.fault, sink.vertexCount(), scan.points, sink);
    const bool alone = file.scans.size() == 1 && scan.name.empty();
    sink.finishScan(input, alone ? "" : scan.name.empty() ? title : scan.name, Emptiness::kAllowed);
    sink.transform.input_from_scan.reset();
    counts.points += scan.points;
}

void readScans(const InputFile& input, const E57File& file, Sink& sink, ScanCounts& counts) {
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
        readScan(input, file, i, room, sink, counts);
    }
    sink.progress = progress;
}

/// Whether text is WKT or an EPSG code; other contents are specific to the program that wrote them.
bool isCoordinateSystem(std::string_view text) {
    return text.starts_with("EPSG:") || (!text.empty() && text.back() == ']' && text.find('[') != text.npos);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

/// E57 is in metres. The standard does not define up; scanners and their software use z.
void setFrame(const InputFile& input, const E57File& file, Sink& sink) {
    const std::string_view system = trimmed(file.coordinate_metadata);
    const bool is_known = isCoordinateSystem(system);
    if (!system.empty() && !is_known)
        sink.note(input, fmt::format("its coordinate system is not recognised: {}", inQuotes(system)));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.up_by_custom = !is_known;
    frame.metres_per_unit = 1;
    if (is_known) frame.crs = system;
    sink.setWorldFrame(input, frame);
}

void note(const InputFile& input, Sink& sink, const ScanCounts& counts, std::size_t images) {
    const auto say = [&](std::uint64_t count, const std::string& text) {
        if (count > 0) sink.note(input, text);
    };
    say(counts.invalid,
        fmt::format("{} of its {} points are marked invalid and left out; {} of those have a valid direction",
                    counts.invalid, counts.points, counts.directions));
    say(counts.colors_invalid,
        fmt::format("{} of its colours are marked invalid: those points are grey", counts.colors_invalid));
    say(counts.colors_beyond, fmt::format("{} of its colour values are beyond the limits it declares for them: clamped",
                                          counts.colors_beyond));
    say(counts.values_invalid,
        fmt::format("{} of its intensities or times are marked invalid: they become NaN, or 0 in integers",
                    counts.values_invalid));
    say(images, fmt::format("also holds {} pictures, which are not read", images));
}

void requireKept(const InputFile& input, const ScanCounts& counts, std::size_t kept) {
    if (kept > 0) return;
    if (counts.points == 0) refuse(input, "holds no points");
    if (counts.invalid == counts.points)
        refuse(input, fmt::format("all of its {} points are marked invalid", counts.points));
    refuse(input, fmt::format("none of its {} points is finite and passes the filters", counts.points));
}

bool isE57Start(std::string_view bytes) { return bytes.starts_with("ASTM-E57"); }

void readE57(const InputFile& input, Sink& sink) {
    const E57File file = naming(input, "", [&] { return openE57(input.bytes); });
    if (file.scans.empty())
        refuse(input, file.images == 0 ? "holds no scans" : fmt::format("holds {} pictures and no scans", file.images));
    const std::uint64_t before = sink.pointCount();
    ScanCounts counts;
    setFrame(input, file, sink);
    readScans(input, file, sink, counts);
    requireKept(input, counts, sink.pointCount() - before);
    note(input, sink, counts, file.images);
}

} // namespace

const FormatReader readers::kE57{.isStart = isE57Start, .read = readE57, .readsInBatches = alwaysInBatches};

} // namespace pointrt
