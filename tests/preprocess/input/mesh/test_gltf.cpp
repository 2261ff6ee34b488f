// SPDX-License-Identifier: Apache-2.0
// glTF and GLB: points, meshes and Gaussians.
#include "tests/preprocess/input/gaussian/gaussian_files.h"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <png.h>

#include "format/pointio/base64.h"
#include "preprocess/cloud/gaussians.h"

namespace pointrt {
namespace {

using Json = nlohmann::json;
using GltfTest = InputTest;

/// A file under construction. Its accessors and buffer views are added with their bytes.
struct Gltf {
    Json json = {{"asset", {{"version", "2.0"}}},
                 {"meshes", Json::array()},
                 {"nodes", Json::array()},
                 {"accessors", Json::array()},
                 {"bufferViews", Json::array()}};
    std::string bytes;

    std::size_t view(const std::string& data, std::size_t stride = 0) {
        Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}};
        if (stride > 0) view["byteStride"] = stride;
        bytes += data;
        json["bufferViews"].push_back(view);
        return json["bufferViews"].size() - 1;
    }

    std::size_t accessor(std::size_t view, std::size_t count, int type, const char* shape, std::size_t offset = 0) {
        json["accessors"].push_back(
            {{"bufferView", view}, {"count", count}, {"componentType", type}, {"type", shape}, {"byteOffset", offset}});
        return json["accessors"].size() - 1;
    }

    /// An accessor of floats with a view of its own.
    std::size_t floats(const std::vector<float>& values, const char* shape, std::size_t components) {
        std::string data;
        for (const float value : values) data += bytesOf(value);
        return accessor(view(data), values.size() / components, 5126, shape);
    }
    std::size_t threes(const std::vector<float>& values) { return floats(values, "VEC3", 3); }

    /// A mesh of one primitive, and a node for it.
    Json& add(Json primitive, Json node = Json::object()) {
        json["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
        node["mesh"] = json["meshes"].size() - 1;
        json["nodes"].push_back(std::move(node));
        return json["meshes"].back()["primitives"][0];
    }

    std::string glb() const {
        Json with_buffer = json;
        with_buffer["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = with_buffer.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto word = [](std::size_t number) { return bytesOf(static_cast<std::uint32_t>(number)); };
        const std::string chunks =
            word(text.size()) + "JSON" + text + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
        return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
    }

    std::string textWith(const std::string& uri) const {
        Json with_buffer = json;
        with_buffer["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
        return with_buffer.dump();
    }
};

/// A corner with legs of 1 along x and 2 along y.
const std::vector<float> kCorner = {0, 0, 0, 1, 0, 0, 0, 2, 0};

Gltf pointsOf(const std::vector<float>& positions) {
    Gltf gltf;
    gltf.add({{"mode", 0}, {"attributes", {{"POSITION", gltf.threes(positions)}}}});
    return gltf;
}

Gltf triangle() {
    Gltf gltf;
    gltf.add({{"attributes", {{"POSITION", gltf.threes(kCorner)}}}});
    return gltf;
}

TEST_F(GltfTest, PointsHaveColoursAndNormals) {
    Gltf gltf;
    const std::size_t position = gltf.threes({1, 2, 3, -1, 0.5f, 1e6f}), normal = gltf.threes({0, 0, 1, 0, 1, 0});
    const std::size_t color = gltf.accessor(gltf.view(std::string("\xff\x80\0\xff\1\0\xff\xff", 8)), 2, 5121, "VEC4");
    gltf.json["accessors"][color]["normalized"] = true;
    gltf.add({{"mode", 0}, {"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"COLOR_0", color}}}});
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(world(cloud, 1), Vec3d(-1, 0.5, 1e6));
    EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(cloud.colors[0], (Rgb8{255, 188, 0})); // colours are linear: 128 is half of white, 188 in sRGB
    EXPECT_EQ(cloud.world.up, Vec3d(0, 1, 0));
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
    EXPECT_TRUE(cloud.triangles.empty());
}

TEST_F(GltfTest, BuffersAreInTheFileOrBesideIt) {
    const Gltf gltf = pointsOf(kCorner);
    write("my data.bin", gltf.bytes);
    for (const std::string& text : {gltf.glb(), gltf.textWith("my%20data.bin"),
                                    gltf.textWith("data:application/octet-stream;base64," + toBase64(gltf.bytes))}) {
        const Cloud cloud = readText("a.gltf", text);
        ASSERT_EQ(cloud.positions.size(), 3u);
        EXPECT_EQ(world(cloud, 2), Vec3d(0, 2, 0));
    }
}

TEST_F(GltfTest, AttributesMayBeInterleavedAndSmall) {
    Gltf gltf;
    std::string data;
    for (const int x : {0, 32767, -32768}) {
        for (const int part : {x, 100, -100}) data += bytesOf(static_cast<std::int16_t>(part));
        data += std::string("\0\0\x7f\0\x81\0", 6); // padding, and a normal of bytes
    }
    const std::size_t view = gltf.view(data, 12);
    const std::size_t position = gltf.accessor(view, 3, 5122, "VEC3"), normal = gltf.accessor(view, 3, 5120, "VEC3", 8);
    gltf.json["accessors"][position]["normalized"] = gltf.json["accessors"][normal]["normalized"] = true;
    gltf.add({{"mode", 0}, {"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_EQ(world(cloud, 1).x(), 1);
    EXPECT_EQ(world(cloud, 2).x(), -1);
    EXPECT_NEAR(world(cloud, 0).y(), 100 / 32767.0, 1e-7);
    EXPECT_EQ(cloud.normals[0], Vec3f(1, 0, -1));
    gltf.json["accessors"][position]["normalized"] = false;
    EXPECT_EQ(world(readText("a.glb", gltf.glb()), 2).x(), -32768);
}

TEST_F(GltfTest, TrianglesHaveIndicesOfAnySize) {
    for (const int type : {5121, 5123, 5125}) {
        Gltf gltf = triangle();
        std::string data;
        for (const std::uint32_t index : {2u, 0u, 1u})
            data += bytesOf(index).substr(0, type == 5121 ? 1 : type == 5123 ? 2 : 4);
        gltf.json["meshes"][0]["primitives"][0]["indices"] = gltf.accessor(gltf.view(data), 3, type, "SCALAR");
        const Cloud cloud = readText("a.glb", gltf.glb());
        ASSERT_EQ(cloud.triangles.size(), 1u);
        EXPECT_EQ(cloud.triangles[0], (std::array<std::uint32_t, 3>{2, 0, 1}));
        EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1)); // of the face
    }
}

TEST_F(GltfTest, StripsAndFansFaceTheSameWay) {
    // a square around a zigzag, and around its first corner
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    for (const int mode : {5, 6}) {
        Gltf gltf;
        gltf.add({{"mode", mode}, {"attributes", {{"POSITION", gltf.threes(mode == 5 ? strip : fan)}}}});
        const Cloud cloud = readText("a.glb", gltf.glb());
        EXPECT_EQ(cloud.triangles.size(), 2u);
        for (const Vec3f& normal : cloud.normals) EXPECT_EQ(normal, Vec3f(0, 0, 1)) << mode;
    }
}

TEST_F(GltfTest, NodesPlaceTheirMeshes) {
    Gltf gltf = triangle();
    gltf.json["nodes"][0]["translation"] = {10, 0, 0};
    gltf.json["nodes"][0]["scale"] = {2, 2, 2};
    const double half = std::sqrt(0.5);
    // by columns: x to y, y to -x
    gltf.json["nodes"].push_back({{"children", {0}}, {"rotation", {0, 0, half, half}}});
    gltf.json["nodes"].push_back({{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
    gltf.json["nodes"].push_back({{"mesh", 0}}); // in no scene
    gltf.json["scenes"] = {{{"nodes", {3}}}, {{"nodes", {2}}}};
    gltf.json["scene"] = 1;
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_LT((world(cloud, 0) - Vec3d(0, 10, 5)).norm(), 1e-6);
    EXPECT_LT((world(cloud, 1) - Vec3d(0, 12, 5)).norm(), 1e-6);
    EXPECT_LT((world(cloud, 2) - Vec3d(-4, 10, 5)).norm(), 1e-6);
    gltf.json.erase("scenes");
    gltf.json.erase("scene");
    EXPECT_EQ(readText("a.glb", gltf.glb()).positions.size(), 6u);
}

TEST_F(GltfTest, MirroredMeshesFaceOutwards) {
    Gltf gltf;
    gltf.add({{"attributes", {{"POSITION", gltf.threes(kCorner)}}}}, {{"scale", {-1, 1, 1}}});
    const Cloud cloud = readText("a.glb", gltf.glb());
    EXPECT_EQ(world(cloud, 1), Vec3d(-1, 0, 0));
    EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1));
}

TEST_F(GltfTest, NormalsStayPerpendicularUnderSkews) {
    Gltf gltf;
    const float half = std::sqrt(0.5f);
    gltf.add(
        {{"mode", 0}, {"attributes", {{"POSITION", gltf.threes({1, 0, 0})}, {"NORMAL", gltf.threes({half, half, 0})}}}},
        {{"scale", {2, 1, 1}}});
    const Cloud cloud = readText("a.glb", gltf.glb());
    EXPECT_LT((cloud.normals[0].normalized() - Vec3f(1, 2, 0).normalized()).norm(), 1e-6f);
}

TEST_F(GltfTest, MaterialsColourMeshes) {
    Gltf gltf = triangle();
    gltf.add({{"material", 0}, {"attributes", {{"POSITION", gltf.threes(kCorner)}}}});
    gltf.add({{"material", 1}, {"attributes", {{"POSITION", gltf.threes(kCorner)}}}});
    gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}}}},
                              {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 9u);
    EXPECT_EQ(cloud.colors[0], (Rgb8{200, 200, 200}));
    EXPECT_EQ(cloud.colors[3], (Rgb8{255, 188, 0}));
    EXPECT_HAS(notesOf(cloud), "textures");
    EXPECT_TRUE(readText("b.glb", triangle().glb()).colors.empty());
}

/// Two pixels: red above, blue below.
std::string redAboveBlue() {
    const std::uint8_t rgb[] = {255, 0, 0, 0, 0, 255};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 1;
    image.height = 2;
    image.format = PNG_FORMAT_RGB;
    std::string bytes(4096, '\0');
    png_alloc_size_t size = bytes.size();
    EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb, 0, nullptr));
    return bytes.substr(0, size);
}

TEST_F(GltfTest, TexturesColourFaces) {
    Gltf gltf;
    const std::size_t places = gltf.floats({0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.75f}, "VEC2", 2); // v counts from the top
    gltf.add({{"material", 0}, {"attributes", {{"POSITION", gltf.threes(kCorner)}, {"TEXCOORD_0", places}}}});
    gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    gltf.json["textures"] = {{{"source", 0}}};
    const auto expectColors = [](const Cloud& cloud) {
        ASSERT_EQ(cloud.colors.size(), 3u) << notesOf(cloud);
        EXPECT_EQ(cloud.colors[0], (Rgb8{255, 0, 0}));
        EXPECT_EQ(cloud.colors[2], (Rgb8{0, 0, 255}));
    };
    Gltf inside = gltf;
    inside.json["images"] = {{{"bufferView", inside.view(redAboveBlue())}, {"mimeType", "image/png"}}};
    expectColors(readText("a.glb", inside.glb()));
    gltf.json["images"] = {{{"uri", "data:image/png;base64," + toBase64(redAboveBlue())}}};
    expectColors(readText("b.glb", gltf.glb()));
    gltf.json["images"] = {{{"uri", "my%20picture.png"}}};
    EXPECT_HAS(notesOf(readText("c.glb", gltf.glb())), "my picture.png");
    write("my picture.png", redAboveBlue());
    expectColors(readText("c.glb", gltf.glb()));
}

TEST_F(GltfTest, MeshesAreSampled) {
    ReadOptions options;
    options.sample_count = 1000;
    const Cloud cloud = read(write("a.glb", triangle().glb()), options);
    EXPECT_EQ(cloud.positions.size(), 1000u);
    EXPECT_EQ(cloud.normals[7], Vec3f(0, 0, 1));
}

TEST_F(GltfTest, PointsAndMeshesAreScansOfTheirOwn) {
    Gltf gltf = triangle();
    gltf.add({{"mode", 0}, {"attributes", {{"POSITION", gltf.threes({7, 7, 7})}}}});
    gltf.add({{"mode", 1}, {"attributes", {{"POSITION", gltf.threes({7, 7, 7})}}}});
    gltf.json["animations"] = Json::array();
    const Cloud cloud = readText("a.glb", gltf.glb());
    EXPECT_EQ(cloud.positions.size(), 4u);
    ASSERT_EQ(cloud.scans.size(), 2u);
    EXPECT_EQ(cloud.scans[1].name, (folder / "a.glb").string() + ": meshes");
    EXPECT_HAS(notesOf(cloud), "1 primitives of lines");
    EXPECT_HAS(notesOf(cloud), "animations");
}

/// One Gaussian, the default Blob, with harmonics of degree 1 if wanted.
Json gaussianPrimitive(Gltf& gltf, bool with_harmonics = false) {
    const std::string name = "KHR_gaussian_splatting:";
    Json attributes = {{"POSITION", gltf.threes({1.5f, -2, 0.25f})}};
    attributes[name + "ROTATION"] = gltf.floats({std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)}, "VEC4", 4);
    attributes[name + "SCALE"] = gltf.threes({0.5f, 0.25f, 0.125f});
    attributes[name + "OPACITY"] = gltf.floats({0.8f}, "SCALAR", 1);
    attributes[name + "SH_DEGREE_0_COEF_0"] = gltf.threes({0, 9, -9});
    for (int k = 0; with_harmonics && k < 3; ++k)
        attributes[fmt::format("{}SH_DEGREE_1_COEF_{}", name, k)] =
            gltf.threes({0.1f * static_cast<float>(k), -1, static_cast<float>(k)});
    return {
        {"mode", 0},
        {"attributes", attributes},
        {"extensions", {{"KHR_gaussian_splatting", {{"kernel", "ellipse"}, {"colorSpace", "srgb_rec709_display"}}}}}};
}

GaussianColumns columnsOfGltf(const Cloud& cloud) {
    const auto columns = gaussianColumns(cloud);
    if (!columns) throw std::runtime_error("the cloud has no Gaussians");
    return *columns;
}

TEST_F(GltfTest, GaussiansKeepEveryField) {
    Gltf gltf;
    gltf.add(gaussianPrimitive(gltf, true));
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 1u);
    EXPECT_EQ(world(cloud, 0), Vec3d(1.5, -2, 0.25));
    const GaussianColumns columns = columnsOfGltf(cloud);
    EXPECT_NEAR(columns.opacity[0], 0.8, 1e-6);
    EXPECT_EQ(columns.deviation[2], 0.125f);
    EXPECT_NEAR(columns.rotation[0], std::sqrt(0.5), 1e-6); // w, which the file has last
    EXPECT_NEAR(columns.rotation[1], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(columns.color[1], 0.5 + 9 * 0.28209479177387814, 1e-6);
    ASSERT_EQ(columns.degree, 1);
    EXPECT_NEAR(columns.harmonics[2][0], 0.2, 1e-6);
    EXPECT_EQ(columns.harmonics[2][2], 2);
    EXPECT_EQ(cloud.world.up, Vec3d(0, 1, 0));
    EXPECT_HAS(notesOf(cloud), "1 Gaussians *degree 1");
}

TEST_F(GltfTest, NodesTurnGaussians) {
    Gltf gltf;
    const double half = std::sqrt(0.5);
    gltf.add(gaussianPrimitive(gltf, true), {{"rotation", {0, 0, half, half}}, {"scale", {3, 3, 3}}});
    gltf.add(gaussianPrimitive(gltf));
    const Cloud cloud = readText("a.glb", gltf.glb());
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(cloud.scans.size(), 1u);
    const GaussianColumns columns = columnsOfGltf(cloud);
    const std::size_t turned = world(cloud, 0).x() > 4 ? 0 : 1; // nodes may be read in any order
    EXPECT_LT((world(cloud, turned) - Vec3d(6, 4.5, 0.75)).norm(), 1e-5);
    EXPECT_NEAR(columns.deviation[3 * turned], 1.5, 1e-6);
    const Eigen::Quaterniond turn(half, 0, 0, half), own(half, half, 0, 0);
    const Eigen::Quaterniond got(columns.rotation[4 * turned], columns.rotation[4 * turned + 1],
                                 columns.rotation[4 * turned + 2], columns.rotation[4 * turned + 3]);
    EXPECT_LT(got.angularDistance(turn * own), 1e-5);
    // along y now what was along x: -0.4886 of the third
    double red = 0;
    for (std::size_t k = 0; k < 3; ++k)
        red += gaussianHarmonics(Vec3d::UnitY(), 1)[k] * double(columns.harmonics[k][3 * turned]);
    EXPECT_NEAR(red, -0.4886025119029199 * 0.2, 1e-5);
    EXPECT_EQ(columns.harmonics[2][3 * (1 - turned)], 0); // the other one has none
}

TEST_F(GltfTest, MirroredGaussiansAreRefused) {
    Gltf gltf;
    gltf.add(gaussianPrimitive(gltf), {{"scale", {1, -1, 1}}});
    EXPECT_HAS(reasonOfText("a.glb", gltf.glb()), "a.glb: *mirrors");
}

TEST_F(GltfTest, LinearColoursAreEncoded) {
    Gltf gltf;
    Json primitive = gaussianPrimitive(gltf, true);
    primitive["extensions"]["KHR_gaussian_splatting"]["colorSpace"] = "lin_rec709_display";
    gltf.add(primitive);
    const Cloud cloud = readText("a.glb", gltf.glb());
    EXPECT_NEAR(columnsOfGltf(cloud).color[0], 0.735357, 1e-5); // 0.5
    EXPECT_NEAR(columnsOfGltf(cloud).harmonics[2][0], 0.2 * 1.055 / 2.4 * std::pow(0.5, 1 / 2.4 - 1), 1e-5);
    EXPECT_HAS(notesOf(cloud), "linear");
}

TEST_F(GltfTest, SpzInsideIsRead) {
    const std::string spz = test::spzHeader({2, 1, 1}) + test::joined(test::spzArrays(2)) + std::string(9, '\xc0');
    for (const std::string& data : {spz, gzipped(spz)})
        for (const std::string name :
             {"KHR_gaussian_splatting_compression_spz_2", "KHR_gaussian_splatting_compression_spz",
              "KHR_spz_gaussian_splats_compression"}) {
            SCOPED_TRACE(name);
            Gltf gltf;
            const Json extension = {{name, {{"bufferView", gltf.view(data)}}}};
            const bool beside = name == "KHR_spz_gaussian_splats_compression";
            gltf.add(
                {{"mode", 0},
                 {"attributes", Json::object()},
                 {"extensions", beside ? extension : Json{{"KHR_gaussian_splatting", {{"extensions", extension}}}}}});
            const Cloud cloud = readText("a.glb", gltf.glb());
            ASSERT_EQ(cloud.positions.size(), 1u);
            EXPECT_EQ(world(cloud, 0), Vec3d(1.5, -2, 0.25));
            EXPECT_EQ(columnsOfGltf(cloud).harmonics[0][0], 0.5f);
        }
}

TEST_F(GltfTest, SurfacesAmongGaussiansAreLeftOut) {
    Gltf gltf = triangle();
    gltf.add(gaussianPrimitive(gltf));
    const std::string path = write("a.glb", gltf.glb());
    const Cloud cloud = read(path);
    EXPECT_EQ(cloud.positions.size(), 1u);
    EXPECT_HAS(notesOf(cloud), "1 primitives *left out");
    ReadOptions options;
    options.gaussians_as_discs = true;
    EXPECT_EQ(read(path, options).positions.size(), 4u);
}

TEST_F(GltfTest, InvalidAccessorsAreRefused) {
    const auto with = [&](const char* key, const Json& value) {
        Gltf gltf = pointsOf(kCorner);
        gltf.json["accessors"][0][key] = value;
        return reasonOfText("a.glb", gltf.glb());
    };
    EXPECT_HAS(with("count", 4), "a.glb:accessors[0]: *4 elements, *36 bytes");
    EXPECT_HAS(with("count", 4'000'000'000u), "4000000000 elements");
    EXPECT_HAS(with("count", -1), "accessors[0].count: ");
    EXPECT_HAS(with("count", 1e300), "accessors[0].count: ");
    EXPECT_HAS(with("byteOffset", 1), "3 elements");
    EXPECT_HAS(with("byteOffset", UINT64_MAX), "3 elements");
    EXPECT_HAS(with("bufferView", 1), "accessors[0].bufferView: *1 is *1 bufferViews");
    EXPECT_HAS(with("bufferView", nullptr), "accessors[0]: *no bufferView");
    EXPECT_HAS(with("componentType", 5124), "accessors[0].componentType: *5124");
    EXPECT_HAS(with("type", "MAT4"), "accessors[0].type: *'MAT4'");
    EXPECT_HAS(with("type", "SCALAR"), "accessors[0]: *1 components");
    EXPECT_HAS(with("sparse", {{"count", 1}}), "accessors[0]: *sparse");
    EXPECT_HAS(with("normalized", 1), "accessors[0].normalized: ");
}

TEST_F(GltfTest, InvalidViewsAndBuffersAreRefused) {
    const auto with = [&](const char* key, const Json& value) {
        Gltf gltf = pointsOf(kCorner);
        gltf.json["bufferViews"][0][key] = value;
        return reasonOfText("a.glb", gltf.glb());
    };
    EXPECT_HAS(with("byteLength", 37), "bufferViews[0]: *outside");
    EXPECT_HAS(with("byteOffset", 1), "bufferViews[0]: *outside");
    EXPECT_HAS(with("byteOffset", UINT64_MAX), "bufferViews[0]: *outside");
    EXPECT_HAS(with("byteStride", 4), "accessors[0]: *12 bytes every 4");
    EXPECT_HAS(with("byteStride", UINT64_MAX), "bufferViews[0].byteStride: ");
    EXPECT_HAS(with("buffer", 1), "bufferViews[0].buffer: *1 is *1 buffers");
    EXPECT_HAS(with("extensions", {{"EXT_meshopt_compression", Json::object()}}), "EXT_meshopt_compression");
    const Gltf gltf = pointsOf(kCorner);
    const auto reason = [&](const std::string& uri) { return reasonOfText("a.gltf", gltf.textWith(uri)); };
    EXPECT_HAS(reason("data:;base64,AAA"), "a.gltf:buffers[0].uri: *base64");
    EXPECT_HAS(reason("data:;base64,AAAA"), "truncated: *36 bytes, 3 ");
    EXPECT_HAS(reason("data:text/plain,abc"), "buffers[0].uri: *base64");
    EXPECT_HAS(reason("../a.bin"), "'../a.bin' *outside");
    EXPECT_HAS(reason("%2e%2e/a.bin"), "'../a.bin' *outside");
    EXPECT_HAS(reason("/etc/passwd"), "'/etc/passwd' *outside");
    EXPECT_HAS(reason("https://example.org/a.bin"), "'https://example.org/a.bin' *beside");
    EXPECT_HAS(reason("none.bin"), "none.bin: no such file");
    write("short.bin", "short");
    EXPECT_HAS(reason("short.bin"), "short.bin: truncated: *36 bytes, 5 ");
}

TEST_F(GltfTest, InvalidScenesAreRefused) {
    const auto with = [&](const std::function<void(Json&)>& change) {
        Gltf gltf = triangle();
        change(gltf.json);
        return reasonOfText("a.glb", gltf.glb());
    };
    EXPECT_HAS(with([](Json& json) { json["nodes"][0]["children"] = {0}; }), "no points"); // no node without a parent
    EXPECT_HAS(with([](Json& json) {
                   json["nodes"][0]["children"] = {0};
                   json["scenes"] = {{{"nodes", {0}}}};
               }),
               "nodes[0]: *ancestor");
    EXPECT_HAS(with([](Json& json) { json["nodes"][0]["children"] = {1}; }), "nodes[0].children[0]: ");
    EXPECT_HAS(with([](Json& json) { json["nodes"][0]["mesh"] = 1; }), "nodes[0].mesh: *1 is *1 meshes");
    EXPECT_HAS(with([](Json& json) { json["nodes"][0]["matrix"] = {1, 2}; }), "nodes[0].matrix: *2 is out of range");
    EXPECT_HAS(with([](Json& json) { json["nodes"][0]["rotation"] = {0, 0, 0, 0}; }), "nodes[0].rotation: ");
    EXPECT_HAS(with([](Json& json) { json["scenes"] = {{{"nodes", {5}}}}; }), "nodes: *index 5");
    EXPECT_HAS(with([](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 7; }), "mode: *0 to 6");
    EXPECT_HAS(with([](Json& json) { json["meshes"][0]["primitives"] = Json::array(); }), "no points");
    EXPECT_HAS(with([](Json& json) { json["meshes"][0]["primitives"][0].erase("attributes"); }),
               "attributes: *missing");
    EXPECT_HAS(with([](Json& json) { json["asset"]["version"] = "1.0"; }), "'1.0'*2.0");
    EXPECT_HAS(with([](Json& json) { json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
               "KHR_draco_mesh_compression");
    Gltf gltf = triangle();
    gltf.json["meshes"][0]["primitives"][0]["indices"] =
        gltf.accessor(gltf.view(std::string("\0\1\3", 3)), 3, 5121, "SCALAR");
    EXPECT_HAS(reasonOfText("a.glb", gltf.glb()), "meshes[0].primitives[0]: *index 3 *3 vertices");
}

TEST_F(GltfTest, ManyInstancesOfALargeMeshAreRefused) {
    Gltf gltf = pointsOf(std::vector<float>(3 * 30'000));
    for (int i = 0; i < 1000; ++i) gltf.json["nodes"].push_back({{"mesh", 0}});
    EXPECT_HAS(reasonOfText("a.glb", gltf.glb()), "30030000 vertices");
}

TEST_F(GltfTest, InvalidGaussiansAreRefused) {
    const auto with = [&](const std::function<void(Gltf&, Json&)>& change) {
        Gltf gltf;
        change(gltf, gltf.add(gaussianPrimitive(gltf, true)));
        return reasonOfText("a.glb", gltf.glb());
    };
    EXPECT_HAS(with([](Gltf&, Json& primitive) { primitive["attributes"].erase("KHR_gaussian_splatting:SCALE"); }),
               "attributes.KHR_gaussian_splatting:SCALE: *missing");
    EXPECT_HAS(with([](Gltf& gltf, Json& primitive) {
                   primitive["attributes"]["POSITION"] = gltf.threes({0, 0, 0, 1, 1, 1});
               }),
               "attributes: *2 positions*1");
    EXPECT_HAS(
        with([](Gltf&, Json& primitive) { primitive["extensions"]["KHR_gaussian_splatting"]["kernel"] = "cube"; }),
        "kernel: *'cube'");
    EXPECT_HAS(
        with([](Gltf& gltf, Json& primitive) {
            primitive["extensions"] = {{"KHR_spz_gaussian_splats_compression", {{"bufferView", gltf.view("NGSP")}}}};
        }),
        "SPZ header *truncated");
}

TEST_F(GltfTest, InvalidGlbIsRefused) {
    const std::string good = triangle().glb();
    std::string text = good;
    EXPECT_HAS(reasonOfText("a.glb", text.replace(4, 4, bytesOf(1u))), "version 1*2.0");
    text = good;
    EXPECT_HAS(reasonOfText("a.glb", text.replace(16, 4, "JUNK")), "no JSON");
    text = good;
    EXPECT_HAS(reasonOfText("a.glb", text.replace(12, 4, bytesOf(0xfffffff0u))), "truncated: *4294967280 bytes");
    EXPECT_HAS(reasonOfText("a.gltf", "{\"asset\":{\"version\":\"2.0\"},\"meshes\":["), "JSON");
    EXPECT_HAS(reasonOfText("a.gltf", "{\"asset\":{},\"meshes\":[]}"), "asset.version: *missing");
}

TEST_F(GltfTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.glb", triangle().glb());
    Gltf gltf = pointsOf({1, 2, 3});
    readPrefixes("a.gltf", gltf.textWith("data:;base64," + toBase64(gltf.bytes)));
}

} // namespace
} // namespace pointrt
