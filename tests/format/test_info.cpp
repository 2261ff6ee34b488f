// SPDX-License-Identifier: Apache-2.0
// pointrt-info end to end: its output, its findings, its exit codes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tiny_index.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

struct Outcome {
    int code;
    std::string out, err;
};

std::string text(const std::string& path) {
    const Bytes bytes = readBytes(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Info : testing::Test {
    TemporaryFolder folder;
    std::string pro = folder.file("a.pro"), ply = folder.file("a.ply");

    void SetUp() override { tinyScene().write(pro); }

    Outcome run(const std::string& arguments) {
        const std::string out = folder.file("out.txt"), err = folder.file("err.txt");
        const std::string command = std::string(POINTRT_INFO) + " " + arguments + " >" + out + " 2>" + err;
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
    }

    void damage(std::size_t offset, std::uint32_t value) {
        Bytes bytes = readBytes(pro);
        storeAt(bytes, offset, value);
        fixChecksums(bytes);
        writeBytes(pro, bytes);
    }
};

TEST_F(Info, TextNamesTheFile) {
    const Outcome result = run(pro);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("version 1.0"), std::string::npos);
    EXPECT_NE(result.out.find("input units"), std::string::npos);
    EXPECT_NE(result.out.find("17 nodes"), std::string::npos);
    EXPECT_EQ(result.err, "");
}

TEST_F(Info, Json) {
    const Outcome result = run(pro + " --json");
    ASSERT_EQ(result.code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["version"], "1.0");
    EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(pro));
    EXPECT_EQ(json["splats"], 5);
    EXPECT_EQ(json["nodes"], 17) << "without the padding of the root";
    EXPECT_EQ(json["filled_leaves"], 5);
    EXPECT_EQ(json["border_leaves"], 1);
    EXPECT_EQ(json["empty_leaves"], 10);
    EXPECT_EQ(json["max_depth"], 2);
    EXPECT_EQ(json["references"], 8);
    EXPECT_DOUBLE_EQ(json["references_per_splat"], 1.6);
    EXPECT_DOUBLE_EQ(json["bytes_per_splat"], static_cast<double>(std::filesystem::file_size(pro)) / 5);
    EXPECT_EQ(json["origin"], (nlohmann::json{10, 20, 30}));
    EXPECT_EQ(json["bounds_max"], (nlohmann::json{11.8, 21.5, 31.5}));
    EXPECT_EQ(json["scale"], 2);
    EXPECT_EQ(json["has_color"], true);
    EXPECT_EQ(json["oriented"], true);
    EXPECT_EQ(json["pruned"], false);
    EXPECT_EQ(json["blend_slab"], 0.5);
    EXPECT_EQ(json["radius_max"], 0.5) << "input units";
    EXPECT_DOUBLE_EQ(json["position_error"], 2 * std::sqrt(3.0) * 0x1p-22);
    EXPECT_EQ(json["sections"].size(), 7u);
    EXPECT_EQ(json["sections"][0]["kind"], "NODE");
    EXPECT_TRUE(json["index"].is_null());
    EXPECT_EQ(json["materials"][1]["reflectivity"], 0.5);
    EXPECT_EQ(json["metadata"]["tool"], "tiny_scene.h");
    EXPECT_EQ(json["levels"][1], (nlohmann::json{{"inner", 1}, {"filled", 3}, {"empty", 4}}));
}

TEST_F(Info, Index) {
    EXPECT_NE(run(pro).out.find("tracing index   none"), std::string::npos);
    Scene scene = tinyScene();
    tinyIndex().write(scene, pro);
    const auto json = nlohmann::json::parse(run(pro + " --json").out);
    EXPECT_EQ(json["version"], "1.4");
    EXPECT_EQ(json["index"]["bytes"], 2 * 4 + 80 * 4 + 4 * (16 + 4) + 6 * (8 + 4) + 4 * 2);
    EXPECT_EQ(json["index"]["grid"], (nlohmann::json{2, 1, 1}));
    EXPECT_EQ(json["index"]["bricks"], 1);
    EXPECT_EQ(json["index"]["groups"], 2);
    EXPECT_EQ(json["index"]["cells"], 4);
    EXPECT_EQ(json["index"]["near_splats"], 6);
    EXPECT_EQ(json["index"]["blending"], 4);
    EXPECT_EQ(json["sections"].size(), 14u);
    const std::string text = run(pro).out;
    EXPECT_NE(text.find("grid of 2 x 1 x 1, 1 bricks, 2 groups, 4 cells, 1.20 near splats for each splat"),
              std::string::npos)
        << text;
}

TEST_F(Info, MetadataThatIsNotJsonIsAString) {
    for (const std::string& hostile : {std::string("not json \x1b[31m"), std::string(100000, '[')}) {
        Scene scene = tinyScene();
        scene.metadata = hostile;
        scene.write(pro);
        const Outcome json = run(pro + " --json");
        ASSERT_EQ(json.code, 0);
        EXPECT_EQ(nlohmann::json::parse(json.out)["metadata"], hostile);
        const Outcome plain = run(pro);
        EXPECT_EQ(plain.code, 0);
        EXPECT_EQ(plain.out.find('\x1b'), std::string::npos) << "no control characters reach the terminal";
    }
}

TEST_F(Info, VerifyClean) {
    const Outcome result = run(pro + " --verify");
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out, pro + ": no findings\n");
}

TEST_F(Info, VerifyListsEveryFinding) {
    damage(sectionOf(readBytes(pro), PRO_KIND_REFS), 99);
    damage(sectionOf(readBytes(pro), PRO_KIND_LEAF) + 12, 1);
    const Outcome result = run(pro + " --verify");
    EXPECT_EQ(result.code, 1);
    EXPECT_SAYS(result.out, pro + ": finding 4001: leaf 0: \n" + pro + ": finding 4006: reference 0: \n");
    EXPECT_EQ(result.err, "pointrt-info: error: " + pro + ": 2 findings\n");
    const Outcome json = run(pro + " --verify --json");
    EXPECT_EQ(json.code, 1);
    EXPECT_EQ(nlohmann::json::parse(json.out)["findings"][1]["number"], 4006);
}

TEST_F(Info, BrokenFilesAreOneLineAndExitOne) {
    damage(sectionOf(readBytes(pro), PRO_KIND_REFS), 99);
    const Outcome broken = run(pro);
    EXPECT_EQ(broken.code, 1);
    EXPECT_SAYS(broken.err, "pointrt-info: error: " + pro + ": reference 0: *(finding 4006)\n");
    const Outcome missing = run(folder.file("missing.pro"));
    EXPECT_EQ(missing.code, 1);
    EXPECT_EQ(missing.err, "pointrt-info: error: " + (folder.file("missing.pro")) + ": No such file or directory\n");
    EXPECT_EQ(run(folder.file("missing.pro --verify")).code, 1);
    EXPECT_EQ(run(folder.file("missing.pro --export ") + ply).code, 1);
    EXPECT_FALSE(std::filesystem::exists(ply));
}

TEST_F(Info, WrongUsageIsExitTwo) {
    for (const std::string& arguments : {std::string(), pro + " --nonsense", pro + " extra",
                                         pro + " --verify --export x", pro + " -f", pro + " -f --export " + pro}) {
        const Outcome result = run(arguments);
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.err.rfind("pointrt-info: error: ", 0), 0u) << result.err;
    }
    EXPECT_EQ(run("--help").code, 0);
    EXPECT_EQ(run("--version").code, 0);
}

TEST_F(Info, UnwritableOutputIsExitFour) {
    EXPECT_EQ(run(pro + " --export " + (folder.file("missing/a.ply"))).code, 4);
    writeBytes(ply, Bytes(3));
    const Outcome result = run(pro + " --export " + ply);
    EXPECT_EQ(result.code, 4);
    EXPECT_EQ(readBytes(ply).size(), 3u);
    if (std::filesystem::exists("/dev/full")) {
        const std::string command = std::string(POINTRT_INFO) + " " + pro + " >/dev/full 2>/dev/null";
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
    }
}

/// The bytes of the vertices after the header, which must be exactly this.
std::string vertices(const std::string& file, bool color) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment splats of a .pro file: oriented discs\n"
                         "element vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
                         "property float nx\nproperty float ny\nproperty float nz\nproperty float radius\n";
    if (color) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    header += "end_header\n";
    EXPECT_EQ(file.substr(0, header.size()), header);
    return file.substr(header.size());
}

TEST_F(Info, ExportInInputOrder) {
    writeBytes(ply, Bytes(3));
    ASSERT_EQ(run(pro + " -f --export " + ply).code, 0);
    const std::string rows = vertices(text(ply), true);
    ASSERT_EQ(rows.size(), 5u * (24 + 16 + 3));
    const ProFile file(pro);
    const std::uint32_t splat_of_row[] = {1, 3, 4, 0, 2}; // order is 3 0 7 1 2
    for (std::size_t row = 0; row < 5; ++row) {
        const pro_splat splat = file.splat(splat_of_row[row]);
        double position[3];
        float normal_radius[4];
        std::memcpy(position, rows.data() + row * 43, sizeof position);
        std::memcpy(normal_radius, rows.data() + row * 43 + 24, sizeof normal_radius);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_DOUBLE_EQ(position[axis], 10.0 * (axis + 1) + 2 * double{splat.position[axis]});
            EXPECT_EQ(normal_radius[axis], splat.normal[axis]);
            EXPECT_EQ(static_cast<std::uint8_t>(rows[row * 43 + 40 + static_cast<std::size_t>(axis)]),
                      splat.color[axis]);
        }
        EXPECT_FLOAT_EQ(normal_radius[3], 2 * splat.radius);
    }
}

TEST_F(Info, ExportWithoutColorHasNoColor) {
    Scene scene = tinyScene();
    scene.info.flags = 0;
    scene.write(pro);
    ASSERT_EQ(run(pro + " --export " + ply).code, 0);
    EXPECT_EQ(vertices(text(ply), false).size(), 5u * 40);
}

} // namespace
