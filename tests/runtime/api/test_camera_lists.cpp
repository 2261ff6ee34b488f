// SPDX-License-Identifier: Apache-2.0
// The same camera, read from every kind of list.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "runtime/scene_io/shot_names.h"
#include "runtime/scene_io/transforms_write.h"
#include "tests/runtime/api/camera_lists.h"

namespace pointrt::test {
namespace {

class CameraLists : public testing::Test {
protected:
    std::vector<CameraShot> read(const std::string& name, const CameraFileRequest& request = {}) const {
        return readCameraList(folder.file(name), request);
    }
    std::vector<CameraShot> readJson(const std::string& text, const CameraFileRequest& request = {}) const {
        folder.write("transforms.json", text);
        return read("transforms.json", request);
    }
    TemporaryFolder folder;
};

/// The camera of camera_lists.h.
void expectPose(const CameraPose& pose) {
    const auto expectNear = [](Vec3 found, Vec3 expected) { EXPECT_LT(length(found - expected), 1e-15); };
    expectNear(pose.right, {0, -1, 0});
    expectNear(pose.down, {0, 0, -1});
    expectNear(pose.forward, {1, 0, 0});
    expectNear(pose.eye, {1, 2, 3});
}

void expectColmap(const std::vector<CameraShot>& shots) {
    ASSERT_EQ(shots.size(), 2u);
    EXPECT_EQ(shots[0].name, "a/one.jpg");
    EXPECT_EQ(shots[1].name, "a/two.jpg");
    for (const CameraShot& shot : shots) {
        EXPECT_EQ(shot.size, (PixelSize{640, 480}));
        EXPECT_EQ(shot.lens, (PinholeLens{500, 510, 320.5, 239.25}));
        expectPose(shot.pose);
    }
}

TEST_F(CameraLists, ReadColmapText) {
    folder.write("cameras.txt", kColmapCameras);
    folder.write("images.txt", kColmapImages);
    expectColmap(read(""));
    expectColmap(read("images.txt"));
    expectColmap(read("cameras.txt"));
}

TEST_F(CameraLists, ReadColmapBinary) {
    std::filesystem::create_directories(folder.path / "sparse" / "0");
    folder.write("sparse/0/cameras.bin", packedCameras());
    folder.write("sparse/0/images.bin", packedImages());
    expectColmap(read(""));
    expectColmap(read("sparse/0"));
    expectColmap(read("sparse/0/images.bin"));
}

TEST_F(CameraLists, ReadTransforms) {
    const auto shots =
        readJson(R"({"w": 640, "h": 480, "fl_x": 500, "fl_y": 510, "cx": 320.5, "cy": 239.25, "k1": 0,
        "camera_model": "OPENCV", "frames": [{"file_path": "a/one.jpg", "transform_matrix": )" +
                 kTransformPose + R"(}, {"file_path": "a/two.jpg", "transform_matrix": )" + kTransformPose + "}]}");
    expectColmap(shots);
}

TEST_F(CameraLists, FramesOverrideTheFile) {
    const auto shots =
        readJson(R"({"w": 640, "h": 480, "fl_x": 500, "frames": [{"file_path": "one", "w": 100.0, "h": 50,
        "fl_x": 80, "cx": 51, "transform_matrix": )" +
                 kTransformPose + "}]}");
    EXPECT_EQ(shots[0].size, (PixelSize{100, 50}));
    EXPECT_EQ(shots[0].lens, (PinholeLens{80, 80, 51, 25}));
    expectPose(shots[0].pose);
}

TEST_F(CameraLists, ReadAnglesOfOriginalNerfScenes) {
    const std::string text = R"({"camera_angle_x": 1.5707963267948966, "frames": [{"file_path": "./train/r_0",
        "transform_matrix": )" +
                             kTransformPose + "}]}";
    const auto shots = readJson(text, {PixelSize{800, 600}, false});
    EXPECT_EQ(shots[0].size, (PixelSize{800, 600}));
    EXPECT_NEAR(shots[0].lens.fx, 400, 1e-9);
    EXPECT_EQ(shots[0].lens.fy, shots[0].lens.fx);
    EXPECT_EQ(shots[0].lens.cx, 400);
    EXPECT_EQ(shots[0].lens.cy, 300);
}

TEST_F(CameraLists, UndoAppliedTransforms) {
    // ns-process-data rotates COLMAP's world, x, y, z to x, z, -y, and moves it; the camera moves with it
    const auto shots = readJson(R"({"w": 640, "h": 480, "fl_x": 500,
        "applied_transform": [[1, 0, 0, 10], [0, 0, 1, 20], [0, -1, 0, 30]],
        "frames": [{"file_path": "one", "transform_matrix": [[0, 0, -1, 11], [0, 1, 0, 23], [1, 0, 0, 28],
        [0, 0, 0, 1]]}]})");
    expectPose(shots[0].pose);
}

TEST_F(CameraLists, RoundTripBitIdentically) {
    TransformsFile file;
    file.offset = {500064, 4500064, 0};
    for (int i = 0; i < 3; ++i) {
        CameraShot shot;
        shot.name = "x";
        shot.size = {640, 480};
        shot.lens = {500.1 + i, 510.7, 320.3, 239.9};
        const double c = std::cos(0.7 + i), s = std::sin(0.7 + i);
        shot.pose = {{c, s, 0}, {0, 0, -1}, {-s, c, 0}, {500017.123456789 + i, 4500099.987654321, 203.3}};
        file.shots.push_back({shot, {{"file_path", "rgb/" + std::to_string(i) + ".png"}}});
    }
    writeTransforms(folder.file("transforms.json"), file);
    const auto shots = read("transforms.json");
    ASSERT_EQ(shots.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(shots[i].pose, file.shots[i].shot.pose);
        EXPECT_EQ(shots[i].lens, file.shots[i].shot.lens);
        EXPECT_EQ(shots[i].name, file.shots[i].files[0].second);
    }
}

TEST_F(CameraLists, OffsetsPreserveFloatPrecision) {
    EXPECT_EQ(offsetFor({-100, 0, 0}, {8000, 10, 10}), Vec3{});
    EXPECT_EQ(offsetFor({500000, 4500000, 100}, {500101, 4500100, 140}), (Vec3{500051, 4500050, 120}));
}

TEST_F(CameraLists, ShotNamesAreUniqueRelativePaths) {
    const auto names = [](const std::vector<std::string>& given) {
        std::vector<CameraShot> shots;
        for (const std::string& name : given) shots.push_back({name, "", {}, {}, {}, {}});
        return shotNames(shots);
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names({"./images/a.jpg", "./images/b.JPG"}), (Names{"a", "b"}));
    EXPECT_EQ(names({"/data/left/0001.png", "/data/right/0001.png"}), (Names{"left/0001", "right/0001"}));
    EXPECT_EQ(names({"../../etc/passwd"}), (Names{"passwd"}));
    EXPECT_EQ(names({"frame.0001", "frame.0002"}), (Names{"frame.0001", "frame.0002"}));
    EXPECT_EQ(names({"a\\b.tif", "a\\.png"}), (Names{"b", ".png"}));
    EXPECT_THROW(names({"a/b.png", "a/b.jpg"}), std::runtime_error);
    EXPECT_THROW(names({"a\nb"}), std::runtime_error);
    EXPECT_THROW(names({"../.."}), std::runtime_error);
}

} // namespace
} // namespace pointrt::test
