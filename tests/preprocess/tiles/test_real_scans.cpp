// SPDX-License-Identifier: Apache-2.0
// Real scans (POINTRT_DATA): the only bucket of a set holds the points that a bake of one file reads.
#include <algorithm>
#include <cstdlib>
#include <set>

#include "format/pointio/e57.h"
#include "format/pointio/laz.h"
#include "set_fixture.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// The first difference, or "".
std::string differenceOf(const Cloud& whole, const Cloud& bucket) {
    if (whole.positions.size() != bucket.positions.size()) return "points";
    for (std::size_t i = 0; i < whole.positions.size(); ++i) {
        const Vec3d a = whole.origin + whole.positions[i].cast<double>();
        const Vec3d b = bucket.origin + bucket.positions[i].cast<double>();
        // both are floats, at up to this distance from their origins
        const double reach = double(whole.positions[i].cwiseAbs().maxCoeff() + bucket.positions[i].maxCoeff());
        if (!((a - b).cwiseAbs().maxCoeff() <= 0x1p-23 * reach)) return fmt::format("position {}", i);
    }
    if (whole.colors != bucket.colors) return "colours";
    if (whole.normals != bucket.normals) return "normals";
    if (whole.radii != bucket.radii) return "radii";
    if (whole.sensor_of_point != bucket.sensor_of_point) return "sensors of points";
    if (whole.world.crs != bucket.world.crs || whole.world.metres_per_unit != bucket.world.metres_per_unit)
        return "frame";
    if (whole.scans.size() != bucket.scans.size()) return "scans";
    for (std::size_t i = 0; i < whole.scans.size(); ++i)
        if (whole.scans[i].name != bucket.scans[i].name || whole.scans[i].sensor != bucket.scans[i].sensor ||
            whole.scans[i].first_point != bucket.scans[i].first_point)
            return fmt::format("scan {}", i);
    if (whole.attributes.size() != bucket.attributes.size()) return "number of attributes";
    for (std::size_t i = 0; i < whole.attributes.size(); ++i) {
        const Attribute &a = whole.attributes[i], &b = bucket.attributes[i];
        if (a.name != b.name || a.type != b.type || a.components != b.components || a.values != b.values)
            return "attribute " + a.name;
    }
    return "";
}

bool isRead(const std::string& name) {
    const std::string suffix = fs::path(name).extension().string();
    if (suffix == ".e57") return hasE57();
    if (suffix == ".laz") return hasLaz();
    return suffix == ".las" || suffix == ".ply" || suffix == ".pcd" || suffix == ".ptx" || suffix == ".xyz" ||
           suffix == ".pts" || suffix == ".csv" || suffix == ".obj" || suffix == ".splat";
}

/// The eight smallest readable files of each folder.
std::vector<std::string> someScans(const std::string& folder) {
    std::map<std::string, std::set<std::pair<std::uintmax_t, std::string>>> by_folder;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && isRead(entry.path().string()) && entry.file_size() < 8'000'000)
            by_folder[entry.path().parent_path().string()].insert({entry.file_size(), entry.path().string()});
    std::vector<std::string> scans;
    for (const auto& [unused, files] : by_folder) {
        std::size_t count = 0;
        for (const auto& file : files)
            if (count++ < 8) scans.push_back(file.second);
    }
    return scans;
}

TEST_F(SetTest, RealScansPassPlanAndSplitUnchanged) {
    const char* const data = std::getenv("POINTRT_DATA");
    if (!data) GTEST_SKIP() << "POINTRT_DATA does not name a folder of real scans";
    std::size_t read = 0;
    for (const std::string& path : someScans(data)) {
        Cloud whole;
        SetRequest request = requestOf({path}, 100'000'000);
        request.bake.surface.remove_outliers = false; // so that strays get a tile too
        request.up = Vec3d::UnitZ();                  // not tested here
        try {
            whole = readInputs({path}, request.read);
        } catch (const Error&) {
            continue; // some are invalid on purpose
        }
        if (whole.positions.size() < 3 || whole.positions.size() > 500'000) continue;
        request.bake.surface.orient = OrientMode::kNone;
        request.bake.surface.clean = 0;
        try {
            const SetPlan plan = splitInto(fmt::format("{}.proset", read), request);
            ASSERT_EQ(plan.tiles.size(), 1u) << path;
            EXPECT_EQ(differenceOf(whole, readBucket(plan, 0)), "") << path;
            ++read;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("in degrees"), std::string::npos) << path << ": " << error.what();
        }
    }
    EXPECT_GT(read, 10u);
}

} // namespace
} // namespace pointrt
