// SPDX-License-Identifier: Apache-2.0
// Colours of faces: materials, textures, and numbers beside the corners.
#include <cstdio>
#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>

#include "tests/preprocess/input/input_fixture.h"

#include "preprocess/input/mesh/picture.h"

namespace pointrt {
namespace {

/// 2 x 2 pixels: upper row red and green, lower row blue and white.
const std::vector<std::uint8_t> kPixels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

std::string pngOf(const std::vector<std::uint8_t>& rgb, std::uint32_t width, std::uint32_t height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    std::string bytes(rgb.size() + 4096, '\0');
    png_alloc_size_t size = bytes.size();
    EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr));
    return bytes.substr(0, size);
}

/// One colour throughout, 16 x 16.
std::string jpegOf(const Rgb8& color) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = jpeg.image_height = 16;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<JSAMPLE> row;
    for (int i = 0; i < 16; ++i) row.insert(row.end(), color.begin(), color.end());
    JSAMPROW rows[] = {row.data()};
    for (int i = 0; i < 16; ++i) jpeg_write_scanlines(&jpeg, rows, 1);
    jpeg_finish_compress(&jpeg);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    jpeg_destroy_compress(&jpeg);
    std::free(data);
    return bytes;
}

std::string webpOf(const std::vector<std::uint8_t>& rgb, int width, int height) {
    std::uint8_t* data = nullptr;
    const std::size_t size = WebPEncodeLosslessRGB(rgb.data(), width, height, 3 * width, &data);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    WebPFree(data);
    return bytes;
}

InputFile inMemory(const std::string& bytes) {
    InputFile file;
    file.name = "picture";
    file.bytes = bytes;
    return file;
}

int distance(const Rgb8& a, const Rgb8& b) {
    int most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

struct PaintTest : InputTest {
    static Cloud sampled(const std::string& path, std::uint64_t count = 4000) {
        ReadOptions options;
        options.sample_count = count;
        return read(path, options);
    }
    /// Expects a single colour for the samples with x < 1, and another one for the others.
    static std::array<Rgb8, 2> halves(const Cloud& cloud) {
        std::array<Rgb8, 2> colors{};
        std::array<bool, 2> seen{};
        EXPECT_EQ(cloud.colors.size(), cloud.positions.size());
        for (std::size_t i = 0; i < cloud.colors.size(); ++i) {
            const std::size_t half = world(cloud, i).x() < 1 ? 0 : 1;
            if (seen[half]) {
                EXPECT_EQ(cloud.colors[i], colors[half]) << i;
            }
            colors[half] = cloud.colors[i];
            seen[half] = true;
        }
        return colors;
    }
};

/// Two unit squares side by side; %s: before the first and the second face
const char* const kSquares = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST_F(PaintTest, PicturesOfAllFormats) {
    for (const std::string& bytes : {pngOf(kPixels, 2, 2), webpOf(kPixels, 2, 2)}) {
        const Picture picture = readPicture(inMemory(bytes));
        EXPECT_EQ(picture.rgb, kPixels);
        EXPECT_EQ(picture.at({0, 0}), (Rgb8{0, 0, 255})); // lower left
        EXPECT_EQ(picture.at({1, 0}), (Rgb8{255, 255, 255}));
        EXPECT_EQ(picture.at({0, 1}), (Rgb8{255, 0, 0}));
        EXPECT_EQ(picture.at({1, 1}), (Rgb8{0, 255, 0}));
        EXPECT_EQ(picture.at({0.5, 1}), (Rgb8{128, 128, 0}));
        EXPECT_EQ(picture.at({3.25, -0.75}), (Rgb8{0, 0, 255})); // repeats
        EXPECT_EQ(picture.at({std::nan(""), 0}), Rgb8{});
    }
    const Picture jpeg = readPicture(inMemory(jpegOf({200, 100, 50})));
    EXPECT_LE(distance(jpeg.at({0.5, 0.5}), {200, 100, 50}), 2);
}

TEST_F(PaintTest, MalformedPicturesAreRefused) {
    for (const std::string& bytes : {pngOf(kPixels, 2, 2), webpOf(kPixels, 2, 2), jpegOf({1, 2, 3})})
        for (std::size_t size = 0; size < bytes.size(); size += size < 40 ? 1 : 7) {
            const std::string part = bytes.substr(0, size);
            try {
                readPicture(inMemory(part));
                EXPECT_GT(size, bytes.size() / 2); // an end mark may be missing
            } catch (const Error& error) {
                EXPECT_EQ(error.code, ExitCode::kBadInput);
            }
        }
    std::string huge = pngOf(kPixels, 2, 2); // its header says 60000 x 60000
    huge.replace(16, 8, std::string("\0\0\xea\x60\0\0\xea\x60", 8));
    EXPECT_THROW(readPicture(inMemory(huge)), Error);
}

TEST_F(PaintTest, MaterialsOfObj) {
    write("a.mtl",
          "# materials\nnewmtl red\nKd 1 0 0\nnewmtl my tex\nKd 0 0 0\nmap_Kd -s 1 1 1 -clamp on maps\\blue 1.png\n");
    write("blue 1.png", pngOf({0, 0, 255}, 1, 1));
    const std::string path = write("a.obj", std::string("mtllib a.mtl\n") + kSquares +
                                                "usemtl red\nf 1 2 3 4\nusemtl my tex\nf 5/1 6/2 7/3 8/4\n");
    for (const std::uint64_t count : {std::uint64_t{4000}, std::uint64_t{0}}) {
        const Cloud cloud = sampled(path, count);
        if (count > 0) {
            EXPECT_EQ(halves(cloud), (std::array{Rgb8{255, 0, 0}, Rgb8{0, 0, 255}}));
        } else {
            EXPECT_EQ(cloud.colors.at(0), (Rgb8{255, 0, 0}));
            EXPECT_EQ(cloud.colors.at(5), (Rgb8{0, 0, 255}));
        }
        EXPECT_EQ(notesOf(cloud), "");
    }
}

TEST_F(PaintTest, TexturesAreSampledOntoFaces) {
    write("a.mtl", "NEWMTL m\nMAP_KD a.png\n"); // as some programs write them
    write("a.png", pngOf(kPixels, 2, 2));
    const std::string path = write("a.obj", std::string("mtllib a.mtl\n") + kSquares + "usemtl m\nf 1/1 2/2 3/3 4/4\n");
    const Cloud cloud = sampled(path);
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3d at = world(cloud, i);
        const auto share = [](double v) { return std::clamp(2 * v - 0.5, 0.0, 1.0); };
        const double x = share(at.x()), y = share(at.y());
        const Vec3d lower = (1 - x) * Vec3d(0, 0, 255) + x * Vec3d(255, 255, 255);
        const Vec3d upper = (1 - x) * Vec3d(255, 0, 0) + x * Vec3d(0, 255, 0), color = (1 - y) * lower + y * upper;
        for (std::size_t channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(cloud.colors[i][channel], color[static_cast<int>(channel)], 1.01);
    }
}

TEST_F(PaintTest, MissingMaterialsAndTexturesAreNoted) {
    const std::string square = std::string(kSquares) + "usemtl m\nf 1/1 2/2 3/3 4/4\n";
    EXPECT_HAS(notesOf(readText("a.obj", "mtllib none.mtl\n" + square)), "a.obj: *'none.mtl'");
    EXPECT_HAS(notesOf(readText("a.obj", "mtllib none.mtl\n" + square)), "a.obj: *'m'");
    write("b.mtl", "newmtl m\nKd 0 1 0\nmap_Kd none.png\n");
    const Cloud green = sampled(write("b.obj", "mtllib b.mtl\n" + square));
    EXPECT_HAS(notesOf(green), "b.obj: *'none.png'");
    EXPECT_EQ(green.colors.at(0), (Rgb8{0, 255, 0}));
    write("c.mtl", "newmtl m\nmap_Kd c.tga\n");
    write("c.tga", "what");
    EXPECT_HAS(notesOf(readText("c.obj", "mtllib c.mtl\n" + square)), "c.obj: *c.tga: ");
    write("E.MTL", "newmtl m\nKd 0 0 1\n"); // Windows ignores case in names
    EXPECT_EQ(sampled(write("e.obj", "mtllib e.Mtl\n" + square)).colors.at(0), (Rgb8{0, 0, 255}));
    write("d.mtl", "newmtl m\nmap_Kd ../../../etc/passwd\n");
    EXPECT_HAS(notesOf(readText("d.obj", "mtllib d.mtl\n" + square)), "d.obj: *passwd");
}

TEST_F(PaintTest, ColorsOfVerticesPrecedeThoseOfMaterials) {
    write("a.mtl", "newmtl m\nKd 1 0 0\n");
    const Cloud cloud =
        sampled(write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0 0 1 0\nv 1 0 0 0 1 0\nv 0 1 0 0 1 0\nf 1 2 3\n"));
    EXPECT_EQ(cloud.colors.at(0), (Rgb8{0, 255, 0}));
}

TEST_F(PaintTest, ColorsOfPlyFaces) {
    const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n";
    const auto header = [](const char* face, const char* comment = "", const char* vertex = "") {
        return fmt::format(
            "ply\nformat ascii 1.0\n{}element vertex 8\nproperty float x\nproperty float y\nproperty float "
            "z\n{}element face 2\nproperty list uchar int vertex_indices\n{}end_header\n",
            comment, vertex, face);
    };
    const char* const bytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const char* const reals = "property float red\nproperty float green\nproperty float blue\n";
    const std::array expected = {Rgb8{255, 0, 0}, Rgb8{0, 0, 255}};
    EXPECT_EQ(halves(sampled(write("a.ply", header(bytes) + vertices + "4 0 1 2 3 255 0 0\n4 4 5 6 7 0 0 255\n"))),
              expected);
    EXPECT_EQ(halves(sampled(write("b.ply", header(reals) + vertices + "4 0 1 2 3 1 0 0\n4 4 5 6 7 0 0 1\n"))),
              expected);
    // textures: MeshLab's lists on faces, and places on vertices
    write("red.png", pngOf({255, 0, 0}, 1, 1));
    write("blue.png", pngOf({0, 0, 255}, 1, 1));
    const char* const two = "comment TextureFile red.png\ncomment TextureFile blue.png\n";
    const char* const lists = "property list uchar float texcoord\nproperty int texnumber\n";
    EXPECT_EQ(halves(sampled(write("c.ply", header(lists, two) + vertices +
                                                "4 0 1 2 3 8 0 0 1 0 1 1 0 1 0\n4 4 5 6 7 8 0 0 1 0 1 1 0 1 1\n"))),
              expected);
    write("halves.png", pngOf({255, 0, 0, 0, 0, 255}, 2, 1));
    std::string placed;
    for (int i = 0; i < 8; ++i)
        placed += fmt::format("{} {} 0 {} 0\n", i / 4 + (i % 4 == 1 || i % 4 == 2), i % 4 / 2, i / 4);
    EXPECT_EQ(halves(sampled(write(
                  "d.ply", header("", "comment TextureFile halves.png\n", "property float s\nproperty float t\n") +
                               placed + "4 0 1 2 3\n4 4 5 6 7\n"))),
              expected);
    EXPECT_HAS(
        notesOf(readText("e.ply", header("", "comment TextureFile none.png\n") + vertices + "4 0 1 2 3\n4 4 5 6 7\n")),
        "e.ply: *'none.png'");
}

TEST_F(PaintTest, ColorsOfOffFaces) {
    const std::string vertices = "8 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n";
    const std::array expected = {Rgb8{255, 0, 0}, Rgb8{0, 0, 255}};
    EXPECT_EQ(halves(sampled(write("a.off", "OFF\n" + vertices + "4 0 1 2 3 255 0 0\n4 4 5 6 7 0 0 255\n"))), expected);
    EXPECT_EQ(halves(sampled(write("b.off", "OFF\n" + vertices + "4 0 1 2 3 1.0 0 0 1\n4 4 5 6 7 0 0 1.0 1\n"))),
              expected);
    EXPECT_TRUE(sampled(write("c.off", "OFF\n" + vertices + "4 0 1 2 3 7\n4 4 5 6 7\n")).colors.empty());
    EXPECT_EQ(read(write("d.off", "OFF" + vertices + "4 0 1 2 3\n4 4 5 6 7\n")).positions.size(), 8u); // "OFF8 2 0"
}

TEST_F(PaintTest, RemovedFacesTakeTheirColorsAlong) {
    // the first face has a vertex that is not finite
    const Cloud cloud = sampled(write("a.off", "OFF\n7 3 0\nnan 0 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n"
                                               "3 0 1 2 0 255 0\n3 1 2 3 255 0 0\n3 4 5 6 0 0 255\n"));
    EXPECT_EQ(halves(cloud), (std::array{Rgb8{255, 0, 0}, Rgb8{0, 0, 255}}));
}

} // namespace
} // namespace pointrt
