// SPDX-License-Identifier: Apache-2.0
// Batches hold the same points as reading everything at once.
#include "preprocess/input/stream.h"

#include <algorithm>
#include <cstring>

#include "set_fixture.h"
#include "tests/support/las_file.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

/// Concatenates all batches of a second pass.
struct Collected {
    std::vector<Vec3d> positions;
    std::vector<Rgb8> colors;
    std::vector<std::vector<char>> attributes;
    std::vector<std::size_t> scans;

    void add(const PointBatch& batch) {
        const std::size_t count = batch.positions.size();
        positions.insert(positions.end(), batch.positions.begin(), batch.positions.end());
        colors.insert(colors.end(), batch.cloud.colors.begin(), batch.cloud.colors.end());
        if (batch.cloud.colors.empty()) colors.resize(positions.size(), kGreyColor);
        scans.resize(positions.size(), batch.scan);
        attributes.resize(batch.cloud.attributes.size());
        for (std::size_t i = 0; i < attributes.size(); ++i) {
            const Attribute& each = batch.cloud.attributes[i];
            ASSERT_EQ(each.values.size(), count * each.bytesEach());
            attributes[i].insert(attributes[i].end(), each.values.begin(), each.values.end());
        }
    }
};

/// 16-bit colours whose largest values come late, and an attribute that only one file has.
std::vector<std::string> colouredFiles(const test::TemporaryFolder& folder) {
    std::string first = "x,y,z,red,green,blue,reading\n", second = "x,y,z,red,green,blue\n";
    for (int i = 0; i < 1000; ++i) {
        first += fmt::format("{},{},0,{},{},9,{}\n", i, i % 7, i % 200, i < 900 ? 3 : 40'000, 0.5 * i);
        second += fmt::format("{},{},1,{},{},9\n", i, i % 5, i % 200, 255);
    }
    return {folder.write("first.csv", first), folder.write("second.csv", second)};
}

TEST_F(SetTest, BatchesEqualReadingAtOnce) {
    const std::vector<std::string> files = colouredFiles(folder);
    StreamOptions options;
    options.batch_points = 64;
    std::size_t largest = 0;
    const StreamFindings found = readInBatches(
        files, options, [&](const PointBatch& batch) { largest = std::max(largest, batch.positions.size()); });
    EXPECT_EQ(largest, 64u);
    EXPECT_EQ(found.scan_points, (std::vector<std::uint64_t>{1000, 1000}));
    EXPECT_EQ(found.largest_color, (std::vector<float>{40'000, 255}));
    options.first_pass = &found;
    Collected batches;
    readInBatches(files, options, [&](const PointBatch& batch) { batches.add(batch); });

    const Cloud whole = readInputs(files, {});
    ASSERT_EQ(batches.positions.size(), whole.positions.size());
    for (std::size_t i = 0; i < whole.positions.size(); ++i)
        EXPECT_EQ(batches.positions[i], Vec3d(whole.origin + whole.positions[i].cast<double>()));
    EXPECT_EQ(batches.colors, whole.colors);
    EXPECT_EQ(batches.scans.front(), 0u);
    EXPECT_EQ(batches.scans.back(), 1u);
    ASSERT_EQ(found.cloud.attributes.size(), 1u); // the scan number is added elsewhere
    ASSERT_EQ(whole.attributes.front().name, "reading");
}

TEST_F(SetTest, PointsWithoutDataAreLeftOutOfALaterPass) {
    test::LasParts parts;
    std::string grid = "20\n20\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    for (int i = 0; i < 400; ++i) {
        const bool marked = i % 8 == 3;
        parts.points.push_back(test::lasPoint(20, i % 20, i / 20, marked ? -32768 : i % 5, 0));
        grid += marked ? "9999 9999 9999 1\n" : fmt::format("{} {} {} 1\n", 1 + i / 20, 1 + i % 20, i % 5);
    }
    parts.scale = 1;
    const std::vector<std::string> files = {folder.write("a.las", parts.bytes()), folder.write("b.ptx", grid)};
    StreamOptions options;
    options.batch_points = 64;
    const StreamFindings all = readInBatches(files, options, [](const PointBatch&) {});
    EXPECT_EQ(all.scan_points, (std::vector<std::uint64_t>{400, 400}));
    options.no_data = all.no_data;
    std::vector<Vec3d> positions;
    std::size_t cells = 0;
    const StreamFindings found = readInBatches(files, options, [&](const PointBatch& batch) {
        positions.insert(positions.end(), batch.positions.begin(), batch.positions.end());
        for (const RangeGrid& each : batch.cloud.grids)
            cells += static_cast<std::size_t>(
                std::count(each.point_of_cell.begin(), each.point_of_cell.end(), RangeGrid::kFilteredOut));
    });
    EXPECT_EQ(found.scan_points, (std::vector<std::uint64_t>{350, 350}));
    EXPECT_EQ(found.cloud.points_no_data, 100u);
    EXPECT_EQ(found.cloud.points_filtered, 0u);
    EXPECT_EQ(found.no_data.size(), all.no_data.size());
    EXPECT_EQ(cells, 50u);
    const Cloud whole = readInputs(files, {});
    EXPECT_EQ(whole.points_no_data, 100u);
    ASSERT_EQ(positions.size(), whole.positions.size());
    for (std::size_t i = 0; i < whole.positions.size(); ++i)
        EXPECT_EQ(positions[i], Vec3d(whole.origin + whole.positions[i].cast<double>()));
}

TEST_F(SetTest, AReadingResumesAfterAnyFile) {
    const std::vector<std::string> files = colouredFiles(folder);
    StreamOptions options;
    options.read.filter.every = 3; // counts across files
    const StreamFindings found = readInBatches(files, options, [](const PointBatch&) {});
    options.first_pass = &found;
    Collected all, rest;
    std::vector<StreamPlace> places;
    options.file_done = [&](const StreamPlace& place) { places.push_back(place); };
    readInBatches(files, options, [&](const PointBatch& batch) { all.add(batch); });
    ASSERT_EQ(places.size(), 2u);
    options.start = places.front();
    readInBatches(files, options, [&](const PointBatch& batch) { rest.add(batch); });
    ASSERT_LT(rest.positions.size(), all.positions.size());
    const auto same = static_cast<std::ptrdiff_t>(rest.positions.size());
    EXPECT_TRUE(std::equal(rest.positions.begin(), rest.positions.end(), all.positions.end() - same));
    EXPECT_EQ(rest.scans.front(), 1u);
}

TEST_F(SetTest, SmallMeshesAreReadAtOnce) {
    const std::string ball = folder.write("quad.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                                      "property float y\nproperty float z\nelement face 2\n"
                                                      "property list uchar int vertex_indices\nend_header\n"
                                                      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    StreamOptions options;
    options.read.sample_count = 500;
    std::size_t points = 0;
    const StreamFindings found = readInBatches({ball}, options, [&](const PointBatch& batch) {
        points += batch.positions.size();
        for (const Vec3f& normal : batch.cloud.normals) EXPECT_EQ(normal, Vec3f(0, 0, 1));
    });
    EXPECT_EQ(points, 500u);
    EXPECT_EQ(found.files.front().sampled, 500u);
    const std::string dots = folder.write("points.xyz", "0 0 0\n1 0 0\n");
    EXPECT_HAS(reasonOf([&] { readInBatches({dots}, options, [](const PointBatch&) {}); }, ExitCode::kBadUsage),
               "points.xyz: *no faces");
    options.largest_whole_file = 10;
    const std::string reason =
        reasonOf([&] { readInBatches({ball}, options, [](const PointBatch&) {}); }, ExitCode::kBadInput);
    EXPECT_HAS(reason, "quad.ply: *at once");
}

/// Two scans of 2 columns and 3 rows, of which one cell is empty.
std::string griddedScans() {
    const std::string header = "2\n3\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    return header + "1 0 0 1\n2 0 0 1\n3 0 0 1\n0 0 0 0.5\n2 1 0 1\n3 1 0 1\n" + header +
           "1 0 5 1\n2 0 5 1\n3 0 5 1\n1 1 5 1\n2 1 5 1\n3 1 5 1\n";
}

TEST_F(SetTest, ScansWithGridsArriveWhole) {
    const std::string path = folder.write("stations.ptx", griddedScans());
    StreamOptions options;
    options.batch_points = 2;
    std::vector<std::vector<std::uint32_t>> cells;
    std::vector<std::size_t> points;
    readInBatches({path}, options, [&](const PointBatch& batch) {
        points.push_back(batch.positions.size());
        ASSERT_EQ(batch.cloud.grids.size(), 1u);
        cells.push_back(batch.cloud.grids[0].point_of_cell);
        EXPECT_EQ(batch.cloud.grids[0].scan, batch.scan);
        EXPECT_TRUE(batch.cloud.scans.back().sensor.has_value());
        for (std::size_t i = 0; i < batch.positions.size(); ++i)
            EXPECT_EQ(Vec3d(batch.cloud.origin + batch.cloud.positions[i].cast<double>()), batch.positions[i]);
    });
    EXPECT_EQ(points, (std::vector<std::size_t>{5, 6}));
    EXPECT_EQ(cells,
              (std::vector<std::vector<std::uint32_t>>{{0, RangeGrid::kNoPoint, 1, 3, 2, 4}, {0, 3, 1, 4, 2, 5}}));
}

TEST_F(SetTest, GridsThatDoNotFitAreLeftOutWithANote) {
    const std::string path = folder.write("stations.ptx", griddedScans());
    StreamOptions options;
    options.batch_points = 2;
    options.most_in_grid = 5; // cells
    std::size_t points = 0, largest = 0;
    const StreamFindings found = readInBatches({path}, options, [&](const PointBatch& batch) {
        EXPECT_TRUE(batch.cloud.grids.empty());
        points += batch.positions.size();
        largest = std::max(largest, batch.positions.size());
    });
    EXPECT_EQ(points, 11u);
    EXPECT_EQ(largest, 2u);
    const auto says = [](const Note& note) { return note.text.find("--max-memory") != std::string::npos; };
    EXPECT_EQ(std::count_if(found.cloud.notes.begin(), found.cloud.notes.end(), says), 1) << "said once for both scans";
}

} // namespace
} // namespace pointrt
