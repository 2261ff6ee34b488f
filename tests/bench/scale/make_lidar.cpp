// SPDX-License-Identifier: Apache-2.0
// Makes any number of lidar points from a real tile, for measurements at scale: make_lidar TILE.laz N FOLDER writes
// FOLDER/scan_0000.laz, scan_0001.laz ... of 10 million points each.
//
// Copies of the tile fill rows of a square. Each copy is the mirror image of its neighbours, so that heights, density
// and colours are continuous across borders. Long waves across the whole ground make the heights of copies differ, and
// each point is moved by up to a sixth of the spacing, so that no two copies are equal. Otherwise records are those of
// the tile in its order, with returns, classes and colours. The same arguments give the same bytes. Existing files are
// skipped, so an interrupted run can be repeated; --first and --files make a part.
//
// Memory holds the tile, at most 2^25 points, and the buffers of compression.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <vector>

#include "format/os/atomic_file.h"
#include "format/os/mapped_file.h"
#include "format/pointio/las_writer.h"
#include "format/pointio/laz.h"
#include "tests/bench/compare_options.h"

namespace pointrt::test {

namespace {

namespace fs = std::filesystem;

struct Request {
    std::string tile, folder;
    std::uint64_t points = 0, per_file = 10'000'000, seed = 1;
    std::uint64_t first = 0, files = UINT64_MAX; ///< those to write
    bool las = false;
};

constexpr std::uint64_t kTilePointsMax = 1u << 25; // 1 GB at 34 bytes each
constexpr std::size_t kPointsAtOnce = 1 << 16;

/// A tile's points as integers from 0 to size.
struct Tile {
    LasHeader header;
    std::vector<char> records;
    std::array<std::int32_t, 2> size{}; ///< x, y
    double spacing = 0;                 ///< raw numbers, as if they lay evenly

    std::uint64_t points() const { return records.size() / header.record_bytes; }
};

std::int32_t coordinate(const char* record, std::size_t axis) {
    std::int32_t value;
    std::memcpy(&value, record + 4 * axis, sizeof value);
    return value;
}

void setCoordinate(char* record, std::size_t axis, std::int64_t value) {
    const auto whole = static_cast<std::int32_t>(value);
    if (whole != value) throw Error(ExitCode::kBadInput, "so many points do not fit in the numbers of LAS");
    std::memcpy(record + 4 * axis, &whole, sizeof whole);
}

std::vector<char> readRecords(const LasFile& file, std::uint64_t points) {
    const std::size_t bytes = file.header.record_bytes;
    std::vector<char> records(points * bytes);
    if (!file.header.packed) {
        std::memcpy(records.data(), file.bytes.data() + file.header.point_offset, records.size());
        return records;
    }
    const LazLayout layout = lazLayout(file);
    std::uint64_t done = 0;
    for (const LazChunk& chunk : layout.chunks) {
        LazStream stream(layout, file.bytes, chunk);
        const std::uint64_t count = std::min(chunk.points, points - done);
        stream.read(records.data() + done * bytes, count);
        done += count;
    }
    return records;
}

/// Moves the lowest corner to 0.
void measure(Tile& tile) {
    const std::size_t bytes = tile.header.record_bytes;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        std::int32_t low = INT32_MAX, high = INT32_MIN;
        for (std::size_t at = 0; at < tile.records.size(); at += bytes) {
            low = std::min(low, coordinate(&tile.records[at], axis));
            high = std::max(high, coordinate(&tile.records[at], axis));
        }
        for (std::size_t at = 0; at < tile.records.size(); at += bytes)
            setCoordinate(&tile.records[at], axis, std::int64_t{coordinate(&tile.records[at], axis)} - low);
        tile.size[axis] = high - low + 1;
        tile.header.offset[axis] += low * tile.header.scale[axis];
    }
    tile.spacing = std::sqrt(double(tile.size[0]) * tile.size[1] / static_cast<double>(tile.points()));
}

Tile readTile(const std::string& path) {
    format::MappedFile mapped;
    if (!mapped.map(path.c_str())) throw Error(ExitCode::kBadInput, path + ": " + mapped.error());
    const LasFile file = openLas({reinterpret_cast<const char*>(mapped.bytes().data()), mapped.bytes().size()});
    Tile tile;
    tile.header = file.header;
    tile.records = readRecords(file, std::min(file.header.point_count, kTilePointsMax));
    if (tile.points() == 0) throw Error(ExitCode::kBadInput, path + ": has no points");
    measure(tile);
    return tile;
}

/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014: splitmix64.
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/// Places and modifies copies of the tile.
struct Layout {
    const Tile& tile;
    std::uint64_t columns, seed;

    /// Writes point number `at` to record.
    void place(std::uint64_t at, char* record) const {
        const std::uint64_t copy = at / tile.points(), row = copy / columns;
        const std::uint64_t along = copy % columns, column = row % 2 == 0 ? along : columns - 1 - along;
        const std::size_t bytes = tile.header.record_bytes;
        std::memcpy(record, &tile.records[at % tile.points() * bytes], bytes);
        const std::uint64_t random = mixed(mixed(seed) + at * 0x9E3779B97F4A7C15u);
        const std::array<std::uint64_t, 2> cell{column, row};
        std::array<double, 2> place;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const std::int64_t inside = coordinate(record, axis), size = tile.size[axis];
            const std::int64_t mirrored = cell[axis] % 2 == 0 ? inside : size - 1 - inside;
            const auto start = static_cast<std::int64_t>(cell[axis]) * size;
            const std::int64_t moved = mirrored + jitter(random >> (20 * axis), tile.spacing / 6);
            setCoordinate(record, axis, start + std::clamp<std::int64_t>(moved, 0, size - 1));
            place[axis] = static_cast<double>(start + mirrored) / size;
        }
        const std::int64_t height = coordinate(record, 2) + wave(place) + jitter(random >> 40, tile.spacing / 40);
        setCoordinate(record, 2, height);
    }

private:
    /// From -reach to reach, by 20 random bits.
    static std::int64_t jitter(std::uint64_t random, double reach) {
        const double share = static_cast<double>(random & 0xFFFFF) / 0x80000 - 1;
        return std::llround(share * reach);
    }

    /// Height of the ground's waves: a period of 12 tiles, and 1% of that high.
    std::int64_t wave(const std::array<double, 2>& place) const {
        constexpr double kAcross = 12, kSlope = 0.01;
        const double turn = 2 * std::numbers::pi / kAcross;
        const double height = kSlope * kAcross / 2 * tile.size[0];
        return std::llround(height * tile.header.scale[0] / tile.header.scale[2] *
                            (std::sin(turn * place[0]) * std::sin(turn * (place[1] + 0.37 * place[0]))));
    }
};

std::string nameOf(const Request& request, std::uint64_t file) {
    char name[32];
    std::snprintf(name, sizeof name, "scan_%04llu.%s", static_cast<unsigned long long>(file),
                  request.las ? "las" : "laz");
    return (fs::path(request.folder) / name).string();
}

void writeFile(const Layout& layout, const std::string& path, std::uint64_t begin, std::uint64_t end, bool packed) {
    LasDescription description;
    description.header = layout.tile.header;
    description.header.packed = packed;
    description.header.point_count = end - begin;
    format::AtomicFile out;
    LasWriter writer(description, {[&](const void* data, std::size_t bytes) { return out.write(data, bytes); },
                                   [&](std::uint64_t at, const void* data, std::size_t bytes) {
                                       return out.overwrite(at, data, bytes);
                                   }});
    bool good = out.open(path);
    const std::size_t bytes = layout.tile.header.record_bytes;
    std::vector<char> records(kPointsAtOnce * bytes);
    for (std::uint64_t at = begin; good && at < end; at += kPointsAtOnce) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kPointsAtOnce, end - at));
        for (std::size_t i = 0; i < count; ++i) layout.place(at + i, &records[i * bytes]);
        good = writer.add(records.data(), count);
    }
    if (!good || !writer.finish() || !out.commit()) throw Error(ExitCode::kCannotWrite, path + ": " + out.error());
}

int makeLidar(const Request& request) {
    const Tile tile = readTile(request.tile);
    const std::uint64_t copies = (request.points + tile.points() - 1) / tile.points();
    const auto columns = static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(copies))));
    const Layout layout{tile, columns, request.seed};
    fs::create_directories(request.folder);
    const std::uint64_t all = (request.points + request.per_file - 1) / request.per_file;
    const std::uint64_t last = std::min(all - std::min(all, request.first), request.files) + request.first;
    for (std::uint64_t file = request.first; file < last; ++file) {
        const std::string path = nameOf(request, file);
        if (fs::exists(path)) continue;
        const std::uint64_t begin = file * request.per_file;
        writeFile(layout, path, begin, std::min(begin + request.per_file, request.points), !request.las);
    }
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt::test;
    CLI::App app("Lays a lidar tile out to any number of points, none of them equal.", "make_lidar");
    Request request;
    app.add_option("TILE", request.tile, "LAS or LAZ, a rectangle full of points")->required();
    app.add_option("N", request.points, "Points")->required()->check(CLI::Range(1ull, 1'000'000'000'000ull));
    app.add_option("FOLDER", request.folder)->required();
    app.add_option("--per-file", request.per_file, "Points")->check(CLI::Range(1ull, 4'000'000'000ull));
    app.add_option("--seed", request.seed, "Of how points are moved");
    app.add_option("--first", request.first, "Number of the first file to write");
    app.add_option("--files", request.files, "How many to write, at most");
    app.add_flag("--las", request.las, "Not packed");
    return runCompare(app, argc, argv, [&] { return makeLidar(request); });
}
