// SPDX-License-Identifier: Apache-2.0
// Pictures and films are read back exactly, in every encoding; damaged or malicious files cause nothing worse than an
// error.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <tinyexr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "format/base/error.h"
#include "runtime/image/film_parts.h"
#include "runtime/image/image_exr.h"
#include "runtime/image/image_read.h"
#include "runtime/render/film_file.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<char>;

constexpr float kFilmInfinity = std::numeric_limits<float>::infinity();

class FilmFile : public testing::Test {
protected:
    std::string path(const char* name) const { return folder.file(name); }
    std::string write(const char* name, const Bytes& bytes) const {
        fs::remove(path(name)); // file systems wait for the disk when a file is overwritten
        std::ofstream(path(name), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path(name);
    }
    Bytes read(const char* name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    const test::TemporaryFolder folder;
};

struct Noise {
    std::uint64_t state;
    std::uint32_t next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>(state >> 32);
    }
};

/// Every array has random bits, NaNs among them.
SavedFilm noisyFilm(std::uint32_t width, std::uint32_t height) {
    SavedFilm saved{{}, 4294967295u, 17, "0123456789abcdef"};
    saved.film.width = width;
    saved.film.height = height;
    Noise noise{1};
    forEachFilmPart(saved.film, [&](const FilmPart& part, auto& values) {
        values.resize(part.channels.size() * width * height);
        for (auto& value : values) value = std::bit_cast<std::decay_t<decltype(value)>>(noise.next());
    });
    return saved;
}

/// Expects films that are equal bit for bit.
void expectSame(SavedFilm& expected, const SavedFilm& read) {
    EXPECT_EQ(read.film.width, expected.film.width);
    EXPECT_EQ(read.film.height, expected.film.height);
    EXPECT_EQ(read.samples, expected.samples);
    EXPECT_EQ(read.seed, expected.seed);
    EXPECT_EQ(read.signature, expected.signature);
    std::vector<std::string> texts;
    const auto toTexts = [&](const FilmPart&, const auto& values) {
        texts.emplace_back(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
    };
    forEachFilmPart(expected.film, toTexts);
    const std::size_t parts = texts.size();
    forEachFilmPart(read.film, toTexts);
    for (std::size_t i = 0; i < parts; ++i) EXPECT_TRUE(texts[i] == texts[parts + i]) << "part " << i;
}

void expectBadInput(const std::string& path, const std::string& reason, const std::function<void()>& body) {
    try {
        body();
        FAIL() << "no error: " << reason;
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        const std::string text = error.what();
        EXPECT_EQ(text.substr(0, path.size() + 2), path + ": ");
        EXPECT_HAS(text, reason);
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST_F(FilmFile, RoundTripsBitIdentically) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {5u, 16u}, {67u, 33u}}) {
        SavedFilm saved = noisyFilm(width, height);
        writeSavedFilm(path("a.exr"), saved);
        const auto read = readSavedFilm(path("a.exr"));
        ASSERT_TRUE(read.has_value());
        expectSame(saved, *read);
    }
}

TEST_F(FilmFile, OmitsMissingParts) {
    SavedFilm saved = noisyFilm(20, 20);
    saved.film.caustic.clear();
    saved.film.splat_id.clear();
    saved.film.depth.clear();
    saved.signature.clear();
    writeSavedFilm(path("a.exr"), saved);
    expectSame(saved, *readSavedFilm(path("a.exr")));
}

TEST_F(FilmFile, IsEmptyIfThereIsNoFile) { EXPECT_FALSE(readSavedFilm(path("none.exr")).has_value()); }

TEST_F(FilmFile, InvalidFilmsAreRefusedWithAReason) {
    const std::string file = path("a.exr");
    const SavedFilm saved = noisyFilm(4, 4);
    const auto expectReason = [&](const char* reason) { expectBadInput(file, reason, [&] { readSavedFilm(file); }); };
    writeExr(file, saved.film);
    expectReason("no pointrt.samples");
    std::vector<ExrText> texts = {{"pointrt.samples", "0"}, {"pointrt.seed", "1"}, {"pointrt.signature", "x"}};
    writeExr(file, saved.film, texts);
    expectReason("no samples");
    texts[0].value = "12 ";
    writeExr(file, saved.film, texts);
    expectReason("pointrt.samples *number");
    texts[0].value = "4294967296";
    writeExr(file, saved.film, texts);
    expectReason("pointrt.samples *number");
    texts[0].value = "12";
    texts.pop_back();
    writeExr(file, saved.film, texts);
    expectReason("no pointrt.signature");
    texts.push_back({"pointrt.signature", "x"});
    const float value = 1;
    const ExrChannel incomplete[] = {{"R", &value}, {"G", &value}, {"B", &value}};
    writeExr(file, {1, 1}, incomplete, texts);
    expectReason("no channel A");
    write("a.exr", {'P', 'N', 'G'});
    expectReason("bad OpenEXR");
    fs::remove(file);
    fs::create_directory(file);
    expectReason("directory");
}

/// A picture as another program writes it: 16-bit floats, with one of tinyexr's compressions.
Bytes halfPicture(int compression, int width, int height, const std::vector<float>& red) {
    EXRHeader header;
    EXRImage image;
    InitEXRHeader(&header);
    InitEXRImage(&image);
    std::vector<EXRChannelInfo> channels(3);
    std::vector<int> float_types(3, TINYEXR_PIXELTYPE_FLOAT), half_types(3, TINYEXR_PIXELTYPE_HALF);
    std::vector<float> other(red.size(), 0.5f);
    const float* planes[] = {other.data(), other.data(), red.data()}; // B, G, R
    for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)].name[0] = "BGR"[c];
    header.num_channels = image.num_channels = 3;
    header.channels = channels.data();
    header.pixel_types = float_types.data();
    header.requested_pixel_types = half_types.data();
    header.compression_type = compression;
    image.images = reinterpret_cast<unsigned char**>(const_cast<float**>(planes));
    image.width = width;
    image.height = height;
    unsigned char* memory = nullptr;
    const char* error = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &error);
    EXPECT_GT(size, 0u) << (error ? error : "");
    Bytes bytes(memory, memory + size);
    std::free(memory);
    return bytes;
}

constexpr int kCodings[] = {TINYEXR_COMPRESSIONTYPE_NONE, TINYEXR_COMPRESSIONTYPE_RLE, TINYEXR_COMPRESSIONTYPE_ZIPS,
                            TINYEXR_COMPRESSIONTYPE_ZIP, TINYEXR_COMPRESSIONTYPE_PIZ};

/// Runs of equal values, so that every compression has something to do.
std::vector<float> steps(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i / 7 % 31) * 0.25f;
    return values;
}

TEST_F(FilmFile, PicturesOfAllCompressionsAreRead) {
    const std::vector<float> red = steps(45 * 37);
    for (int coding : kCodings) {
        const FloatImage image = readFloatImage(write("a.exr", halfPicture(coding, 45, 37, red)));
        ASSERT_EQ(image.width, 45u);
        ASSERT_EQ(image.height, 37u);
        for (std::size_t i = 0; i < red.size(); ++i) {
            ASSERT_EQ(image.rgb[3 * i], red[i]) << "coding " << coding << " pixel " << i;
            ASSERT_EQ(image.rgb[3 * i + 1], 0.5f);
        }
    }
}

TEST_F(FilmFile, PictureValuesAreClamped) {
    const float red[] = {-1, std::nanf(""), kFilmInfinity, 1e30f, 70000, 0.25f};
    const ExrChannel channels[] = {{"R", red}, {"G", red}, {"B", red}};
    writeExr(path("a.exr"), {6, 1}, channels);
    const FloatImage image = readFloatImage(path("a.exr"));
    const float expected[] = {0, 0, 65504, 1e9f, 70000, 0.25f};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(image.rgb[3 * i], expected[i]) << i;
    const ExrChannel grey[] = {{"Y", red}}, nameless[] = {{"R", red}, {"G", red}};
    writeExr(path("grey.exr"), {6, 1}, grey);
    EXPECT_EQ(readFloatImage(path("grey.exr")).rgb[14], 70000);
    writeExr(path("b.exr"), {6, 1}, nameless);
    expectBadInput(path("b.exr"), "channels R, G", [&] { readFloatImage(path("b.exr")); });
    expectBadInput(path("none.hdr"), "No such file", [&] { readFloatImage(path("none.hdr")); });
    expectBadInput(write("a.png", {'P', 'N', 'G'}), "neither", [&] { readFloatImage(path("a.png")); });
}

Bytes radiancePicture(const std::string& size, const std::vector<int>& data) {
    const std::string head = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n";
    Bytes bytes(head.begin(), head.end());
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
}

// 128 * 2^(129 - 136) is 1, and each step of the exponent doubles the value.
TEST_F(FilmFile, RadianceIsReadInItsThreeEncodings) {
    const auto rgb = [&](const char* size, const std::vector<int>& data) {
        return readFloatImage(write("a.hdr", radiancePicture(size, data))).rgb;
    };
    using Floats = std::vector<float>;
    EXPECT_EQ(rgb("-Y 1 +X 2", {128, 64, 0, 129, 255, 255, 255, 0}), (Floats{1, 0.5f, 0, 0, 0, 0}));
    const Floats four(12, 2.0f);
    EXPECT_EQ(rgb("-Y 1 +X 4", {128, 128, 128, 130, 1, 1, 1, 3}), four);
    const Floats rows = rgb("-Y 2 +X 8", {2, 2, 0, 8,       128 + 8, 128,     8, 1,       2,       3,       4,
                                          5, 6, 7, 8,       128 + 7, 64,      1, 32,      128 + 8, 136,     2,
                                          2, 0, 8, 128 + 8, 0,       128 + 8, 0, 128 + 8, 0,       128 + 8, 136});
    ASSERT_EQ(rows.size(), 48u);
    for (std::size_t x = 0; x < 8; ++x) {
        EXPECT_EQ(rows[3 * x], 128);
        EXPECT_EQ(rows[3 * x + 1], static_cast<float>(x + 1));
        EXPECT_EQ(rows[3 * x + 2], x < 7 ? 64 : 32);
        EXPECT_EQ(rows[24 + 3 * x], 0);
    }
}

TEST_F(FilmFile, InvalidRadianceIsRefusedWithAReason) {
    const auto expectReason = [&](const char* reason, const char* size, const std::vector<int>& data) {
        expectBadInput(write("a.hdr", radiancePicture(size, data)), reason, [&] { readFloatImage(path("a.hdr")); });
    };
    expectReason("-Y +X", "+Y 1 +X 1", {128, 128, 128, 129});
    expectReason("16384", "-Y 16385 +X 1", {});
    expectReason("16384", "-Y 1 +X 0", {});
    expectReason("unexpected end", "-Y 2 +X 1", {128, 128, 128, 129});
    expectReason("unexpected end", "-Y 1 +X 8", {2, 2, 0, 8, 128 + 8, 1, 3, 1});
    expectReason("run *long", "-Y 1 +X 8", {2, 2, 0, 8, 128 + 9, 1});
    expectReason("run *long", "-Y 1 +X 8", {2, 2, 0, 8, 0, 0, 0});
    expectReason("width", "-Y 1 +X 8", {2, 2, 0, 9});
    expectReason("invalid run", "-Y 1 +X 4", {1, 1, 1, 4});
    expectReason("run *long", "-Y 1 +X 4", {3, 3, 3, 3, 1, 1, 1, 4});
}

/// Rows of one colour in the old encoding: a pixel and two runs, 12 bytes for any width.
Bytes denseRadiance(int width, int height) {
    Bytes bytes = radiancePicture("-Y " + std::to_string(height) + " +X " + std::to_string(width), {});
    const int runs = (width - 1) / 256, rest = (width - 1) % 256;
    const int row[] = {128, 128, 128, 129, 1, 1, 1, rest, 1, 1, 1, runs};
    for (int y = 0; y < height; ++y) bytes.insert(bytes.end(), std::begin(row), std::end(row));
    return bytes;
}

TEST_F(FilmFile, PictureSizesAreLimitedByFileSizes) {
    // 256 MiB are 22,369,621 pixels of 12 bytes; 12 bytes per row, and the header, allow some hundred thousand more
    const FloatImage image = readFloatImage(write("a.hdr", denseRadiance(16384, 1366)));
    EXPECT_EQ(image.width * image.height, 16384u * 1366u);
    EXPECT_EQ(image.rgb.back(), 1.0f);
    expectBadInput(write("b.hdr", denseRadiance(16384, 1600)), "16384 x 1600 pixels from 19",
                   [&] { readFloatImage(path("b.hdr")); });
    const std::vector<float> black(std::size_t{8192} * 4096);
    const ExrChannel channels[] = {{"R", black.data()}, {"G", black.data()}, {"B", black.data()}};
    writeExr(path("c.exr"), {8192, 4096}, channels);
    expectBadInput(path("c.exr"), "8192 x 4096 pixels from ", [&] { readFloatImage(path("c.exr")); });
}

TEST_F(FilmFile, PipesAndDevicesAreRefused) {
    ASSERT_EQ(mkfifo(path("pipe.hdr").c_str(), 0600), 0);
    expectBadInput(path("pipe.hdr"), "not *regular", [&] { readFloatImage(path("pipe.hdr")); });
    expectBadInput(path("pipe.hdr"), "not *regular", [&] { readSavedFilm(path("pipe.hdr")); });
    expectBadInput("/dev/zero", "not *regular", [&] { readFloatImage("/dev/zero"); });
    expectBadInput(folder.path.string(), "directory", [&] { readFloatImage(folder.path.string()); });
}

/// Reads damaged copies of a file as pictures and as films. Any exception but Error ends the test.
void tortureReaders(const std::string& path, const Bytes& whole, int copies, Noise noise) {
    for (int i = 0; i < copies; ++i) {
        Bytes bytes = whole;
        if (i % 5 == 0) bytes.resize(noise.next() % bytes.size());
        // half of the damage is among the sizes and offsets
        const std::size_t range = i % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
        for (std::uint32_t edit = noise.next() % 4; range > 0 && edit < 4; ++edit)
            bytes[noise.next() % range] = static_cast<char>(noise.next());
        fs::remove(path);
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        for (const std::function<void()>& read : {std::function<void()>([&] { readFloatImage(path); }),
                                                  std::function<void()>([&] { readSavedFilm(path); })})
            try {
                read();
            } catch (const Error& error) {
                ASSERT_EQ(error.code, ExitCode::kBadInput);
            }
    }
}

TEST_F(FilmFile, DamagedFilesAreReadOrRefused) {
    writeSavedFilm(path("film.exr"), noisyFilm(19, 20));
    tortureReaders(path("a.exr"), read("film.exr"), 300, {1});
    for (int coding : kCodings)
        tortureReaders(path("a.exr"), halfPicture(coding, 40, 70, steps(2800)), 100,
                       {static_cast<std::uint64_t>(coding)});
    std::vector<int> rows;
    for (int y = 0; y < 8; ++y) {
        rows.insert(rows.end(), {2, 2, 0, 8});
        for (int component = 0; component < 4; ++component) rows.insert(rows.end(), {4, 9, 8, 7, 6, 128 + 4, 130});
    }
    tortureReaders(path("a.hdr"), radiancePicture("-Y 8 +X 8", rows), 400, {2});
}

TEST_F(FilmFile, TruncatedFilesAreRefused) {
    SavedFilm saved = noisyFilm(3, 18);
    writeSavedFilm(path("film.exr"), saved);
    Bytes bytes = read("film.exr");
    while (!bytes.empty()) {
        bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), 41));
        EXPECT_THROW(readSavedFilm(write("a.exr", bytes)), Error) << bytes.size();
    }
}

/// Overwrites the 4 bytes that are `after` bytes behind a name with value.
Bytes patched(Bytes bytes, const std::string& name, std::size_t after, std::int32_t value) {
    const auto found = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    EXPECT_NE(found, bytes.end()) << name;
    const auto at = static_cast<std::size_t>(found - bytes.begin()) + name.size() + after;
    std::memcpy(&bytes.at(at), &value, sizeof value);
    return bytes;
}

TEST_F(FilmFile, ImpossibleHeadersAreRefused) {
    writeSavedFilm(path("film.exr"), noisyFilm(3, 18));
    const Bytes whole = read("film.exr");
    const auto expectReason = [&](const char* reason, const Bytes& bytes) {
        expectBadInput(write("a.exr", bytes), reason, [&] { readSavedFilm(path("a.exr")); });
    };
    // What lies between an attribute's name and its value: the final zero, the name of the type and the size of the
    // value.
    const std::size_t box = 1 + 6 + 4, list = 1 + 7 + 4, byte = 1 + 12 + 4;
    const std::int32_t five_and_dat = 0x74616405; // changes the byte to 5; the next bytes stay "dat", of "dataWindow"
    expectReason("16384 pixels", patched(whole, "dataWindow", box + 8, 16384));
    expectReason("data window", patched(whole, "dataWindow", box + 8, -1));
    expectReason("data window", patched(whole, "dataWindow", box + 8, 2147483647));
    expectReason("impossible size", patched(whole, "dataWindow", box + 8, 16383));
    expectReason("unexpected end", patched(whole, "dataWindow", box + 12, 16383));
    expectReason("unexpected lines", patched(whole, "dataWindow", box + 4, 1));
    expectReason("pixel type", patched(whole, "channels", list + 2, 3));
    expectReason("subsampled", patched(whole, "channels", list + 2 + 8, 2));
    expectReason("compression", patched(whole, "compression", byte, five_and_dat));
    expectReason("tiled", patched(whole, std::string("\x76\x2f\x31\x01"), 0, 0x202));
    expectReason("unexpected end", patched(whole, "chlist", 1, 2147483647));
}

} // namespace
} // namespace pointrt
