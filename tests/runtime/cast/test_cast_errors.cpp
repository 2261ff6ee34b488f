// SPDX-License-Identifier: Apache-2.0
// Errors of the library: their kind, and the ray, array or file that they name.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "pointrt/trace.hpp"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

using ErrorKind = TraceError::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

class CastErrors : public testing::Test {
protected:
    std::string plane() {
        writeScan(folder.file("plane.pro"), planeSplats(4, 0.5f), {});
        return folder.file("plane.pro");
    }

    TemporaryFolder folder;
    TraceDevice device;
};

template <typename Act>
std::string reasonOf(ErrorKind code, Act act) {
    try {
        act();
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, code) << error.what();
        return error.what();
    }
    return "nothing was thrown";
}

TEST_F(CastErrors, InvalidRays_AreNamedByNumber) {
    const TraceScene scene(device, {plane()});
    const struct {
        std::size_t number;
        double wrong;
        const char* reason;
    } cases[] = {{0, kNaN, "*origin*finite"},
                 {2, kInfinity, "*origin*finite"},
                 {3, kNaN, "*direction*finite"},
                 {5, -kInfinity, "*direction*finite"},
                 {5, 0, "*direction*0"}};
    for (const auto& each : cases) {
        std::vector<double> rays{0, 0, 9, 0, 0, -1, 0, 0, 9, 0, 0, -1, 0, 0, 9, 0, 0, -1};
        rays[6 + each.number] = each.wrong;
        std::vector<double> t(3);
        std::vector<std::uint8_t> occluded(3);
        try {
            scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
            FAIL() << each.reason;
        } catch (const RayError& error) {
            EXPECT_EQ(error.ray, 1u);
            EXPECT_SAYS(error.reason, each.reason);
            EXPECT_EQ(error.what(), "ray 1: " + error.reason);
            EXPECT_EQ(error.kind, ErrorKind::kBadInput);
        }
        EXPECT_THROW(scene.testOcclusions(std::span<const double>(rays), {}, occluded), RayError);
    }
}

TEST_F(CastErrors, ExtremeDirections_AreValid) {
    const TraceScene scene(device, {plane()});
    std::vector<double> rays, t(2);
    for (const double size : {1e-200, 1e200}) rays.insert(rays.end(), {500064, 4500064, 300, 0, 0, -size});
    scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
    EXPECT_NEAR(t[0] * 1e-200, 136, 1e-3);
    EXPECT_NEAR(t[1] * 1e200, 136, 1e-3);
}

TEST_F(CastErrors, ArraysAndLimits_AreChecked) {
    const TraceScene scene(device, {plane()});
    const std::vector<double> rays(12, 1.0);
    const std::span<const double> two(rays);
    std::vector<double> one(1);
    const auto refused = [&](const RayLimits& limits, const HitArrays& arrays) {
        return reasonOf(ErrorKind::kBadUsage, [&] { scene.castRays(two, limits, arrays); });
    };
    EXPECT_SAYS(refused({}, {.t_hit = one}), "t_hit: *2 *1");
    EXPECT_SAYS(refused({}, {.positions = one}), "positions: *6 *1");
    const std::string limits = "t_min *t_max";
    for (const RayLimits& wrong :
         {RayLimits{-1, 1}, RayLimits{2, 1}, RayLimits{kNaN, 1}, RayLimits{0, kNaN}, RayLimits{kInfinity, kInfinity}})
        EXPECT_SAYS(refused(wrong, {}), limits);
    std::vector<std::uint8_t> three(3);
    EXPECT_SAYS(reasonOf(ErrorKind::kBadUsage, [&] { scene.testOcclusions(two, {}, three); }), "occluded *ray");
    EXPECT_SAYS(reasonOf(ErrorKind::kBadUsage, [&] { RayRows{two.subspan(1)}; }), "rays *11");
}

TEST_F(CastErrors, InvalidScenes_AreNamed) {
    const auto refused = [&](const std::vector<std::string>& paths, ErrorKind code = ErrorKind::kBadInput) {
        return reasonOf(code, [&] { TraceScene(device, paths); });
    };
    EXPECT_SAYS(refused({}, ErrorKind::kBadUsage), "*one .pro");
    const std::string missing = folder.file("missing.pro");
    EXPECT_EQ(refused({plane(), missing}), missing + ": No such file or directory");
    EXPECT_EQ(refused({"city.proset"}), "city.proset/set.json: No such file or directory");
    EXPECT_EQ(refused({"room.toml"}), "room.toml: No such file or directory");
    std::ofstream(folder.file("points.ply")) << "ply\nformat ascii 1.0\n";
    EXPECT_NE(refused({folder.file("points.ply")}).find("pointrt-bake"), std::string::npos);
    std::ofstream(folder.file("short.pro")) << "\xABPRO";
    EXPECT_TRUE(refused({folder.file("short.pro")}).starts_with(folder.file("short.pro") + ": "));
}

TEST_F(CastErrors, UnknownDevice_ListsDevices) {
    const std::string reason = reasonOf(ErrorKind::kCannotRun, [] { TraceDevice("no such device"); });
    EXPECT_NE(reason.find(device.name()), std::string::npos) << reason;
}

} // namespace
} // namespace pointrt::test
