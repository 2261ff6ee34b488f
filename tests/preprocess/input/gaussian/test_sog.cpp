// SPDX-License-Identifier: Apache-2.0
// SOG: a meta.json with WebP images, in a folder or a zip archive, and several of them in levels of detail.
#include "tests/preprocess/input/input_fixture.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <webp/encode.h>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/input/folders.h"

namespace pointrt {
namespace {

/// Names of files with their bytes.
using Files = std::map<std::string, std::string>;

using Pixel = std::array<int, 4>;

std::string webpOf(int width, int height, const std::string& rgba, bool lossless = true) {
    WebPConfig config;
    WebPConfigInit(&config);
    config.lossless = lossless;
    config.exact = 1; // keeps colours where alpha is 0
    WebPPicture picture;
    WebPPictureInit(&picture);
    picture.use_argb = 1;
    picture.width = width;
    picture.height = height;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    WebPPictureImportRGBA(&picture, reinterpret_cast<const std::uint8_t*>(rgba.data()), 4 * width);
    EXPECT_TRUE(WebPEncode(&config, &picture));
    std::string bytes(reinterpret_cast<const char*>(writer.mem), writer.size);
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
    return bytes;
}

std::string rgbaOf(const std::vector<Pixel>& pixels) {
    std::string bytes;
    for (const Pixel& pixel : pixels)
        for (const int part : pixel) bytes += static_cast<char>(part);
    return bytes;
}

/// An image of one row.
std::string rowOf(const std::vector<Pixel>& pixels) {
    return webpOf(static_cast<int>(pixels.size()), 1, rgbaOf(pixels));
}

/// The images of two Gaussians. The first has a mean of 0 0 0 in a range from -1 to 1 of logarithms, rounded.
Files images() {
    return {{"means_l.webp", rowOf({{0xff, 0xff, 0xff, 255}, {0xff, 0, 0x34, 255}})},
            {"means_u.webp", rowOf({{0x7f, 0x7f, 0x7f, 255}, {0xff, 0, 0x12, 255}})},
            {"quats.webp", rowOf({{0, 128, 128, 252}, {128, 128, 255, 255}})},
            {"scales.webp", rowOf({{10, 20, 30, 255}, {0, 255, 1, 255}})},
            {"sh0.webp", rowOf({{0, 128, 255, 0}, {1, 2, 3, 255}})}};
}

/// 256 values from first on.
std::string codebook(double first, double step) {
    std::string text = "\"codebook\":[";
    for (int i = 0; i < 256; ++i) text += fmt::format("{}{}", i == 0 ? "" : ",", first + step * i);
    return text + "]";
}

/// A meta.json of version 2. more: further members
std::string metaOf(std::uint64_t count, const std::string& more = "") {
    return fmt::format(R"({{"version":2,"asset":{{"generator":"test"}},"count":{},)"
                       R"("means":{{"mins":[-1,-2,0],"maxs":[1,2,4],"files":["means_l.webp","means_u.webp"]}},)"
                       R"("scales":{{{},"files":["scales.webp"]}},"quats":{{"files":["quats.webp"]}},)"
                       R"("sh0":{{{},"files":["sh0.webp"]}}{}}})",
                       count, codebook(-5, 0.01), codebook(-2, 0.015), more);
}

Files sog(const std::string& more = "") {
    Files files = images();
    files["meta.json"] = metaOf(2, more);
    return files;
}

/// Harmonics of degree 1: two sets. One Gaussian uses the second, the other one a set that does not exist.
Files withHarmonics(std::uint64_t count = 2) {
    Files files = sog(fmt::format(R"(,"shN":{{"count":{},"bands":1,{},"files":["c.webp","l.webp"]}})", count,
                                  codebook(-1, 0.0078125)));
    std::vector<Pixel> centroids(192, {0, 0, 0, 255});
    centroids[3] = {128, 0, 255, 255};
    centroids[4] = {64, 65, 66, 255};
    centroids[5] = {1, 2, 3, 255};
    files["c.webp"] = rowOf(centroids);
    files["l.webp"] = rowOf({{1, 0, 0, 255}, {2, 1, 0, 255}});
    return files;
}

std::string versionOne() {
    return R"({"means":{"shape":[2,3],"mins":[-1,-2,0],"maxs":[1,2,4],"files":["means_l.webp","means_u.webp"]},)"
           R"("scales":{"mins":[-5,-6,-7],"maxs":[0,1,2],"files":["scales.webp"]},"quats":{"files":["quats.webp"]},)"
           R"("sh0":{"mins":[-2,-2,-2,-4],"maxs":[2,3,4,4],"files":["sh0.webp"]},)"
           R"("shN":{"mins":-1,"maxs":1,"files":["c.webp","l.webp"]}})";
}

struct ZipOptions {
    bool deflated = false;
    std::string folder = {};
    int flags = 0;
};

std::string deflatedRaw(const std::string& bytes) {
    const std::string packed = gzipped(bytes);
    return packed.substr(10, packed.size() - 18); // without the header and the trailer
}

std::string zipOf(const Files& files, const ZipOptions& options = {}) {
    std::string text, directory;
    for (const auto& [name, bytes] : files) {
        const std::string path = options.folder + name, data = options.deflated ? deflatedRaw(bytes) : bytes;
        const auto word = [](std::size_t number) { return bytesOf(static_cast<std::uint32_t>(number)); };
        const auto brief = [](std::size_t number) { return bytesOf(static_cast<std::uint16_t>(number)); };
        const std::string common = brief(static_cast<std::size_t>(options.flags)) + brief(options.deflated ? 8 : 0) +
                                   std::string(8, '\0') + word(data.size()) + word(bytes.size()) + brief(path.size()) +
                                   brief(0);
        directory += "PK\1\2" + brief(20) + brief(20) + common + std::string(10, '\0') + word(text.size()) + path;
        text += "PK\3\4" + brief(20) + common + path + data;
    }
    const auto count = bytesOf(static_cast<std::uint16_t>(files.size()));
    return text + directory + "PK\5\6" + std::string(4, '\0') + count + count +
           bytesOf(static_cast<std::uint32_t>(directory.size())) + bytesOf(static_cast<std::uint32_t>(text.size())) +
           std::string(2, '\0');
}

class SogTest : public InputTest {
protected:
    /// Writes the files and returns the path of the meta.json.
    std::string writeAll(const Files& files, const std::string& below = "") const {
        if (!below.empty()) std::filesystem::create_directories(folder / below);
        for (const auto& [name, bytes] : files) write(below + name, bytes);
        return (folder / below / "meta.json").string();
    }
    std::string reasonOfFiles(const Files& files) const { return reasonOf(writeAll(files)); }
    std::string reasonOfMeta(const std::string& meta) const {
        Files files = withHarmonics();
        files["meta.json"] = meta;
        return reasonOfFiles(files);
    }
};

GaussianColumns columnsOfSog(const Cloud& cloud) {
    const auto columns = gaussianColumns(cloud);
    if (!columns) throw std::runtime_error("the cloud has no Gaussians");
    return *columns;
}

Vec3d sogThree(const float* values, std::size_t i) {
    return {double(values[3 * i]), double(values[3 * i + 1]), double(values[3 * i + 2])};
}

/// The two Gaussians of images() in version 2.
void expectImages(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 2u);
    const GaussianColumns columns = columnsOfSog(cloud);
    // 0x7fff of 0xffff from -1 to 1
    EXPECT_NEAR(world(cloud, 0).x(), -1 / 65535.0, 1e-9);
    EXPECT_NEAR(world(cloud, 0).z(), std::exp(4 * 32767 / 65535.0) - 1, 1e-6);
    EXPECT_NEAR(world(cloud, 1).x(), std::exp(1) - 1, 1e-6);
    EXPECT_NEAR(world(cloud, 1).y(), 1 - std::exp(2), 1e-6);
    EXPECT_NEAR(world(cloud, 1).z(), std::exp(4.0 * 0x1234 / 65535) - 1, 1e-6);
    EXPECT_NEAR(sogThree(columns.deviation, 0).y(), std::exp(-5 + 0.2), 1e-6);
    EXPECT_NEAR(sogThree(columns.deviation, 1).y(), std::exp(-5 + 2.55), 1e-6);
    EXPECT_EQ(columns.opacity[0], 0);
    EXPECT_EQ(columns.opacity[1], 1);
    EXPECT_NEAR(sogThree(columns.color, 0).z(), 0.5 + 0.28209479177387814 * (-2 + 255 * 0.015), 1e-6);
    // the largest part is w, x is -sqrt(1/2); then the largest is z, y is +sqrt(1/2)
    const float* const turn = columns.rotation;
    EXPECT_NEAR(turn[1], -std::sqrt(0.5), 0.01);
    EXPECT_NEAR(turn[0], std::sqrt(0.5), 0.01);
    EXPECT_NEAR(turn[4 + 2], std::sqrt(0.5), 0.01);
    EXPECT_NEAR(turn[4 + 3], std::sqrt(0.5), 0.01);
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
}

TEST_F(SogTest, EveryFieldIsRead) {
    const Cloud cloud = read(writeAll(sog()));
    expectImages(cloud);
    EXPECT_EQ(columnsOfSog(cloud).degree, 0);
    EXPECT_HAS(notesOf(cloud), "2 Gaussians *degree 0");
}

TEST_F(SogTest, HarmonicsComeFromAPalette) {
    const Cloud cloud = read(writeAll(withHarmonics()));
    expectImages(cloud);
    const GaussianColumns columns = columnsOfSog(cloud);
    ASSERT_EQ(columns.degree, 1);
    EXPECT_EQ(sogThree(columns.harmonics[0], 0), Vec3d(0, -1, -1 + 255 / 128.0));
    EXPECT_EQ(sogThree(columns.harmonics[1], 0), Vec3d(-0.5, -1 + 65 / 128.0, -1 + 66 / 128.0));
    EXPECT_EQ(sogThree(columns.harmonics[0], 1), Vec3d(0, 0, 0)); // label 258 of 2
}

TEST_F(SogTest, VersionOneHasRanges) {
    Files files = withHarmonics();
    files["meta.json"] = versionOne();
    const Cloud cloud = read(writeAll(files));
    const GaussianColumns columns = columnsOfSog(cloud);
    EXPECT_NEAR(world(cloud, 1).x(), std::exp(1) - 1, 1e-6);
    EXPECT_NEAR(sogThree(columns.deviation, 0).z(), std::exp(-7 + 9 * 30 / 255.0), 1e-6);
    EXPECT_NEAR(columns.opacity[0], 1 / (1 + std::exp(4)), 1e-6);
    EXPECT_NEAR(sogThree(columns.color, 0).z(), 0.5 + 0.28209479177387814 * 4, 1e-6);
    ASSERT_EQ(columns.degree, 1);
    EXPECT_NEAR(sogThree(columns.harmonics[0], 0).z(), 1, 1e-6);
}

TEST_F(SogTest, FirstValueOfACodebookMayBeNull) {
    Files files = sog();
    std::string& meta = files["meta.json"];
    meta.replace(meta.find("\"codebook\":[-5,") + 12, 2, "null");
    const Cloud cloud = read(writeAll(files));
    // before the second value by a 255th of the distance to the last
    EXPECT_NEAR(sogThree(columnsOfSog(cloud).deviation, 1).x(), std::exp(-4.99 - 0.01 * 254 / 255), 1e-6);
}

TEST_F(SogTest, ArchivesAndFoldersAreRead) {
    for (const ZipOptions& options : {ZipOptions{}, ZipOptions{.deflated = true}, ZipOptions{.folder = "bot/"}}) {
        expectImages(readText("a.sog", zipOf(sog(), options)));
        expectImages(readText("b.zip", zipOf(sog(), options)));
    }
    writeAll(sog(), "bot/");
    EXPECT_EQ(filesOf({(folder / "bot").string()}), Names{(folder / "bot" / "meta.json").string()});
}

TEST_F(SogTest, DiscsAreMadeOfThem) {
    ReadOptions options;
    options.gaussians_as_discs = true;
    const Cloud cloud = read(writeAll(withHarmonics()), options);
    EXPECT_EQ(cloud.positions.size(), 1u); // the other has opacity 0
    EXPECT_HAS(notesOf(cloud), "view-dependent");
}

/// Two files of level 0, one of level 1, and surroundings; each has two Gaussians.
Files levels(const std::string& tree, const std::string& environment = "") {
    Files files;
    files["lod-meta.json"] =
        fmt::format(R"({{"lodLevels":2,"filenames":["0_0/meta.json","0_1/meta.json","1_0/meta.json"],{}"tree":{}}})",
                    environment.empty() ? "" : "\"environment\":\"" + environment + "\",", tree);
    for (const char* name : {"0_0/", "0_1/", "1_0/", "env/"})
        for (const auto& [file, bytes] : sog()) files[name + file] = bytes;
    return files;
}

constexpr const char* kSogTree =
    R"({"bound":{},"children":[)"
    R"({"lods":{"0":{"file":0,"offset":1,"count":1},"1":{"file":2,"offset":0,"count":1}}},)"
    R"({"lods":{"0":{"file":1,"offset":0,"count":2},"1":{"file":2,"offset":1,"count":1}}}]})";

TEST_F(SogTest, FinestLevelIsRead) {
    for (const char* name : {"0_0", "0_1", "1_0", "env"}) std::filesystem::create_directories(folder / name);
    const Files files = levels(kSogTree);
    writeAll(files);
    const Cloud cloud = read((folder / "lod-meta.json").string());
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_NEAR(world(cloud, 0).x(), std::exp(1) - 1, 1e-6);
    EXPECT_NEAR(world(cloud, 1).x(), 0, 1e-4);
    EXPECT_HAS(notesOf(cloud), "2 levels *finest");
    EXPECT_EQ(filesOf({folder.string()}), Names{(folder / "lod-meta.json").string()});
    EXPECT_EQ(readText("a.sog", zipOf(files)).positions.size(), 3u);

    ReadOptions coarse;
    coarse.level = 0;
    EXPECT_EQ(read((folder / "lod-meta.json").string(), coarse).positions.size(), 2u);
    writeAll(levels(kSogTree, "env/meta.json"));
    EXPECT_EQ(read((folder / "lod-meta.json").string()).positions.size(), 5u);
}

TEST_F(SogTest, InvalidLevelsAreRefused) {
    const auto reason = [&](const std::string& tree, const std::string& environment = "") {
        return reasonOfText("a.sog", zipOf(levels(tree, environment)));
    };
    const auto leaf = [](const std::string& reference) { return R"({"lods":{"0":)" + reference + "}}"; };
    EXPECT_HAS(reason(leaf(R"({"file":3,"offset":0,"count":1})")), "file: *0 to 2");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":1,"count":2})")), "2 Gaussians from 1 on*'0_0/meta.json' *2");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":-1,"count":2})")), "offset: ");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":0,"count":99999999999})")), "count: ");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":0,"count":0})")), "no points");
    EXPECT_HAS(reason(R"({"children":[)" + leaf(R"({"file":0,"offset":0,"count":2})") + "," +
                      leaf(R"({"file":0,"offset":1,"count":1})") + "]}"),
               "overlap *'0_0/meta.json'");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":0,"count":2})"), "0_0/meta.json"), "'0_0/meta.json' twice");
    EXPECT_HAS(reason(leaf(R"({"file":0,"offset":0,"count":2})"), "../x/meta.json"), "'../x/meta.json'");
    EXPECT_HAS(reason(R"({"lods":{"x":{}}})"), "'x' *level");
    EXPECT_HAS(reason("{}"), "no points");
    std::string deep(200000, '[');
    EXPECT_HAS(reason(deep), "JSON");
}

TEST_F(SogTest, CountsThatImagesCannotHoldAreRefused) {
    const Files files = withHarmonics();
    EXPECT_HAS(reasonOfMeta(metaOf(3)), "2 x 1 pixels, *3 Gaussians");
    EXPECT_HAS(reasonOfMeta(metaOf(10'000'000)), "2 x 1 pixels, *10000000 Gaussians");
    EXPECT_HAS(reasonOfMeta(metaOf(0)), "no points");
    EXPECT_HAS(reasonOfMeta(metaOf(UINT64_MAX)), "pixels");
    EXPECT_HAS(reasonOfMeta(metaOf(2).replace(metaOf(2).find("\"count\":2"), 9, "\"count\":-2")), "count: ");
}

TEST_F(SogTest, ImagesOfOneColourDemandLittleMemory) {
    // 10 million pixels in a few hundred bytes
    const std::string large = webpOf(4000, 2500, std::string(4 * 4000 * 2500, '\xff'));
    EXPECT_LT(large.size(), 10'000u);
    Files files = sog();
    for (auto& [name, bytes] : files)
        if (name != "meta.json") bytes = large;
    EXPECT_HAS(reasonOfFiles(files), "4000 x 2500 pixels, too many *2 ");
    files["meta.json"] = metaOf(10'000'000);
    EXPECT_HAS(reasonOfFiles(files), "promises 10000000 Gaussians in ");
    EXPECT_HAS(reasonOfText("a.sog", zipOf(files)), "promises 10000000 Gaussians in ");
}

TEST_F(SogTest, InvalidImagesAreRefused) {
    for (const auto& [name, bytes] : images()) {
        Files files = sog();
        files[name] = bytes.substr(0, bytes.size() - 4);
        EXPECT_HAS(reasonOfFiles(files), name + ": *truncated");
        files[name] = bytes.substr(0, 20);
        EXPECT_HAS(reasonOfFiles(files), name + ": *WebP");
        files[name] = "not a picture";
        EXPECT_HAS(reasonOfFiles(files), name + ": *WebP");
        std::filesystem::remove(folder / name);
        EXPECT_HAS(reasonOf((folder / "meta.json").string()), name + ": no such file");
        files = sog();
        files[name] = webpOf(2, 1, rgbaOf({{9, 9, 9, 255}, {200, 0, 9, 255}}), false);
        EXPECT_HAS(reasonOfFiles(files), name + ": *lossless");
    }
    Files files = withHarmonics();
    files["c.webp"] = rowOf(std::vector<Pixel>(191));
    EXPECT_HAS(reasonOfFiles(files), "191 pixels wide; *192, 512");
    files["c.webp"] = rowOf(std::vector<Pixel>(512)); // of degree 2
    EXPECT_HAS(reasonOfFiles(files), "512 pixels wide");
    files = withHarmonics();
    files["l.webp"] = rowOf({{0, 0, 0, 255}});
    EXPECT_HAS(reasonOfFiles(files), "l.webp: *1 x 1 pixels");
}

TEST_F(SogTest, InvalidMetaIsRefused) {
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string meta = withHarmonics()["meta.json"];
        return reasonOfMeta(meta.replace(meta.find(from), from.size(), to));
    };
    EXPECT_HAS(with("\"version\":2", "\"version\":3"), "version 3*1 to 2");
    EXPECT_HAS(with("\"version\":2", "\"version\":\"x\""), "meta.json:version: ");
    EXPECT_HAS(with("\"mins\":[-1,-2,0]", "\"mins\":[-1,-2]"), "meta.json:means.mins: *2 is out of range");
    EXPECT_HAS(with("\"mins\":[-1,-2,0]", "\"mins\":[-1,\"\",0]"), "meta.json:means.mins[1]: ");
    EXPECT_HAS(with("\"maxs\"", "\"max\""), "meta.json:means.maxs: *missing");
    EXPECT_HAS(with("-4.99,", ""), "meta.json:scales.codebook: *255 *256");
    EXPECT_HAS(with("\"bands\":1", "\"bands\":4"), "meta.json:shN.bands: ");
    EXPECT_HAS(with("[\"scales.webp\"]", "[\"../scales.webp\"]"), "'../scales.webp' lies outside");
    EXPECT_HAS(with("[\"scales.webp\"]", "[\"/etc/passwd\"]"), "'/etc/passwd' lies outside");
    EXPECT_HAS(with("[\"scales.webp\"]", "[\"./scales.webp\"]"), "'./scales.webp' *plain");
    EXPECT_HAS(with("[\"scales.webp\"]", "[7]"), "meta.json:scales.files[0]: ");
    const std::string meta = sog()["meta.json"];
    EXPECT_HAS(reasonOfMeta(meta.substr(0, meta.size() - 1)), "JSON");
}

TEST_F(SogTest, InvalidArchivesAreRefused) {
    const std::string good = zipOf(sog());
    EXPECT_HAS(reasonOfText("a.sog", good.substr(0, good.size() / 2)), "truncated");
    EXPECT_HAS(reasonOfText("a.sog", zipOf(images())), "zip archive: unpack");
    EXPECT_HAS(reasonOfText("a.sog", zipOf(sog(), {.flags = 1})), "'meta.json': *encrypted");
    Files files = sog();
    files.erase("quats.webp");
    EXPECT_HAS(reasonOfText("a.sog", zipOf(files)), "no 'quats.webp'");
    std::string packed = zipOf(sog(), {.deflated = true});
    packed[packed.find("meta.json") + 12] ^= 0x55;
    EXPECT_HAS(reasonOfText("a.sog", packed), "invalid");
}

TEST_F(SogTest, BombsInArchivesAreRefused) {
    Files files = sog();
    files["quats.webp"] = std::string(80 << 20, '\0'); // deflate shrinks it to 80 kB
    EXPECT_HAS(reasonOfText("a.sog", zipOf(files, {.deflated = true})), "'quats.webp': *100 times");
}

TEST_F(SogTest, PrefixesAreRefused) {
    const std::string text = zipOf(sog(), {.deflated = true});
    for (std::size_t size = 1; size < text.size(); size += 1 + size % 13) {
        reasonOfText("a.sog", text.substr(0, size));
        ASSERT_EQ(last_code, ExitCode::kBadInput) << size;
    }
}

} // namespace
} // namespace pointrt
