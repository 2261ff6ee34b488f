// SPDX-License-Identifier: Apache-2.0
// Files of the image writers, read back by tinyexr and libpng.
#include <gtest/gtest.h>

#include <png.h>
#include <tinyexr.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "format/base/error.h"
#include "runtime/image/image_exr.h"
#include "runtime/image/image_png.h"
#include "runtime/util/output_file.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

class ImageIo : public testing::Test {
protected:
    std::string path(const char* name) const { return folder.file(name); }
    const test::TemporaryFolder folder;
};

/// Values that differ in every channel and pixel; every third pixel is a miss.
Film testFilm(std::uint32_t width, std::uint32_t height) {
    Film film{width, height, {}, {}, {}, {}};
    std::uint32_t noise = 1;
    const auto next = [&] {
        noise = noise * 1664525u + 1013904223u;
        return static_cast<float>(noise >> 8) * 0x1p-20f - 8.0f;
    };
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const bool hit = i % 3 != 0;
        for (int c = 0; c < 4; ++c) film.rgba.push_back(next());
        for (int c = 0; c < 3; ++c) film.normal.push_back(hit ? next() : 0);
        for (int c = 0; c < 3; ++c) film.position.push_back(hit ? next() : 0);
        film.depth.push_back(hit ? next() : std::numeric_limits<float>::infinity());
    }
    return film;
}

struct ExrImage {
    int width = 0, height = 0;
    std::vector<std::string> names; // in the order of the file
    std::map<std::string, std::vector<float>> channels;
    std::map<std::string, std::vector<std::uint32_t>> words;
    std::map<std::string, std::string> texts;
};

ExrImage parseExr(const std::string& path) {
    ExrImage result;
    EXRVersion version;
    EXRHeader header;
    EXRImage image;
    const char* error = nullptr;
    InitEXRHeader(&header);
    InitEXRImage(&image);
    EXPECT_EQ(ParseEXRVersionFromFile(&version, path.c_str()), TINYEXR_SUCCESS);
    EXPECT_EQ(ParseEXRHeaderFromFile(&header, &version, path.c_str(), &error), TINYEXR_SUCCESS) << error;
    EXPECT_EQ(header.compression_type, TINYEXR_COMPRESSIONTYPE_ZIP);
    if (LoadEXRImageFromFile(&image, &header, path.c_str(), &error) != TINYEXR_SUCCESS) {
        ADD_FAILURE() << error;
        return result;
    }
    result.width = image.width;
    result.height = image.height;
    const int pixels = image.width * image.height;
    for (int c = 0; c < header.num_channels; ++c) {
        const std::string name = header.channels[c].name;
        result.names.push_back(name);
        const auto* values = reinterpret_cast<const float*>(image.images[c]);
        const auto* words = reinterpret_cast<const std::uint32_t*>(image.images[c]);
        if (header.pixel_types[c] == TINYEXR_PIXELTYPE_FLOAT)
            result.channels[name].assign(values, values + pixels);
        else if (header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT)
            result.words[name].assign(words, words + pixels);
    }
    for (int i = 0; i < header.num_custom_attributes; ++i) {
        const EXRAttribute& attribute = header.custom_attributes[i];
        const auto* text = reinterpret_cast<const char*>(attribute.value);
        if (attribute.type == std::string("string")) result.texts[attribute.name].assign(text, text + attribute.size);
    }
    FreeEXRImage(&image);
    FreeEXRHeader(&header);
    return result;
}

/// Compares bits, so that infinities count.
void expectChannel(const ExrImage& image, const char* name, const std::vector<float>& data, std::size_t first,
                   std::size_t stride) {
    const auto found = image.channels.find(name);
    ASSERT_NE(found, image.channels.end()) << name;
    ASSERT_EQ(found->second.size() * stride, data.size()) << name;
    for (std::size_t i = 0; i < found->second.size(); ++i)
        ASSERT_EQ(std::memcmp(&found->second[i], &data[i * stride + first], sizeof(float)), 0) << name << " " << i;
}

TEST_F(ImageIo, Exr_KeepsEveryChannelExactly) {
    // one row, one block, and one and several blocks with a partial block
    for (const auto& [width, height] : {std::pair{1u, 1u}, {5u, 16u}, {7u, 17u}, {101u, 70u}}) {
        const Film film = testFilm(width, height);
        writeExr(path("a.exr"), film);
        const ExrImage image = parseExr(path("a.exr"));
        EXPECT_EQ(image.width, static_cast<int>(width));
        EXPECT_EQ(image.height, static_cast<int>(height));
        EXPECT_EQ(image.names,
                  (std::vector<std::string>{"A", "B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z"}));
        const char* colours[] = {"R", "G", "B", "A"};
        const char* normals[] = {"N.X", "N.Y", "N.Z"};
        const char* positions[] = {"P.X", "P.Y", "P.Z"};
        for (std::size_t c = 0; c < 4; ++c) expectChannel(image, colours[c], film.rgba, c, 4);
        for (std::size_t c = 0; c < 3; ++c) expectChannel(image, normals[c], film.normal, c, 3);
        for (std::size_t c = 0; c < 3; ++c) expectChannel(image, positions[c], film.position, c, 3);
        expectChannel(image, "Z", film.depth, 0, 1);
        EXPECT_TRUE(std::isinf(image.channels.at("Z")[0]));
    }
}

TEST_F(ImageIo, Exr_HasTheChannelsOfTheFilm) {
    Film film = testFilm(19, 18);
    const std::size_t pixels = 19 * 18;
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
        const float value = static_cast<float>(i);
        film.direct.push_back(value);
        film.indirect.push_back(value + 0.25f);
        film.caustic.push_back(value + 0.5f);
        film.albedo.push_back(value / static_cast<float>(3 * pixels));
    }
    for (std::uint32_t i = 0; i < pixels; ++i) {
        film.splat_id.push_back(i % 5 == 0 ? 0xFFFFFFFFu : 0xFFFF0000u + i); // not representable as floats
        film.tile_id.push_back(3 * i);
        film.instance_id.push_back(i);
        film.material_id.push_back(pixels - i);
        film.samples.push_back(static_cast<float>(i + 1));
        film.variance.push_back(static_cast<float>(i) * 0.125f);
    }
    writeExr(path("a.exr"), film, std::vector<ExrText>{{"pointrt.note", "two words"}});
    const ExrImage image = parseExr(path("a.exr"));
    EXPECT_EQ(image.names, (std::vector<std::string>{"A",           "B",           "G",        "N.X",      "N.Y",
                                                     "N.Z",         "P.X",         "P.Y",      "P.Z",      "R",
                                                     "Z",           "albedo.B",    "albedo.G", "albedo.R", "caustic.B",
                                                     "caustic.G",   "caustic.R",   "direct.B", "direct.G", "direct.R",
                                                     "id.instance", "id.material", "id.splat", "id.tile",  "indirect.B",
                                                     "indirect.G",  "indirect.R",  "samples",  "variance"}));
    const char* colours[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        expectChannel(image, (std::string("direct.") + colours[c]).c_str(), film.direct, c, 3);
        expectChannel(image, (std::string("indirect.") + colours[c]).c_str(), film.indirect, c, 3);
        expectChannel(image, (std::string("caustic.") + colours[c]).c_str(), film.caustic, c, 3);
        expectChannel(image, (std::string("albedo.") + colours[c]).c_str(), film.albedo, c, 3);
        expectChannel(image, colours[c], film.rgba, c, 4);
    }
    EXPECT_EQ(image.words.at("id.splat"), film.splat_id);
    EXPECT_EQ(image.words.at("id.tile"), film.tile_id);
    EXPECT_EQ(image.words.at("id.instance"), film.instance_id);
    EXPECT_EQ(image.words.at("id.material"), film.material_id);
    EXPECT_EQ(image.channels.at("samples"), film.samples);
    EXPECT_EQ(image.channels.at("variance"), film.variance);
    EXPECT_EQ(image.texts.at("pointrt.note"), "two words");
    EXPECT_EQ(image.texts.at("software").substr(0, 13), "pointrt-view ");
}

TEST_F(ImageIo, Exr_OfAPictureOnly) {
    Film film = testFilm(3, 2);
    film.depth = film.normal = film.position = {};
    writeExr(path("a.exr"), film);
    EXPECT_EQ(parseExr(path("a.exr")).names, (std::vector<std::string>{"A", "B", "G", "R"}));
    film.albedo.resize(5);
    EXPECT_THROW(writeExr(path("a.exr"), film), std::logic_error);
    film.albedo.clear();
    film.rgba.clear();
    EXPECT_THROW(writeExr(path("a.exr"), film), std::logic_error);
}

TEST_F(ImageIo, Exr_RefusesInvalidNames) {
    const float value = 1;
    const ExrChannel twice[] = {{"a", &value}, {"b", &value}, {"a", &value}};
    EXPECT_THROW(writeExr(path("a.exr"), {1, 1}, twice), std::logic_error);
    const ExrChannel longer[] = {{std::string(32, 'x'), &value}};
    EXPECT_THROW(writeExr(path("a.exr"), {1, 1}, longer), std::logic_error);
}

TEST_F(ImageIo, Exr_CompressesFlatPictures) {
    Film film{256,
              256,
              std::vector<float>(4 * 65536, 0.5f),
              std::vector<float>(65536, 1),
              std::vector<float>(3 * 65536),
              std::vector<float>(3 * 65536)};
    writeExr(path("flat.exr"), film);
    EXPECT_LT(fs::file_size(path("flat.exr")), 11u * 4 * 65536 / 50);
    expectChannel(parseExr(path("flat.exr")), "G", film.rgba, 1, 4);
}

Film noiseFilm(std::uint32_t size) {
    Film film = testFilm(size, size);
    std::uint64_t state = 1;
    for (std::vector<float>* values : {&film.rgba, &film.depth, &film.normal, &film.position})
        for (float& value : *values) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            value = std::bit_cast<float>(static_cast<std::uint32_t>(state >> 32));
        }
    return film;
}

TEST_F(ImageIo, Exr_StoresNoiseUncompressed) {
    constexpr std::uint64_t kPixelBytes = 44, kBlockBytes = 16; // 11 channels; a table entry and a block's head
    writeExr(path("pixel.exr"), noiseFilm(1));
    const std::uint64_t header_bytes = fs::file_size(path("pixel.exr")) - kPixelBytes - kBlockBytes;
    const Film film = noiseFilm(64);
    writeExr(path("noise.exr"), film);
    EXPECT_EQ(fs::file_size(path("noise.exr")), header_bytes + 4 * kBlockBytes + 64 * 64 * kPixelBytes);
    expectChannel(parseExr(path("noise.exr")), "P.Y", film.position, 1, 3);
}

TEST_F(ImageIo, Png_KeepsPixels) {
    for (std::uint32_t channels : {3u, 4u}) {
        Image8 image{37, 11, channels, {}};
        for (std::uint32_t i = 0; i < 37 * 11 * channels; ++i)
            image.pixels.push_back(static_cast<std::uint8_t>(i * 37 + i / 5));
        writePng(path("a.png"), image);
        png_image read{};
        read.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_file(&read, path("a.png").c_str())) << read.message;
        EXPECT_EQ(read.width, 37u);
        EXPECT_EQ(read.height, 11u);
        EXPECT_EQ(read.format, channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB);
        std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(read));
        ASSERT_TRUE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr));
        EXPECT_EQ(pixels, image.pixels);
    }
}

TEST_F(ImageIo, Png_HasItsMetadata) {
    writePng(path("a.png"), {1, 1, 3, {1, 2, 3}});
    std::ifstream file(path("a.png"), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(bytes.find("sRGB"), std::string::npos);
    EXPECT_NE(bytes.find(std::string("Software\0pointrt-view ", 22)), std::string::npos);
}

TEST_F(ImageIo, Writing_ReplacesAtomically) {
    writePng(path("a.png"), {1, 1, 3, {1, 2, 3}});
    const auto size = fs::file_size(path("a.png"));
    writePng(path("a.png"), {64, 64, 3, std::vector<std::uint8_t>(64 * 64 * 3, 7)});
    EXPECT_NE(fs::file_size(path("a.png")), size);
    EXPECT_EQ(folder.entries(), 1u);
}

void expectCannotWrite(const std::string& path, const char* reason, const std::function<void()>& body) {
    try {
        body();
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotWrite);
        EXPECT_SAYS(error.what(), path + ": " + reason);
    }
}

TEST_F(ImageIo, Errors_SayWhy) {
    const std::string missing = path("none/a.exr"), occupied = path("folder.png");
    fs::create_directory(occupied);
    expectCannotWrite(missing, "*folder*exist", [&] { requireWritable(missing); });
    expectCannotWrite(missing, "*folder*exist", [&] { writeExr(missing, testFilm(2, 2)); });
    expectCannotWrite(occupied, "*is a folder", [&] { requireWritable(occupied); });
    expectCannotWrite(occupied, "*is a folder", [&] { writePng(occupied, {1, 1, 3, {1, 2, 3}}); });
    EXPECT_EQ(folder.entries(), 1u);
    requireWritable(path("fine.png"));
}

} // namespace
} // namespace pointrt
