// SPDX-License-Identifier: Apache-2.0
// Invalid lists of cameras: errors of one line with file, place and reason.
#include <gtest/gtest.h>

#include "format/base/error.h"
#include "runtime/scene_io/camera_list.h"
#include "tests/runtime/api/camera_lists.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

class CameraListErrors : public testing::Test {
protected:
    void expectRefused(const std::string& name, const std::string& part, const CameraFileRequest& request = {}) const {
        try {
            readCameraList(folder.file(name), request);
            FAIL() << "no error: " << part;
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_EQ(error.code, ExitCode::kBadInput) << text;
            EXPECT_HAS(text, part);
            EXPECT_EQ(text.rfind(folder.path.string(), 0), 0u) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        }
    }
    void expectColmap(const std::string& cameras, const std::string& images, const std::string& part,
                      const CameraFileRequest& request = {}) const {
        folder.write("cameras.txt", cameras);
        folder.write("images.txt", images);
        expectRefused("images.txt", part, request);
    }
    void expectJson(const std::string& text, const std::string& part, const CameraFileRequest& request = {}) const {
        folder.write("transforms.json", text);
        expectRefused("transforms.json", part, request);
    }
    /// A file with one frame. keys: of the whole file; in_frame: more of the frame.
    static std::string framed(const std::string& keys, const std::string& in_frame = "") {
        return "{" + keys + ", \"frames\": [{\"file_path\": \"a.png\", \"transform_matrix\": " + kTransformPose +
               in_frame + "}]}";
    }
    TemporaryFolder folder;
};

const std::string kLens = R"("w": 64, "h": 48, "fl_x": 50)";

TEST_F(CameraListErrors, MissingAndUnknownFilesAreRefused) {
    expectRefused("nothing.json", ": No such file or directory");
    expectRefused("", "neither *transforms.json *COLMAP");
    folder.write("list.csv", "1");
    expectRefused("list.csv", "not *list *transforms.json *COLMAP");
    folder.write("images.txt", kColmapImages);
    expectRefused("", "cameras.txt: No such file or directory*both");
}

TEST_F(CameraListErrors, InvalidColmapTextIsNamedByItsLine) {
    const std::string good = "1 PINHOLE 640 480 500 510 320 240\n", image = "1 " + kColmapPose + " 1 a.png\n\n";
    expectColmap("1 LENS 640 480 1\n", image, "cameras.txt:1: LENS *model");
    expectColmap("# x\n1 PINHOLE 640 480 500 510 320\n", image, "cameras.txt:2: parameter *missing");
    expectColmap("1 PINHOLE 640 wide 500 510 320 240\n", image, "cameras.txt:1: wide *HEIGHT");
    expectColmap(good + good, image, "cameras.txt:2: camera 1 *twice");
    expectColmap(good, "1 " + kColmapPose + " 2 a.png\n\n", "images.txt:1: camera 2 *cameras");
    expectColmap(good, "1 " + kColmapPose + " 1\n\n", "images.txt:1: NAME *missing");
    expectColmap(good, image + "2 0 0 0 0 1 2 3 1 b.png\n\n", "images.txt:3: *quaternion *zero");
    expectColmap(good, "1 x 0 0 0 1 2 3 1 b.png\n\n", "images.txt:1: x *quaternion");
    expectColmap(good, "# nothing\n", "images.txt: *no cameras");
    expectColmap("1 OPENCV_FISHEYE 640 480 500 510 320 240 0 0 0 0\n", image,
                 "images.txt:1: *model *OPENCV_FISHEYE*pinhole");
    expectColmap("1 EQUIRECTANGULAR 640 480 640 480\n", image, "images.txt:1: *EQUIRECTANGULAR*pinhole");
    expectColmap("1 DIVISION 640 480 500 510 320 240 0.1\n", image, "images.txt:1: *distortion (DIVISION 0.1)");
    expectColmap("1 PINHOLE 640 480 0 510 320 240\n", image, "images.txt:1: *a.png: *focal");
    expectColmap("1 PINHOLE 64000 480 500 510 320 240\n", image, "images.txt:1: *size 64000 x 480");
    expectColmap("1 PINHOLE 640 480 500 510 nan 240\n", image, "images.txt:1: *principal point *finite");
}

TEST_F(CameraListErrors, DistortionIsRefusedUnlessDropped) {
    const std::string image = "1 " + kColmapPose + " 1 a.png\n\n", lens = "1 SIMPLE_RADIAL 640 480 500 320 240 0.01\n";
    expectColmap(lens, image, "images.txt:1: *distortion (SIMPLE_RADIAL 0.01)*--distortion drop");
    EXPECT_EQ(readCameraList(folder.file("images.txt"), {{}, true}).at(0).lens, (PinholeLens{500, 500, 320, 240}));
    expectJson(framed(kLens, ", \"k1\": -0.1, \"p2\": 0.002"), "frame 0: *distortion (k1 -0.1, p2 0.002)");
    EXPECT_EQ(readCameraList(folder.file("transforms.json"), {{}, true}).size(), 1u);
    folder.write("cameras.txt", "1 OPENCV 640 480 500 510 320 240 0 0 0 0\n"); // without distortion
    EXPECT_EQ(readCameraList(folder.file("images.txt"), {}).size(), 1u);
}

TEST_F(CameraListErrors, InvalidTransformsAreNamedByTheirFrame) {
    expectJson("{\"frames\": [", "byte ");
    expectJson("[]", "\"frames\" *missing");
    expectJson("{\"frames\": 1}", "\"frames\" *missing");
    expectJson("{\"frames\": []}", "no cameras");
    expectJson("{\"frames\": [7]}", "frame 0: *object");
    expectJson("{\"frames\": [{}]}", "frame 0: file_path *missing");
    expectJson("{\"w\": 4, \"h\": 4, \"fl_x\": 4, \"frames\": [{\"file_path\": \"a\"}]}",
               "frame 0: transform_matrix *missing");
    expectJson(framed("\"w\": 64, \"h\": 48"), "frame 0: fl_x *camera_angle_x *missing");
    expectJson(framed("\"fl_x\": 50"), "frame 0: w *h *missing*--size");
    expectJson(framed("\"w\": 64, \"h\": 48.5, \"fl_x\": 50"), "frame 0: h *integer");
    expectJson(framed(kLens + ", \"cx\": \"middle\""), "frame 0: cx *number");
    expectJson(framed(kLens + ", \"camera_model\": \"OPENCV_FISHEYE\""), "camera_model OPENCV_FISHEYE *pinhole");
    expectJson(framed(kLens + ", \"is_fisheye\": true"), "is_fisheye: *pinhole");
    expectJson(framed(kLens + ", \"ftheta_p0\": 0.1"), "ftheta_p0: *pinhole");
    expectJson(framed(kLens + ", \"applied_scale\": 0.5"), "applied_scale 0.5 *1");
    expectJson(framed(kLens + ", \"applied_transform\": [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0]]"),
               "applied_transform *rotation");
    const auto matrix = [](const std::string& rows) {
        return "{" + kLens + ", \"frames\": [{\"file_path\": \"a\", \"transform_matrix\": " + rows + "}]}";
    };
    expectJson(matrix("[[1, 0, 0, 0], [0, 1, 0, 0]]"), "transform_matrix *3 or 4");
    expectJson(matrix("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, \"1\", 0]]"), "transform_matrix *3 or 4");
    expectJson(matrix("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]"), "last row *transform_matrix");
    expectJson(matrix("[[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0]]"), "frame 0: *camera of a: *axes *not");
    expectJson(matrix("[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"), "frame 0: *camera of a: *mirrored");
}

TEST_F(CameraListErrors, TruncatedBinaryFilesAreRefused) {
    const std::string cameras = packedCameras(), images = packedImages();
    folder.write("images.bin", images);
    for (std::size_t size = 0; size < cameras.size(); ++size) {
        folder.write("cameras.bin", cameras.substr(0, size));
        expectRefused("images.bin", "cameras.bin: byte ");
    }
    folder.write("cameras.bin", cameras + "x");
    expectRefused("images.bin", "cameras.bin: byte 64: *extra");
    folder.write("cameras.bin", cameras);
    for (std::size_t size = 0; size < images.size(); ++size) {
        folder.write("images.bin", images.substr(0, size));
        expectRefused("images.bin", "images.bin: byte ");
    }
    for (const std::size_t at : {0u, 4u, 7u}) { // counts larger than the file
        std::string many = images;
        many[at] = '\x7f';
        folder.write("images.bin", many);
        expectRefused("images.bin", "images.bin: byte ");
    }
}

} // namespace
} // namespace pointrt::test
