// SPDX-License-Identifier: Apache-2.0
// Painting of splats by attributes, without a device.
#include "runtime/device_scene/scene_paint.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "format/base/error.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/device_scene/number_samples.h"
#include "runtime/device_scene/splat_selection.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tiny_attributes.h"

namespace pointrt {
namespace {

/// The tiny scene with all attributes, opened as the viewer opens files.
class ScenePaintTest : public testing::Test {
protected:
    ScenePaintTest() {
        scan.path = folder.file("tiny.pro");
        test::Scene tiny = test::tinyScene();
        reopen([&] { EXPECT_EQ(test::TinyScan().write(tiny, scan.path), PRO_OK); });
        scene.instances.push_back({scan.path, {}, {}, {}});
    }
    ~ScenePaintTest() override { pro_close(scan.file); }

    template <typename Write>
    void reopen(const Write& write) {
        pro_close(scan.file);
        write();
        EXPECT_EQ(pro_open(scan.path.c_str(), PRO_OPEN_TRACE, &scan.file, nullptr), PRO_OK);
        pro_get_info(scan.file, &scan.info);
        pro_get_view(scan.file, &scan.view);
    }

    std::vector<PlacedScan> scans() const {
        std::vector<PlacedScan> placed;
        for (const InstanceDescription& instance : scene.instances) placed.push_back({&scan, &instance});
        return placed;
    }
    PaintPlan plan() const { return planPaint(scans(), paintRequest(scene, settings)); }

    std::vector<std::uint32_t> painted() const {
        std::vector<std::uint32_t> words(5 * PRO_SPLAT_WORDS);
        const SplatPaint paint = plan().paints.at(0).value();
        paintSplats(paint, scan.view.splats, 0, words);
        moveHiddenAway(shownSplats(paint.selections, 5), 0, words);
        return words;
    }
    std::vector<Srgb8> colors() const {
        std::vector<Srgb8> colors;
        const std::vector<std::uint32_t> words = painted();
        for (std::size_t i = 0; i < 5; ++i) {
            const std::uint32_t word = words[4 * i + 3];
            colors.push_back({static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                              static_cast<std::uint8_t>(word >> 16)});
        }
        return colors;
    }
    std::vector<int> rows() const {
        std::vector<int> rows;
        const std::vector<std::uint32_t> words = painted();
        for (std::size_t i = 0; i < 5; ++i) rows.push_back(static_cast<int>(words[4 * i + 2] >> PRO_MATERIAL_SHIFT));
        return rows;
    }
    /// Grey values of the splats.
    std::vector<int> greys() const {
        std::vector<int> greys;
        for (const Srgb8 color : colors()) {
            EXPECT_TRUE(color[0] == color[1] && color[1] == color[2]);
            greys.push_back(color[0]);
        }
        return greys;
    }
    void colorBy(const std::string& word, std::optional<ColorMap> map = {}, std::optional<ValueRange> range = {}) {
        settings.color_by = word;
        settings.color_map = map;
        settings.color_range = range;
    }
    void put(decltype(MaterialOverride::splats) splats, std::uint32_t material) {
        scene.instances[0].overrides.push_back({std::move(splats), material, "scene.toml:9: "});
    }
    std::string refusal(ExitCode code) const {
        try {
            plan();
        } catch (const Error& error) {
            EXPECT_EQ(error.code, code);
            return error.what();
        }
        return "";
    }

    const test::TemporaryFolder folder;
    DeviceScan scan;
    SceneDescription scene;
    RenderSettings settings;
};

using Ints = std::vector<int>;

TEST_F(ScenePaintTest, IsOff_ByDefault) {
    EXPECT_FALSE(plan().paints.at(0));
    EXPECT_FALSE(plan().legend);
    put(MaterialOverride::Row{0}, 0);
    put(MaterialOverride::ColorRange{{0, 0, 0}, {9, 9, 9}}, 0);
    EXPECT_FALSE(plan().paints.at(0)) << "shaders apply these";
}

TEST_F(ScenePaintTest, Attribute_ChangesColoursOnly) {
    colorBy("intensity", ColorMap::kGrey, ValueRange{0, 100});
    EXPECT_EQ(greys(), (Ints{0, 255, 17, 255, 30})); // 7 and 12 of 100 in 256 steps
    const std::vector<std::uint32_t> words = painted();
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::uint32_t kept = i % 4 == 3 ? ~PRO_COLOR_MASK : ~0u;
        EXPECT_EQ(words[i] & kept, scan.view.splats[i] & kept) << i;
    }
}

TEST_F(ScenePaintTest, Parts_ArePaintedAlike) {
    colorBy("classification");
    const std::vector<std::uint32_t> whole = painted();
    std::vector<std::uint32_t> part(2 * PRO_SPLAT_WORDS);
    paintSplats(plan().paints.at(0).value(), scan.view.splats, 3, part);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 3 * PRO_SPLAT_WORDS));
}

TEST_F(ScenePaintTest, Classes_HaveTheirColours) {
    colorBy("class");
    const ColorScale classes(ColorMap::kClasses, {});
    EXPECT_EQ(colors(), (std::vector{classes(2), classes(2), classes(6), classes(5), classes(2)}));
    const Legend legend = plan().legend.value();
    ASSERT_EQ(legend.entries.size(), 3u);
    EXPECT_EQ(legend.title, "classification");
    EXPECT_EQ(legend.entries[1].text, "5 high vegetation");
}

TEST_F(ScenePaintTest, MissingNumbers_AreGrey) {
    colorBy("gps_time", ColorMap::kMagma, ValueRange{0, 10});
    EXPECT_EQ(colors()[1], kMissingColor);
    EXPECT_NE(colors()[2], kMissingColor);
}

TEST_F(ScenePaintTest, Components_AreNumbered) {
    colorBy("rgb16.1", ColorMap::kGrey, ValueRange{2, 14});
    EXPECT_EQ(greys(), (Ints{0, 64, 128, 192, 255}));
    colorBy("größe in einer Einheit, 31 By", ColorMap::kGrey, ValueRange{0, 2});
    EXPECT_EQ(greys(), (Ints{0, 0, 128, 255, 0}));
}

TEST_F(ScenePaintTest, Heights_AreInTheWorld) {
    scene.up = {0, 0, 1};
    colorBy("height", ColorMap::kGrey, ValueRange{30, 32}); // z of the splats: 30 + 2 * 0.25, 0.1, 0.1, 0.45, 0.75
    EXPECT_EQ(greys(), (Ints{64, 25, 25, 115, 192}));
    EXPECT_EQ(plan().legend->title, "height (ft)");
    scene.instances[0].placement.translation = {0, 0, 1};
    EXPECT_EQ(greys(), (Ints{192, 153, 153, 243, 255}));
    scene.instances[0].placement.translation = {};
    scene.up = Vec3{1, 0, 0};
    settings.color_range = {{10, 12}};
    EXPECT_EQ(greys()[2], 204);                                                            // x = 10 + 2 * 0.8
    scene.instances[0].placement.rotation = {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}; // its z becomes x
    settings.color_range = {{30, 32}};
    EXPECT_EQ(greys(), (Ints{64, 25, 25, 115, 192}));
}

TEST_F(ScenePaintTest, AllTypes_AreSupported) {
    const std::array<std::uint64_t, 5> large{~0ull, ~0ull, ~0ull, ~0ull, ~0ull};
    const double largest = std::numeric_limits<double>::max();
    const std::array<double, 5> wild{largest, -largest, 5e-324, -largest, largest};
    const std::array<float, 5> none{NAN, INFINITY, -INFINITY, NAN, NAN};
    test::Scene tiny = test::tinyScene();
    test::TinyScan said;
    said.attributes.clear();
    said.add("class", PRO_TYPE_U64, 1, large.data());
    said.add("wild", PRO_TYPE_F64, 1, wild.data());
    said.add("none", PRO_TYPE_F32, 1, none.data());
    reopen([&] { EXPECT_EQ(said.write(tiny, scan.path), PRO_OK); });
    for (const char* word : {"class", "wild", "none"})
        for (const auto& [name, map] : kColorMapNames) {
            colorBy(word, map);
            EXPECT_EQ(colors().size(), 5u) << word << name;
            EXPECT_LE(plan().legend->ticks.size(), 13u) << word << name;
        }
    colorBy("class", ColorMap::kGrey);
    EXPECT_EQ(greys(), (Ints{128, 128, 128, 128, 128})) << "the attribute of that name, not the classes";
    EXPECT_EQ(plan().legend->ticks.size(), 1u);
}

TEST_F(ScenePaintTest, Normals_AreColours) {
    colorBy("normal");
    const std::vector<Srgb8> seen = colors();
    const Srgb8 expected[2] = {{128, 128, 255}, {128, 0, 128}}; // of splats 0 and 2: z and -y
    for (std::size_t i = 0; i < 2; ++i)                         // normals are quantised
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[2 * i][c], expected[i][c], 1) << i << " " << c;
    EXPECT_FALSE(plan().legend);
}

TEST_F(ScenePaintTest, Ranges_FitTheNumbers) {
    colorBy("classification", ColorMap::kGrey);
    EXPECT_EQ(plan().legend->range, (ValueRange{2, 6})) << "the full range of small integers";
    ASSERT_EQ(plan().legend->ticks.size(), 5u);
    EXPECT_EQ(plan().legend->ticks[1].text, "3");
    colorBy("intensity");
    EXPECT_EQ(plan().legend->range, (ValueRange{0, 300})) << "without the highest";
    EXPECT_EQ(plan().legend->bar.size(), 256u);
    settings.color_range = {{5, 6}};
    EXPECT_EQ(plan().legend->range, (ValueRange{5, 6}));
}

/// The colour map of distances has 0 in its middle.
TEST_F(ScenePaintTest, Distances_AreDiverging) {
    test::Scene tiny = test::tinyScene();
    const float distances[] = {-1, 0, 2.5f, 3, std::numeric_limits<float>::quiet_NaN()};
    reopen([&] {
        test::TinyScan content;
        content.add("distance", PRO_TYPE_F32, 1, distances);
        EXPECT_EQ(content.write(tiny, scan.path), PRO_OK);
    });
    settings.color_by = "distance";
    const PaintPlan painted_plan = plan();
    const Srgb8 middle = ColorScale(ColorMap::kCoolwarm, {-1, 1})(0);
    EXPECT_EQ(colors()[1], middle);
    EXPECT_GT(colors()[0][2], colors()[0][0]) << "blue below";
    EXPECT_GT(colors()[3][0], colors()[3][2]) << "red above";
    EXPECT_EQ(colors()[4], kMissingColor);
    settings.color_range = ValueRange{0, 3}; // as given
    EXPECT_EQ(colors()[0], colors()[1]) << "both at the lower end";
}

TEST_F(ScenePaintTest, Scans_MayKeepTheirColours) {
    settings.color_by = "intensity";
    const PaintRequest before = paintRequest(scene, settings);
    scene.instances.push_back(scene.instances.front());
    scene.instances.front().colored = false;
    const PaintPlan both = plan();
    EXPECT_FALSE(both.paints.at(0));
    EXPECT_TRUE(both.paints.at(1));
    EXPECT_TRUE(both.legend);
    scene.instances.pop_back();
    EXPECT_FALSE(paintRequest(scene, settings) == before) << "it must be painted anew";
    EXPECT_FALSE(plan().paints.at(0));
    EXPECT_FALSE(plan().legend);
}

TEST_F(ScenePaintTest, Overrides_ApplyInOrder) {
    using Numbers = SplatSelection;
    scene.materials.resize(4);
    put(Numbers{"class", {{2, 2}}}, 3); // these are splats 0, 1 and 4; file rows are 0 1 0 0 1
    EXPECT_EQ(rows(), (Ints{2, 2, 0, 0, 2}));
    put(Numbers{"intensity", {{7, 300}}}, 1); // these are 2, 3 and 4
    EXPECT_EQ(rows(), (Ints{2, 2, 3, 3, 3}));
    EXPECT_EQ(paintedMaterials(scene.instances[0], scan), (std::vector<std::uint32_t>{3, 1}));
    put(Numbers{"gps_time", {{-4.5, -4.5}, {3, 3}}}, 3); // these are 2 and 3; NaN matches nothing
    EXPECT_EQ(rows(), (Ints{2, 2, 2, 2, 3})) << "one row for each material";
    put(MaterialOverride::ColorRange{{0, 0, 250}, {10, 10, 255}}, 1); // this is splat 2, which is blue
    EXPECT_EQ(rows(), (Ints{2, 2, 3, 2, 3}));
    put(MaterialOverride::Row{1}, 0); // these are 1 and 4
    EXPECT_EQ(rows(), (Ints{2, 1, 3, 2, 1}));
}

TEST_F(ScenePaintTest, Filters_MoveAwayWhatTheyHide) {
    scene.filters = {{{"class", {{2, 2}}}, true, ""}}; // splats 0, 1 and 4
    const std::vector<std::uint32_t> words = painted();
    for (std::size_t i = 0; i < 5; ++i) {
        const bool shown = i == 0 || i == 1 || i == 4;
        EXPECT_EQ(words[PRO_SPLAT_WORDS * i] == scan.view.splats[PRO_SPLAT_WORDS * i], shown) << i;
        EXPECT_EQ(words[PRO_SPLAT_WORDS * i + 3], scan.view.splats[PRO_SPLAT_WORDS * i + 3]) << "its radius and colour";
    }
    scene.filters.push_back({{"gps_time", {{-1e9, 1e9}}}, true, ""}); // hides the splat whose time is NaN
    const SplatPaint both = plan().paints.at(0).value();
    EXPECT_EQ(both.selections.size(), 2u);
    scene.filters[0].enabled = scene.filters[1].enabled = false;
    EXPECT_EQ(paintRequest(scene, settings), PaintRequest{});
    EXPECT_FALSE(plan().paints.at(0).has_value());
}

TEST_F(ScenePaintTest, Filters_SelectSplats) {
    const auto shown = [&] { return shownSplats(plan().paints.at(0).value().selections, 5).at(0); };
    scene.filters = {{{"class", {{2, 2}}}, true, ""}};
    EXPECT_EQ(shown(), 0b10011u);
    scene.filters.push_back({{"intensity", {{7, 300}}}, true, ""}); // 2, 3 and 4
    EXPECT_EQ(shown(), 0b10000u);
    scene.filters = {{{"class", {{2, 2}, {6, 6}}}, true, ""}};
    EXPECT_EQ(shown(), 0b10111u) << "not splat 3, of class 5";
    scene.filters = {{{"klass", {{2, 2}}}, true, "scene.toml:4: "}};
    EXPECT_SAYS(refusal(ExitCode::kBadInput), "scene.toml:4: " + scan.path + " *attribute \"klass\"");
}

TEST(SplatSelection, CopiesOfNearSplatsLackTheHidden) {
    std::vector<std::uint32_t> near, listed, copy;
    for (std::uint32_t k = 0; k < 300000; ++k) { // more than one task handles
        near.insert(near.end(), {k + 1, ~k});
        listed.push_back(k * 7 % 130);
    }
    copy.resize(near.size());
    const std::vector<std::uint64_t> shown{~std::uint64_t{0}, 1, 2}; // 0 to 64, and 129
    copyShownNear(shown, near, listed, copy);
    for (std::size_t k = 0; k < listed.size(); ++k) {
        const bool is_shown = listed[k] <= 64 || listed[k] == 129;
        ASSERT_EQ(copy[2 * k], is_shown ? near[2 * k] : 0) << k;
        ASSERT_EQ(copy[2 * k + 1], is_shown ? near[2 * k + 1] : 0) << k;
    }
}

TEST(SplatSelection, NearSplatsAreResized) {
    const auto squareOf = [](const std::uint32_t* words) {
        const std::uint32_t code =
            (words[0] & PRO_NEAR_RADIUS_HIGH_MASK) << PRO_NEAR_RADIUS_LOW_BITS | (words[1] & PRO_NEAR_RADIUS_LOW_MASK);
        return double{std::bit_cast<float>((code << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS)};
    };
    // two discs of different radii, a ball with the smallest radius that codes allow, and nothing
    const std::array<std::uint32_t, 8> before{0xABCDE402, 0x12345634, 0x00000001, 0x7F0000F0, 0, 1, 0, 0};
    std::array<std::uint32_t, 8> after = before;
    resizeNear(0.5f, after);
    for (const std::size_t disc : {0u, 2u}) {
        // codes have 5 bits of precision
        EXPECT_NEAR(squareOf(&after[disc]) / squareOf(&before[disc]), 0.25, 0.25 / 32);
        EXPECT_EQ(after[disc] & ~PRO_NEAR_RADIUS_HIGH_MASK, before[disc] & ~PRO_NEAR_RADIUS_HIGH_MASK);
        EXPECT_EQ(after[disc + 1] & ~PRO_NEAR_RADIUS_LOW_MASK, before[disc + 1] & ~PRO_NEAR_RADIUS_LOW_MASK);
    }
    EXPECT_EQ(after[5], 1u) << "0 would be nothing";
    EXPECT_EQ(after[7], 0u);
    after = before;
    resizeNear(1, after);
    EXPECT_EQ(after, before);
}

TEST_F(ScenePaintTest, HistogramsCountAllNumbers) {
    const NumberHistogram classes = histogramOf(scans(), "class", {0, 0, 1});
    EXPECT_EQ(classes.values, (std::vector<double>{2, 5, 6}));
    EXPECT_EQ(classes.range, (ValueRange{2, 6}));
    ASSERT_EQ(classes.shares.size(), kHistogramBins);
    EXPECT_EQ(classes.shares.front(), 1) << "three of five";
    EXPECT_FLOAT_EQ(classes.shares.back(), 1.0f / 3);
    EXPECT_TRUE(histogramOf(scans(), "height", {0, 0, 1}).values.empty());
    EXPECT_EQ(histogramOf(scans(), "klass", {0, 0, 1}), NumberHistogram{});
}

TEST_F(ScenePaintTest, GaussiansKeepTheirColours) {
    scan.is_gaussian = true;
    EXPECT_EQ(colorWords(scans()), std::vector<std::string>{kOwnColors});
    colorBy("height");
    EXPECT_SAYS(refusal(ExitCode::kBadUsage), "--color-by: Gaussian *");
    colorBy(kOwnColors);
    scene.filters = {{{"height", {{0, 1}}}, true, ""}};
    EXPECT_SAYS(refusal(ExitCode::kBadInput), "Gaussian captures *no attributes");
}

TEST_F(ScenePaintTest, ColouredScans_KeepTheirOverrides) {
    scene.materials.resize(1);
    put(MaterialOverride::ColorRange{{0, 0, 250}, {10, 10, 255}}, 0); // matches the colours of the file
    colorBy("intensity");
    EXPECT_EQ(rows(), (Ints{0, 1, 2, 0, 1}));
}

TEST_F(ScenePaintTest, Errors_ListWhatIsAvailable) {
    colorBy("intensty");
    EXPECT_SAYS(refusal(ExitCode::kBadUsage),
                "--color-by: " + scan.path +
                    " *\"intensty\"*\"intensity\"*rgb, height, normal, intensity, classification, gps_time, rgb16.0, "
                    "rgb16.1, rgb16.2, größe in einer Einheit, 31 By");
    for (const char* word : {"rgb16", "rgb16.3", "rgb16.", ".0", "scan"}) {
        colorBy(word);
        EXPECT_NE(refusal(ExitCode::kBadUsage), "") << word;
    }
    colorBy(kOwnColors);
    scene.materials.resize(1);
    put(SplatSelection{"normal", {{0, 1}}}, 0);
    EXPECT_SAYS(refusal(ExitCode::kBadInput), "scene.toml:9: " + scan.path + " *attribute \"normal\"");
}

TEST_F(ScenePaintTest, Materials_AreLimitedTo256) {
    scene.materials.resize(255);
    for (std::uint32_t m = 0; m < 254; ++m) put(SplatSelection{"intensity", {{0, 0}}}, m);
    EXPECT_EQ(refusal(ExitCode::kBadInput), "");
    put(SplatSelection{"intensity", {{0, 0}}}, 254);
    EXPECT_SAYS(refusal(ExitCode::kBadInput), "scene.toml:9: " + scan.path + " *256 materials");
}

TEST_F(ScenePaintTest, Requests_DifferIfPaintDiffers) {
    const PaintRequest plain = paintRequest(scene, settings);
    settings.color_range = {{0, 1}};
    settings.legend = true;
    scene.up = {0, 0, 1};
    EXPECT_EQ(paintRequest(scene, settings), plain) << "it has no visible effect";
    settings.color_by = "intensity";
    const PaintRequest intensity = paintRequest(scene, settings);
    EXPECT_NE(intensity, plain);
    scene.up = Vec3{0, 1, 0};
    EXPECT_EQ(paintRequest(scene, settings), intensity) << "no height";
    settings.color_by = "height";
    const PaintRequest height = paintRequest(scene, settings);
    scene.up = {0, 0, 1};
    EXPECT_NE(paintRequest(scene, settings), height);
}

} // namespace
} // namespace pointrt
