// SPDX-License-Identifier: Apache-2.0
// Real scans, if POINTRT_DATA names a folder with truth.json.
#include "tests/preprocess/input/input_fixture.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "format/pointio/e57.h"
#include "format/pointio/laz.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

struct Extent {
    double least = 0, most = 0;
};

/// "least..most", once per axis.
std::vector<Extent> parseExtents(const std::string& text) {
    std::vector<Extent> extents;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::size_t dots = word.find("..");
        if (dots == std::string::npos) break;
        extents.push_back({std::stod(word.substr(0, dots)), std::stod(word.substr(dots + 2))});
    }
    return extents;
}

void expectExtents(const Cloud& cloud, const std::string& text) {
    const std::vector<Extent> extents = parseExtents(text);
    if (extents.size() != 3) return;
    for (int axis = 0; axis < 3; ++axis) {
        double least = INFINITY, most = -INFINITY;
        for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
            least = std::min(least, world(cloud, i)[axis]);
            most = std::max(most, world(cloud, i)[axis]);
        }
        // truth.json has six digits; float positions have about seven relative to the size of the cloud.
        const Extent& wanted = extents[axis];
        const double size = std::max({std::abs(wanted.least), std::abs(wanted.most), wanted.most - wanted.least});
        EXPECT_NEAR(least, wanted.least, 6e-6 * size);
        EXPECT_NEAR(most, wanted.most, 6e-6 * size);
    }
}

bool isReadFormat(const nlohmann::json& name) {
    if (!name.is_string()) return false;
    const std::string format = name;
    if (format == "E57") return hasE57();
    if (format.starts_with("LAS")) return hasLaz() || !format.ends_with("LAZ");
    for (const char* prefix : {"PLY", "PCD", "OBJ", "Draco"})
        if (format.starts_with(prefix)) return true;
    return false;
}

fs::path dataFolder() {
    const char* const folder = std::getenv("POINTRT_DATA");
    return folder ? fs::path(folder) : fs::path();
}

nlohmann::json truth() {
    std::ifstream file(dataFolder() / "truth.json");
    return nlohmann::json::parse(file);
}

/// Points as an independent reader counted them: a number, "NUMBER (WxH)" or "NUMBER in N scans".
std::size_t wantedPoints(const nlohmann::json& points) {
    return points.is_number() ? points.get<std::size_t>() : std::stoul(points.get<std::string>());
}

void expectTruth(const std::string& name, const nlohmann::json& facts) {
    SCOPED_TRACE(name);
    const Cloud cloud = readInputs({(dataFolder() / name).string()}, {});
    EXPECT_EQ(cloud.points_read, wantedPoints(facts["points"]));
    EXPECT_EQ(cloud.points_read, cloud.positions.size() + cloud.points_non_finite + cloud.points_unused +
                                     cloud.points_filtered + cloud.points_no_data);
    const bool black = facts.value("note", "").find("rgb max 0") != std::string::npos; // not counted as colours
    EXPECT_EQ(!cloud.colors.empty(), facts["col"].get<bool>() && !black);
    EXPECT_EQ(!cloud.triangles.empty(), facts["faces"].get<int>() > 0);
    if (cloud.points_unused + cloud.points_filtered == 0)
        expectExtents(cloud, facts["ext"]); // other readers measure all vertices
}

TEST(DataTest, ScansMatchOtherReaders) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    int read = 0;
    const nlohmann::json all_facts = truth();
    for (const auto& [name, facts] : all_facts.items()) {
        const bool has_extent = facts["ext"].is_string() && !parseExtents(facts["ext"]).empty();
        if (!isReadFormat(facts["fmt"]) || !has_extent || !fs::exists(dataFolder() / name)) continue;
        expectTruth(name, facts);
        ++read;
    }
    EXPECT_GT(read, 0);
}

TEST(DataTest, FilesWithoutPointsAreRefused) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    for (const char* name :
         {"draco/git-lfs-pointer.drc", "pcd_odd/missingheader.pcd", "ply_odd/alzobaer_point_cloud.ply",
          "ply_odd/assimp_empty.ply", "ply_odd/draco_inf_nan.obj", "ply_odd/pdal_no_vertex.obj",
          "ply_odd/pdal_no_vertex.ply", "ply_odd/pdal_sized_dims.ply", "ply_odd/trimesh_empty.ply",
          "ply_odd/trimesh_ply_empty_ascii.ply", "ply_odd/trimesh_ply_empty_header.ply",
          "ply_odd/trimesh_point_uv.ply.zip", "splats/f3d_empty.splat", "text_formats/bunny16k.pts",
          "las_odd/1.2-no-points.las", "las_odd/no-points.las", "las_odd/lazperf_no-points-1.3.las",
          "las_odd/git-lfs-pointer.laz"}) {
        const std::string path = (dataFolder() / name).string();
        try {
            readInputs({path}, {});
            ADD_FAILURE() << name << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            EXPECT_EQ(std::string(error.what()).find(path + ":"), 0u) << error.what();
        }
    }
}

TEST(DataTest, E57FilesWithoutGoodPointsAreRefused) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    if (!hasE57()) GTEST_SKIP() << "this build has no Rust: E57 is not tested";
    for (const char* name : {"cryinc_corrupt_crc", "cryinc_empty", "cryinc_empty_pc", "libe57_InvalidCVHeader",
                             "libe57_PinholeImageWithDistortionParameters", "libe57_ZeroPoints", "libe57_empty"}) {
        const std::string path = (dataFolder() / "e57" / (std::string(name) + ".e57")).string();
        try {
            readInputs({path}, {});
            ADD_FAILURE() << name << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            EXPECT_EQ(std::string(error.what()).find(path + ":"), 0u) << error.what();
        }
    }
}

/// Contents of a text or splat file, counted by hand.
struct Held {
    const char* name;
    std::size_t points, left_out;
    bool colors;
    Names attributes;
};

TEST(DataTest, TextAndSplats) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    const Names grid = {"intensity", "row", "column"};
    const Names gaussians = {"opacity", "gaussian_deviation", "gaussian_rotation", "gaussian_color"};
    Names degree_two = gaussians;
    for (int i = 1; i <= 8; ++i) degree_two.push_back(fmt::format("gaussian_harmonic_{}", i));
    for (const Held& held :
         {Held{"text_formats/pdal_1.2-with-color.ptx", 1065, 0, true, grid},
          Held{"text_formats/pdal_complex-transform.ptx", 4, 0, true, grid},
          Held{"text_formats/pdal_no-color.ptx", 15, 0, false, grid},
          Held{"text_formats/pdal_autzen.pts", 10, 0, true, {"intensity"}},
          Held{"text_formats/pdal_test.pts", 19, 0, true, {"intensity"}},
          Held{"text_formats/pdal_bunny_8.pts", 9, 0, false, {}},
          Held{"text_formats/pdal_data.xyz", 400, 0, false, {}},
          Held{"text_formats/pdal_missingheader.txt", 5, 0, false, {}},
          Held{"text_formats/pdal_quoted.txt", 9, 0, false, {}},
          Held{"text_formats/pdal_utm17_1.txt", 10, 0, false, {}},
          Held{"text_formats/pdal_utm17_3.txt", 11, 0, false, {}},
          Held{"text_formats/pdal_with_edgeofflightline.txt", 10000, 0, false, {"OffsetTime", "edge_of_flight_line"}},
          Held{"text_formats/trimesh_points_cloudcompare.xyz", 101, 0, true, {}},
          Held{"splats/minimal.splat", 4, 0, true, gaussians},
          Held{"splats/minimal-raw.spz", 4, 0, true, gaussians},
          Held{"splats/minimal-v2.spz", 4, 0, true, gaussians},
          Held{"splats/minimal-v4.spz", 4, 0, true, gaussians},
          Held{"splats/biker_3dgs_quarter.ply", 38187, 0, true, gaussians},
          Held{"splats/guitar.compressed.ply", 90854, 0, true, gaussians},
          Held{"splats/playbot_sog/meta.json", 250000, 0, true, degree_two}}) {
        SCOPED_TRACE(held.name);
        const Cloud cloud = readInputs({(dataFolder() / held.name).string()}, {});
        EXPECT_EQ(cloud.points_read, held.points);
        EXPECT_EQ(cloud.positions.size(), held.points - held.left_out);
        EXPECT_EQ(!cloud.colors.empty(), held.colors);
        EXPECT_EQ(attributeNames(cloud), held.attributes);
    }
    const Cloud posed = readInputs({(dataFolder() / "text_formats/pdal_complex-transform.ptx").string()}, {});
    EXPECT_LT((world(posed, 0) - Vec3d(-3.0344073, -3.1737810, -1.8237500)).norm(), 1e-6);
    ASSERT_TRUE(posed.scans[0].sensor.has_value());
    EXPECT_LT((*posed.scans[0].sensor - Vec3d(-3.028748, -3.819741, -1.384333)).norm(), 1e-6);
    const Cloud times = readInputs({(dataFolder() / "text_formats/pdal_with_edgeofflightline.txt").string()}, {});
    EXPECT_EQ(numbersOf(times, "OffsetTime")[9999], 9999);
}

TEST(DataTest, ThreeWaysToPackTheSameSplats) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    const Cloud plain = readInputs({(dataFolder() / "splats/minimal.splat").string()}, {});
    for (const char* name : {"splats/minimal-raw.spz", "splats/minimal-v2.spz", "splats/minimal-v4.spz"}) {
        SCOPED_TRACE(name);
        const Cloud packed = readInputs({(dataFolder() / name).string()}, {});
        ASSERT_EQ(packed.positions.size(), plain.positions.size());
        for (std::size_t i = 0; i < plain.positions.size(); ++i) {
            const double z = name == std::string("splats/minimal-v4.spz") ? -1 : 1; // written by another program
            EXPECT_LT((world(packed, i) - world(plain, i).cwiseProduct(Vec3d(1, 1, z))).norm(), 2e-3);
            EXPECT_NEAR(packed.radii[i], plain.radii[i],
                        0.05 * static_cast<double>(plain.radii[i])); // coded in steps of 1/16 of a logarithm
        }
    }
}

TEST(DataTest, PosedScansFaceTheirSensors) {
    if (dataFolder().empty()) GTEST_SKIP() << "POINTRT_DATA is not set: no real scans to read";
    const Cloud merged = readInputs({(dataFolder() / "stanford_dragon_raw/merged.ply").string()}, {});
    const Cloud posed = readInputs({(dataFolder() / "stanford_dragon_raw/dragonStandRight.conf").string()}, {});
    ASSERT_EQ(posed.sensors.size(), 15u);
    ASSERT_EQ(posed.sensor_of_point.size(), posed.positions.size());
    // merged.ply has the same points in the same order without about 0.2 % of them, and normals to the scanner.
    std::size_t at = 0, matched = 0, facing = 0;
    for (std::size_t i = 0; i < merged.positions.size(); ++i) {
        while (at < posed.positions.size() && (world(posed, at) - world(merged, i)).norm() > 1e-6) ++at;
        if (at == posed.positions.size()) break;
        const Vec3f to_sensor = posed.sensors[posed.sensor_of_point[at]] - posed.positions[at];
        facing += merged.normals[i].dot(to_sensor) > 0;
        ++matched;
    }
    EXPECT_EQ(matched, merged.positions.size());
    EXPECT_GT(static_cast<double>(facing), 0.99 * static_cast<double>(matched));
}

} // namespace
} // namespace pointrt
