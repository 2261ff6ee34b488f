// SPDX-License-Identifier: Apache-2.0
#include "format/os/process_time.h"
#include "runtime/session/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <limits>

#include "format/base/error.h"
#include "runtime/session/profile_report.h"

namespace pointrt {
namespace {

Report testReport() {
    Report report;
    report.device = "GPU \"X\" \\ 1";
    report.width = 640;
    report.height = 480;
    report.integrator = "path";
    report.spp = 16;
    report.samples = 4;
    report.noise = 0.125;
    report.denoise_ms = 2.5;
    report.splats = 5'000'000'000;
    report.device_bytes = 1ull << 40;
    report.load_seconds = 0.25;
    report.first_frame_seconds = 1.5;
    report.frame_ms = {40, 10, 20, 30};
    report.frame_cpu_ms = {80, 20, 30};
    report.rays = {1'000'000, 1'500'000, 0};
    return report;
}

TEST(Report, HasTheKeysOfTheContract) {
    const nlohmann::json json = nlohmann::json::parse(reportJson(testReport()));
    EXPECT_EQ(json["device"], "GPU \"X\" \\ 1");
    EXPECT_EQ(json["width"], 640);
    EXPECT_EQ(json["height"], 480);
    EXPECT_EQ(json["integrator"], "path");
    EXPECT_EQ(json["spp"], 16);
    EXPECT_EQ(json["samples"], 4);
    EXPECT_EQ(json["noise"], 0.125);
    EXPECT_EQ(json["denoise_ms"], 2.5);
    EXPECT_EQ(json["splats"], 5'000'000'000);
    EXPECT_EQ(json["device_bytes"], 1ull << 40);
    EXPECT_EQ(json["load_seconds"], 0.25);
    EXPECT_EQ(json["first_frame_seconds"], 1.5);
    EXPECT_EQ(json["frame_ms"], (nlohmann::json{{"min", 10}, {"median", 25}, {"max", 40}}));
    EXPECT_EQ(json["frame_cpu_ms"], (nlohmann::json{{"min", 20}, {"median", 30}, {"max", 80}}));
    EXPECT_EQ(json["rays"], (nlohmann::json{{"primary", 1'000'000}, {"shadow", 1'500'000}, {"secondary", 0}}));
    EXPECT_EQ(json["mrays_per_second"], 100); // 2.5 million in 25 ms
    EXPECT_EQ(json.size(), 16u);
}

TEST(Report, ReportsTheMedian) {
    Report report = testReport();
    report.frame_ms = {30, 10, 20};
    EXPECT_EQ(nlohmann::json::parse(reportJson(report))["frame_ms"]["median"], 20);
}

TEST(Report, WritesNullForNonFiniteNumbers) {
    Report report = testReport();
    report.noise = std::numeric_limits<double>::infinity(); // one sample a pixel
    report.rays = {};                                       // as for a film that was complete already
    report.frame_ms = {0};
    const nlohmann::json json = nlohmann::json::parse(reportJson(report));
    EXPECT_TRUE(json["noise"].is_null());
    EXPECT_EQ(json["mrays_per_second"], 0);
}

PassProfile testProfile() {
    PassProfile profile;
    profile.frames = 2;
    profile.frames_ms = 100;
    profile.passes = {{"trace", 4, 7, 8, 15, 2000, 500, 64'000}, {"shade", 4, 60, 70, 130, 4000, 3000, 1'000'000}};
    profile.host = {{"film read back", 12}};
    return profile;
}

TEST(ProfileReport, ReportsUnaccountedTime) {
    Report report = testReport();
    report.profile = profileJson(testProfile());
    const nlohmann::json json = nlohmann::json::parse(reportJson(report));
    EXPECT_EQ(json.size(), 17u);
    const nlohmann::json& profile = json["profile"];
    EXPECT_EQ(profile["frames"], 2);
    EXPECT_EQ(profile["frames_ms"], 100);
    EXPECT_EQ(profile["passes"][0], (nlohmann::json{{"pass", "trace"},
                                                    {"runs", 4},
                                                    {"device_ms", nullptr}, // no device clock here
                                                    {"host_ms", 8},
                                                    {"cpu_ms", 15},
                                                    {"lanes_in", 2000},
                                                    {"lanes_out", 500},
                                                    {"bytes", 64'000}}));
    EXPECT_EQ(profile["host"], (nlohmann::json{{{"what", "film read back"}, {"ms", 12}}}));
    EXPECT_EQ(profile["unaccounted_ms"], 10); // 100 - 8 - 70 - 12
}

TEST(ProfileReport, ListsTheSlowestPassFirst) {
    const std::string table = profileTable(testProfile());
    EXPECT_LT(table.find("shade"), table.find("trace"));
    EXPECT_NE(table.find("17500.0"), std::string::npos) << "ns a lane: 70 ms over 4000\n" << table;
    EXPECT_LT(table.find("film read back"), table.find("unaccounted for"));
}

TEST(Report, CountsFromTheStartOfTheProcess) {
    const double before = secondsSinceStart();
    EXPECT_GE(before, 0);
    EXPECT_LT(before, 60);
    usleep(20'000);
    EXPECT_GE(secondsSinceStart() - before, 0.019);
    EXPECT_LT(secondsSinceStart() - before, 10);
}

} // namespace
} // namespace pointrt
