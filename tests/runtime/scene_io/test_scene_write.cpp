// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/scene_write.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene_io/read_parts.h"
#include "runtime/scene_io/write_parts.h"
#include "runtime/session/settings.h"
#include "tests/runtime/scene_io/scene_file_fixture.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

/// Random scenes that the reader could return, with awkward numbers.
class RandomScene {
public:
    RandomScene(std::uint32_t seed, std::string folder) : random_(seed), folder_(std::move(folder)) {}

    SceneDescription scene() {
        SceneDescription scene;
        if (chance()) scene.up = direction();
        if (chance()) scene.staged_for = point();
        scene.camera = camera(scene.up);
        for (std::uint32_t v = below(4); v > 0; --v)
            scene.views.push_back({"view \"" + std::to_string(v) + "\"", camera(scene.up)});
        addRender(scene.render);
        addMaterials(scene);
        for (std::uint32_t i = 1 + below(3); i > 0; --i) scene.instances.push_back(instance());
        for (std::uint32_t c = below(4); c > 0; --c) scene.clips.push_back(clip());
        for (std::uint32_t f = below(3); f > 0; --f) scene.filters.push_back({numbers(), chance(), ""});
        for (std::uint32_t m = below(4); m > 0; --m) scene.measures.push_back(measure());
        for (std::uint32_t s = below(6); s > 0; --s) scene.shapes.push_back(shape());
        if (std::none_of(scene.shapes.begin(), scene.shapes.end(), [&](auto& each) { return each.material == named_; }))
            scene.materials.resize(named_);
        for (std::uint32_t l = below(7); l > 0; --l) scene.lights.push_back(light());
        if (chance()) scene.sky = sky();
        return scene;
    }

private:
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }
    bool chance() { return below(2) == 1; }
    /// A number from 0 to 1, with all digits or with few.
    double share() { return below(4) == 0 ? below(5) / 4.0 : std::generate_canonical<double, 53>(random_); }
    double length() { return (share() + 1e-3) * std::pow(10.0, below(9) - 4.0); }
    double coordinate() { return (chance() ? 1 : -1) * (below(5) == 0 ? 0.0 : length()); }
    float single(double high) { return static_cast<float>(share() * high); }
    Vec3 point() { return {coordinate(), coordinate(), coordinate()}; }
    Vec3 direction() { return normalize(Vec3{share() - 2, share() - 0.5, share() - 0.5}); }
    Color color(double high) { return {single(high), single(high), single(high)}; }

    template <typename Value>
    void maybe(std::optional<Value>& place, Value value) {
        if (chance()) place = value;
    }

    CameraRequest camera(const std::optional<Vec3>& scene_up) {
        CameraRequest camera;
        maybe(camera.eye, point());
        maybe(camera.target, point() + Vec3{1e6, 0, 0});
        camera.up = scene_up;
        maybe(camera.up, direction());
        if (chance()) {
            camera.fov_deg = 1 + 170 * share();
            return camera;
        }
        camera.ortho = true;
        maybe(camera.ortho_height, length());
        return camera;
    }

    void addRender(RenderChoices& said) {
        maybe(said.room, Room{static_cast<int>(below(3))});
        const auto byte = [&] { return static_cast<std::uint8_t>(below(256)); };
        maybe(said.background, chance() ? Background{{}, chance()} : Background{{byte(), byte(), byte()}, false});
        maybe(said.integrator, Integrator{static_cast<int>(below(5))});
        maybe(said.bounces, below(65));
        maybe(said.spp, 1 + below(65536));
        maybe(said.size, PixelSize{1 + below(16384), 1 + below(16384)});
        maybe(said.seed, static_cast<std::uint32_t>(random_()));
        maybe(said.lights, below(17));
        maybe(said.shadows, chance());
        maybe(said.caustics, chance());
        maybe(said.blend, chance());
        maybe(said.relight, chance());
        maybe(said.reflectivity, single(1));
        maybe(said.exposure, single(40) - 20);
        maybe(said.denoise, DenoiseChoice{static_cast<int>(below(3))});
        maybe(said.color_by, std::string(chance() ? "height" : "gr\xc3\xb6\xc3\x9f\" e"));
        maybe(said.color_map, ColorMap{static_cast<int>(below(9))});
        const double low = point().x;
        maybe(said.color_range, ValueRange{low, low + 1e6});
        maybe(said.legend, chance());
        maybe(said.detail, single(16384));
    }

    MaterialDescription material(const std::string& name) {
        MaterialDescription material;
        material.name = name;
        material.kind = MaterialKind{static_cast<int>(below(5))};
        material.color = color(1);
        material.splat_color = chance();
        if (chance()) material.emission = color(1e5);
        const bool glass = material.kind == MaterialKind::kGlass, plastic = material.kind == MaterialKind::kPlastic;
        if (plastic || material.kind == MaterialKind::kMetal) material.roughness = single(1);
        if (plastic || glass) material.index = 1 + single(3);
        if (glass) material.thin = chance();
        if (glass && !material.thin) material.absorption = color(1e3);
        if (material.kind != MaterialKind::kMatte) return material;
        material.mirror_share = single(1);
        material.specular = single(1);
        material.shininess = 1 + single(999);
        return material;
    }

    void addMaterials(SceneDescription& scene) {
        std::set<std::string> names;
        for (std::uint32_t m = 1 + below(5); m > 0; --m)
            names.insert(std::string(chance()   ? "a.b \""
                                     : chance() ? "plain"
                                                : "\xc3\xbc\\") +
                         std::to_string(random_() % 1000));
        for (const std::string& name : names) scene.materials.push_back(material(name));
        named_ = static_cast<std::uint32_t>(names.size());
        scene.materials.emplace_back();
    }

    std::array<Vec3, 3> rotation() {
        const Vec3 x = direction(), y = normalize(cross(x, Vec3{0, 0.6, 0.8})), z = cross(x, y);
        return {x, y, z};
    }

    SplatSelection numbers() {
        SplatSelection numbers{chance() ? "class" : "a \"name\"", {}};
        const double at = point().x;
        if (chance()) return {numbers.attribute, {{at, at + length()}}};
        for (std::uint32_t n = below(3); n < 3; ++n) {
            const double value = point().y;
            numbers.ranges.push_back({value, value});
        }
        return numbers;
    }

    InstanceDescription instance() {
        InstanceDescription instance{folder_ + (chance() ? "/statue.pro" : "/dragon.pro"), {}, {}, {}};
        if (chance()) instance.placement = {rotation(), length(), point()};
        maybe(instance.material, below(named_));
        instance.clipped = chance();
        instance.colored = chance();
        const auto byte = [&] { return static_cast<std::uint8_t>(below(128)); };
        for (std::uint32_t o = below(4); o > 0; --o)
            if (chance())
                instance.overrides.push_back({MaterialOverride::Row{below(256)}, below(named_), ""});
            else if (chance())
                instance.overrides.push_back({numbers(), below(named_), ""});
            else
                instance.overrides.push_back(
                    {MaterialOverride::ColorRange{{byte(), byte(), byte()}, {200, 255, 128}}, below(named_), ""});
        return instance;
    }

    ClipDescription clip() {
        if (chance()) return {ClipPlane{point(), direction()}, chance()};
        const Vec3 low = point();
        ClipBox box{low, low + Vec3{length(), length(), length()}};
        if (chance()) box.rotation = rotation();
        return {box, chance()};
    }

    MeasureDescription measure() {
        MeasureDescription measure{{point(), point(), point()}, chance(), chance()};
        if (!measure.closed && chance()) measure.points.pop_back();
        if (chance()) measure.layer = {"eaves \"3\"", chance()};
        return measure;
    }

    /// With axes as written by usual keys, or with arbitrary valid axes.
    ShapeDescription shape() {
        ShapeDescription shape;
        shape.kind = ShapeKind{static_cast<int>(below(5))};
        shape.center = point();
        shape.material = below(named_ + 1);
        shape.seen_by_camera = chance();
        shape.backdrop = chance();
        const bool by_hand = chance();
        const std::array<Vec3, 3> turn = by_hand ? Placement{}.rotation : rotation();
        const bool box = shape.kind == ShapeKind::kBox, quad = shape.kind == ShapeKind::kQuad;
        const bool plane = shape.kind == ShapeKind::kPlane, sphere = shape.kind == ShapeKind::kSphere;
        const double u = plane ? 1 : length(), v = box || quad ? length() : u, w = box ? length() : sphere ? u : 1;
        shape.u = u * turn[0];
        shape.v = v * turn[1];
        shape.w = w * turn[2];
        if (by_hand && (plane || shape.kind == ShapeKind::kDisc)) layFlat(shape, direction(), u);
        return shape;
    }

    SunLight sun() {
        SunLight sun;
        sun.towards = direction();
        sun.radius_deg = 45 * share();
        sun.irradiance = color(1);
        return sun;
    }

    LightDescription light() {
        const std::array<Vec3, 3> turn = rotation();
        const double outer = 0.1 + 89 * share();
        switch (below(kLightKinds)) {
        case 0:
            return PointLight{point(), color(1e6)};
        case 1:
            return SpotLight{point(), direction(), outer, outer * share(), color(10)};
        case 2:
            return sun();
        case 3:
            return SphereLight{point(), length(), color(100), chance()};
        case 4:
            return DiscLight{point(), direction(), length(), color(100), chance()};
        default:
            return QuadLight{point(), length() * turn[0], length() * turn[1], color(100), chance()};
        }
    }

    SkyDescription sky() {
        SkyDescription sky;
        sky.strength = single(1e6);
        sky.ambient = single(1);
        if (chance()) {
            sky.image = folder_ + "/sky.hdr";
            sky.rotation_deg = 720 * share() - 360;
            return sky;
        }
        sky.zenith = color(1);
        sky.horizon = color(10);
        sky.ground = color(1e-6);
        return sky;
    }

    std::mt19937 random_;
    std::string folder_;
    std::uint32_t named_ = 0; ///< number of materials with a name; the next one is for shapes without a material
};

/// The scene without its places in files.
SceneDescription withoutPlaces(SceneDescription scene) {
    scene.path.clear();
    for (InstanceDescription& instance : scene.instances)
        for (MaterialOverride& over : instance.overrides) over.place.clear();
    for (FilterDescription& filter : scene.filters) filter.place.clear();
    return scene;
}

class SceneWrite : public SceneFile {
protected:
    SceneDescription again(const SceneDescription& scene) const {
        return withoutPlaces(parse(sceneText(scene, folder_.string())));
    }

    std::string refusalToWrite(const std::string& to, const SceneDescription& scene) const {
        try {
            writeSceneFile(to, scene);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    SceneDescription oneScan() const {
        SceneDescription scene;
        scene.instances.push_back({path("statue.pro"), {}, {}, {}});
        return scene;
    }
};

TEST_F(SceneWrite, RandomScenesSurviveARoundTripBitIdentical) {
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        const SceneDescription scene = RandomScene(seed, folder_.string()).scene();
        const SceneDescription read = again(scene);
        const std::string text = sceneText(scene, folder_.string());
        ASSERT_TRUE(read == scene) << "seed " << seed << "\n" << text << "---\n" << sceneText(read, folder_.string());
        ASSERT_EQ(sceneText(read, folder_.string()), text) << "seed " << seed; // distinguishes -0 from 0
    }
}

TEST_F(SceneWrite, TheExampleSurvivesARoundTrip) {
    std::filesystem::copy_file(POINTRT_EXAMPLE_SCENE, folder_ / "example.toml");
    const SceneDescription scene = readSceneFile(path("example.toml"));
    writeSceneFile(path("again.toml"), scene);
    const SceneDescription first = withoutPlaces(readSceneFile(path("again.toml")));
    EXPECT_TRUE(first == withoutPlaces(scene)) << sceneText(scene, folder_.string());
    EXPECT_TRUE(again(first) == first);
}

TEST_F(SceneWrite, PrefersReadableKeysIfExact) {
    const SceneDescription scene = parse("up = [0, 0, 3]\n[[shape]]\ntype = 'disc'\ncenter = [1, 2, 3]\n"
                                         "normal = [3, 4, 5]\nradius = 0.7\n"
                                         "[[shape]]\ntype = 'box'\nmin = [0, 0, 0]\nmax = [1, 2, 3]\n"
                                         "[[shape]]\ntype = 'plane'\npoint = [0, 0, 0.1]\nnormal = [1, 1, 1]\n");
    const std::string text = sceneText(scene, folder_.string());
    for (const char* line : {"\nradius = ", "\nsize = [1, 2, 3]\n", "\npoint = [0, 0, 0.1]\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line << text;
    EXPECT_EQ(text.find("axes"), std::string::npos) << text;
}

TEST_F(SceneWrite, NumbersAreShortAndExact) {
    EXPECT_EQ(tomlOf(0.1f), "0.1");
    EXPECT_EQ(tomlOf(0.1), "0.1");
    EXPECT_EQ(tomlOf(3.0), "3");
    EXPECT_EQ(tomlOf(-0.0), "-0.0");
    EXPECT_EQ(tomlOf(1.0 / 3), "0.3333333333333333");
    EXPECT_EQ(tomlOf(std::string("a\"b\\c\n")), "\"a\\\"b\\\\c\\u000a\"");
}

TEST_F(SceneWrite, MaterialsGetUniqueNames) {
    SceneDescription scene = oneScan();
    scene.materials.resize(5);
    for (std::uint32_t m = 0; m < 5; ++m) {
        scene.materials[m].color = {0.1f * static_cast<float>(m), 0, 0};
        scene.instances[0].overrides.push_back({MaterialOverride::Row{m}, m, ""});
    }
    scene.materials[0].name = "zinc";
    scene.materials[1].name = "brass";
    scene.materials[2].name = "brass";
    scene.materials[4].name = std::string(100, 'x');
    const SceneDescription read = again(scene);
    ASSERT_EQ(read.materials.size(), 5u);
    for (std::uint32_t m = 0; m < 5; ++m) {
        const MaterialDescription& material = read.materials.at(read.instances[0].overrides[m].material);
        EXPECT_EQ(material.color, scene.materials[m].color) << m;
        EXPECT_EQ(material.name == scene.materials[m].name, m < 2) << material.name;
    }
}

TEST_F(SceneWrite, FindsFilesOfOtherFolders) {
    std::filesystem::create_directories(folder_ / "a" / "b");
    std::filesystem::create_directory_symlink(folder_ / "a" / "b", folder_ / "link");
    for (const char* folder : {"a", "a/b", "link"}) {
        const std::string to = path(folder) + "/scene.toml";
        writeSceneFile(to, oneScan());
        const std::string found = readSceneFile(to).instances[0].path;
        EXPECT_TRUE(std::filesystem::equivalent(found, path("statue.pro"))) << found;
    }
    EXPECT_EQ(pathFrom("/a", "/a/b/c.pro"), "b/c.pro");
    EXPECT_EQ(pathFrom("", "b/c.pro"), "b/c.pro");
}

TEST_F(SceneWrite, LeavesNoFileOnFailure) {
    EXPECT_HAS(refusalToWrite(path("none/scene.toml"), oneScan()), "none/scene.toml: *folder");
    SceneDescription scene = oneScan();
    scene.camera.eye = Vec3{NAN, 0, 0};
    const std::string refusal = refusalToWrite(path("bad.toml"), scene);
    EXPECT_NE(refusal.find("camera.eye"), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
    scene = oneScan();
    for (std::uint32_t i = 0; i < 100000; ++i) scene.views.push_back({"view " + std::to_string(i), {}});
    EXPECT_HAS(refusalToWrite(path("bad.toml"), scene), "1 MiB");
    EXPECT_FALSE(std::filesystem::exists(path("bad.toml")));
}

/// Everything that determines a picture: the scene with its surroundings, the settings and the camera.
struct Picture {
    SceneDescription scene;
    RenderSettings settings;
    Camera camera;
};

constexpr Vec3 kScanLow{-1, 0, -2}, kScanHigh{3, 1, 2.5};

Picture pictureOf(const Options& options, SceneDescription scene) {
    Picture picture{std::move(scene), {}, {}};
    picture.settings = resolveSettings(options, picture.scene);
    picture.camera = frameCamera(picture.settings.camera, kScanLow, kScanHigh, 1.5);
    addSurroundings(picture.scene, picture.settings, picture.camera, kScanLow, kScanHigh);
    return picture;
}

void expectSame(const Picture& a, const Picture& b) {
    EXPECT_TRUE(a.scene.shapes == b.scene.shapes);
    EXPECT_TRUE(a.scene.lights == b.scene.lights);
    EXPECT_TRUE(a.scene.sky == b.scene.sky);
    EXPECT_EQ(pictureBackground(a.scene), pictureBackground(b.scene));
    EXPECT_TRUE(a.settings.camera == b.settings.camera);
    EXPECT_EQ(a.camera.eye, b.camera.eye);
    EXPECT_EQ(a.camera.right, b.camera.right);
    EXPECT_EQ(sceneUp(a.scene, a.settings), sceneUp(b.scene, b.settings));
    EXPECT_EQ(a.settings.seed, b.settings.seed);
    EXPECT_EQ(a.settings.spp, b.settings.spp);
    EXPECT_EQ(a.settings.exposure, b.settings.exposure);
    EXPECT_EQ(a.settings.denoise, b.settings.denoise);
    EXPECT_EQ(a.settings.shadows, b.settings.shadows);
    EXPECT_EQ(a.settings.reflectivity, b.settings.reflectivity);
}

/// Surroundings are those for a run's first camera, which has moved since.
TEST_F(SceneWrite, ASavedRunShowsTheSamePicture) {
    std::vector<Options> runs(5);
    runs[1].choices.room = Room::kMirror;
    runs[2].choices.lights = 5;
    runs[3].camera.up = Vec3{0, 0.1, 1};
    runs[3].camera.eye = Vec3{1, -9, 2};
    runs[4].choices.background = Background{{255, 128, 0}, false};
    for (Options& options : runs) {
        options.choices.seed = 7;
        options.choices.exposure = 0.1f;
        options.choices.denoise = DenoiseChoice::kOff;
        options.choices.shadows = false;
        options.choices.reflectivity = 0.3f;
        Picture run = pictureOf(options, oneScan());
        const Vec3 first_eye = run.camera.eye;
        const auto readBack = [&] { return pictureOf({}, again(describeRun(oneScan(), run.settings, first_eye))); };
        if (run.settings.camera.up) run.settings.camera.up = normalize(*run.settings.camera.up);
        const auto up = sceneUp(run.scene, run.settings);
        Picture read = readBack();
        if (!run.settings.camera.up) read.settings.camera.up.reset(); // the scene's is the default
        expectSame(read, run);
        run.settings.camera.eye = Vec3{9, 3, 4};
        run.settings.camera.up = up;
        run.camera = frameCamera(run.settings.camera, kScanLow, kScanHigh, 1.5);
        expectSame(readBack(), run);
    }
}

TEST_F(SceneWrite, OwnedSurroundingsAreNotAddedTwice) {
    for (const bool room : {false, true}) {
        Options options;
        if (room) options.choices.room = Room::kMatte;
        Picture run = pictureOf(options, oneScan());
        ownSurroundings(run.scene, run.settings);
        run.scene.lights.clear();
        const SceneDescription read = again(describeRun(run.scene, run.settings, run.camera.eye));
        const Picture picture = pictureOf({}, read);
        EXPECT_TRUE(picture.scene.shapes == run.scene.shapes);
        EXPECT_TRUE(picture.scene.lights.empty());
        EXPECT_EQ(picture.scene.sky.has_value(), !room);
    }
}

TEST_F(SceneWrite, AnOwnedBackgroundIsTheSameAgain) {
    Options options;
    options.choices.background = Background{{255, 128, 0}, false};
    Picture run = pictureOf(options, oneScan());
    ownSurroundings(run.scene, run.settings);
    const Picture picture = pictureOf({}, again(describeRun(run.scene, run.settings, run.camera.eye)));
    EXPECT_TRUE(picture.scene.lights == run.scene.lights);
    EXPECT_TRUE(picture.scene.sky == run.scene.sky);
    EXPECT_EQ(pictureBackground(picture.scene), options.choices.background);
}

} // namespace
} // namespace pointrt
