// SPDX-License-Identifier: Apache-2.0
// Pictures of scenes are bit-identical whether buffers have one page or several.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "tests/format/scene_builder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"
#include "tests/support/whole_frame.h"

namespace pointrt {
namespace {

/// Indices in PageCounts::counts.
enum Paged : std::uint32_t { kBricks, kCells, kSlabs, kNear, kListed, kBlending, kSplats };

pro_splat disc(Vec3 at, Vec3 normal, double radius, std::uint32_t number) {
    pro_splat splat{};
    splat.position[0] = static_cast<float>(at.x), splat.position[1] = static_cast<float>(at.y),
    splat.position[2] = static_cast<float>(at.z);
    splat.normal[0] = static_cast<float>(normal.x), splat.normal[1] = static_cast<float>(normal.y),
    splat.normal[2] = static_cast<float>(normal.z);
    splat.radius = static_cast<float>(radius);
    for (std::uint32_t channel = 0; channel < 3; ++channel)
        splat.color[channel] =
            static_cast<std::uint8_t>(number * 2654435761u >> (8 * channel + 8)); // arbitrary colours
    return splat;
}

/// A sphere of overlapping, evenly spaced discs: golden-ratio spirals.
std::vector<pro_splat> sphere(std::uint32_t count, Vec3 middle, double radius) {
    std::vector<pro_splat> splats;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count, around = 2.399963 * i, r = std::sqrt(1 - z * z);
        const Vec3 out{r * std::cos(around), r * std::sin(around), z};
        splats.push_back(disc(middle + out * radius, out, 3.2 * radius / std::sqrt(count), i));
    }
    return splats;
}

/// Discs of all sizes and directions, with a dense ball on one of them, where cells are subdivided.
std::vector<pro_splat> disorder() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> gauss;
    std::vector<pro_splat> splats = sphere(6000, {0.3, 0.35, 0.4}, 0.004);
    for (std::uint32_t i = 0; i < 300; ++i) {
        const Vec3 at{0.1 + 0.8 * unit(random), 0.1 + 0.8 * unit(random), 0.1 + 0.8 * unit(random)};
        splats.push_back(disc(at, normalize({gauss(random), gauss(random), gauss(random)}), 0.05 * unit(random), i));
    }
    return splats;
}

struct PagedPicture {
    Film film;
    std::vector<PageCounts> pages; ///< of each file
    bool uneven = false;           ///< of the first file
};

/// Owns a device with a scene.
struct OpenScene {
    OpenScene(const DeviceRequest& request, const SceneDescription& description)
        : validated(request), scene(openScene(device, description, false)) {}
    OpenScene(const OpenScene&) = delete;
    OpenScene& operator=(const OpenScene&) = delete;
    ~OpenScene() { destroyDeviceScene(device, scene); }

    ValidatedDevice validated;
    Device& device = validated.device;
    DeviceScene scene;
};

class PagesTest : public testing::Test {
protected:
    void SetUp() override {
        test::TreeOptions options;
        options.members_max = 64;
        test::sceneOf(sphere(20000, {0.5, 0.5, 0.5}, 0.4), options).write(even_);
        options.members_max = 8;
        options.radius_step = 0.0625f; // 16 octaves
        options.max_depth = 16;
        test::sceneOf(disorder(), options).write(uneven_);
    }

    /// From the front, with an area and a point light, and a mirror floor for secondary rays.
    static SceneDescription around(std::vector<std::string> paths) {
        SceneDescription scene;
        for (std::string& path : paths) {
            scene.instances.push_back({std::move(path), {}, {}, {}});
            scene.instances.back().placement.translation.x = static_cast<double>(scene.instances.size()) - 1;
        }
        scene.materials.resize(1);
        scene.materials[0].kind = MaterialKind::kMirror;
        scene.shapes.push_back({ShapeKind::kDisc, {0.5, 0.05, 0.5}, {3, 0, 0}, {0, 0, -3}, {0, 1, 0}});
        scene.lights.push_back(SphereLight{{2, 3, 2}, 0.3, {30, 30, 30}});
        return scene;
    }

    static PagedPicture render(const SceneDescription& description, Integrator integrator, std::uint32_t page_bits) {
        DeviceRequest request;
        request.page_bits_most = page_bits;
        OpenScene open(request, description);
        RenderSettings settings;
        settings.width = settings.height = 96;
        settings.spp = 2;
        settings.integrator = integrator;
        settings.first_hits = true;
        uploadSceneTables(open.device, open.scene, settings);
        const Bounds& bounds = open.scene.bounds;
        const Camera camera = frameCamera({}, bounds.lo, bounds.hi, 1);
        PagedPicture picture{
            test::wholeFrame(open.device, open.scene, settings, camera), {}, open.scene.files[0].index.uneven != 0};
        for (const DeviceScan& file : open.scene.files) picture.pages.push_back(file.pages);
        return picture;
    }

    static void expectSame(const Film& a, const Film& b) {
        const auto hits = std::count_if(b.depth.begin(), b.depth.end(), [](float t) { return std::isfinite(t); });
        EXPECT_GT(static_cast<std::size_t>(hits), b.depth.size() / 10);
        EXPECT_EQ(a.rgba, b.rgba);
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.albedo, b.albedo);
        EXPECT_EQ(a.splat_id, b.splat_id);
    }

    static void expectSeveral(const PageCounts& pages, std::initializer_list<Paged> buffers) {
        for (const Paged buffer : buffers) EXPECT_GT(pages.counts[buffer], 1u) << buffer;
    }

    test::TemporaryFolder folder_;
    std::string even_ = folder_.file("even.pro"), uneven_ = folder_.file("uneven.pro");

private:
};

TEST_F(PagesTest, HoldAllBytes_ImportedOrCopied) {
    DeviceRequest request;
    request.page_bits_most = 10;
    OpenScene open(request, around({}));
    Words words(4 * 3072 + 20); // of texels of 4 words: three pages and five texels
    std::iota(words.begin(), words.end(), 1u);
    for (const bool unified : {true, false}) {
        open.device.unified_memory = open.device.unified_memory && unified;
        PagedBuffer buffer = createPagedBuffer(open.device, "words", words.data(), words.size() * sizeof words[0],
                                               VK_FORMAT_R32G32B32A32_UINT);
        ASSERT_EQ(buffer.pages.size(), 4u);
        Words read(words.size());
        for (std::size_t page = 0; page < 4; ++page)
            downloadBuffer(open.device, buffer.pages[page], &read[4096 * page], page < 3 ? 16384 : 80);
        EXPECT_EQ(read, words);
        EXPECT_TRUE(unified || !isImported(buffer));
        destroyPagedBuffer(open.device, buffer);
    }
}

TEST_F(PagesTest, OfAnEvenScanShowIt) {
    const SceneDescription scene = around({even_});
    const PagedPicture whole = render(scene, Integrator::kPath, 31), paged = render(scene, Integrator::kPath, 13);
    EXPECT_FALSE(isPaged(whole.pages[0]));
    EXPECT_FALSE(paged.uneven);
    expectSeveral(paged.pages[0], {kBricks, kNear, kListed, kBlending, kSplats});
    expectSame(paged.film, whole.film);
}

TEST_F(PagesTest, OfAnUnevenScanShowIt) {
    const SceneDescription scene = around({uneven_});
    const PagedPicture whole = render(scene, Integrator::kWhitted, 31), paged = render(scene, Integrator::kWhitted, 13);
    EXPECT_TRUE(paged.uneven);
    expectSeveral(paged.pages[0], {kBricks, kCells, kSlabs, kNear, kListed});
    expectSame(paged.film, whole.film);
}

TEST_F(PagesTest, OfEachInstanceAreItsOwn) {
    const SceneDescription scene = around({even_, uneven_});
    const PagedPicture whole = render(scene, Integrator::kPhong, 31), paged = render(scene, Integrator::kPhong, 15);
    EXPECT_TRUE(isPaged(paged.pages[0]));
    EXPECT_NE(paged.pages[0], paged.pages[1]);
    expectSame(paged.film, whole.film);
}

TEST_F(PagesTest, TooMany_AreRefused) {
    try {
        render(around({even_}), Integrator::kPhong, 10);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        const std::string line = error.what();
        EXPECT_NE(line.find("texel buffers"), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
}

} // namespace
} // namespace pointrt
