// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/options.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "format/base/error.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

using Arguments = std::vector<const char*>;

Options parse(Arguments arguments) {
    arguments.insert(arguments.begin(), "pointrt-view");
    Options options;
    EXPECT_FALSE(parseOptions(static_cast<int>(arguments.size()), arguments.data(), options));
    return options;
}

/// The message of a usage error; "" if there is no error.
std::string refusal(Arguments arguments) {
    arguments.insert(arguments.begin(), {"pointrt-view", "a.pro", "-o", "a.png"});
    Options options;
    try {
        parseOptions(static_cast<int>(arguments.size()), arguments.data(), options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(Options, HasTheDefaultsOfTheContract) {
    const Options options = parse({"a.pro", "-o", "a.png"});
    EXPECT_EQ(options.scene, "a.pro");
    EXPECT_EQ(options.output, "a.png");
    EXPECT_EQ(options.choices, RenderChoices{}) << "nothing is said";
    EXPECT_EQ(options.camera, CameraRequest{});
    EXPECT_FALSE(options.fov_deg || options.limits.seconds || options.limits.noise || options.resume);
    const RenderSettings settings;
    EXPECT_EQ(settings.width, 512u);
    EXPECT_EQ(settings.height, 512u);
    EXPECT_EQ(settings.spp, 4u);
    EXPECT_EQ(settings.integrator, Integrator::kPhong);
    EXPECT_EQ(settings.camera.fov_deg, 40);
    EXPECT_EQ(settings.detail, 1);
    EXPECT_TRUE(settings.shadows && settings.blend && settings.caustics);
    EXPECT_FALSE(settings.room || settings.lights || settings.reflectivity || settings.first_hits);
    EXPECT_EQ(options.view, "");
    EXPECT_EQ(options.turntable, 0u);
    EXPECT_EQ(options.bench_frames, 0u);
    EXPECT_FALSE(options.list_devices || options.quiet || options.verbose);
}

TEST(Options, TakesSeveralScansAndOptionsOfTheirBake) {
    const Options options =
        parse({"a.ply", "b.laz", "-o", "a.png", "--spp", "2", "--bake", "--clean", "off", "-j", "1"});
    EXPECT_EQ(options.inputs, (std::vector<std::string>{"a.ply", "b.laz"}));
    EXPECT_EQ(options.bake_options, (std::vector<std::string>{"--clean", "off", "-j", "1"}));
    EXPECT_EQ(options.choices.spp, 2u);
    EXPECT_THROW(parse({"a.ply", "--bake"}), Error);
    EXPECT_THROW(parse({"a.ply", "--bake=--clean off"}), Error);
    EXPECT_THROW(parse({"a.ply", "--bake", "--output=b.pro"}), Error);
    EXPECT_THROW(parse({"a.pro", "--bake", "--clean", "off"}), Error);
}

TEST(Options, ProfileNeedsOutputOrBench) {
    EXPECT_FALSE(parse({"a.pro", "-o", "a.png"}).profile);
    EXPECT_TRUE(parse({"a.pro", "-o", "a.png", "--profile"}).profile);
    EXPECT_TRUE(parse({"a.pro", "--bench", "2", "--profile"}).profile);
    Options options;
    const Arguments of_window = {"pointrt-view", "a.pro", "--profile"};
    EXPECT_THROW(parseOptions(static_cast<int>(of_window.size()), of_window.data(), options), Error);
}

TEST(Options, TakesEveryOption) {
    const Options options = parse({"--size",
                                   "64x48",
                                   "--spp",
                                   "9",
                                   "--seed",
                                   "4294967295",
                                   "--fov",
                                   "12.5",
                                   "--integrator",
                                   "path",
                                   "a.pro",
                                   "--bounces",
                                   "7",
                                   "--room",
                                   "mirror",
                                   "--lights",
                                   "0",
                                   "--shadows",
                                   "off",
                                   "--blend",
                                   "off",
                                   "--relight",
                                   "on",
                                   "--reflectivity",
                                   "0.25",
                                   "--device",
                                   "H100",
                                   "--bench",
                                   "3",
                                   "--stats",
                                   "-",
                                   "--caustics",
                                   "off",
                                   "--time-limit",
                                   "2.5",
                                   "--noise",
                                   "0.02",
                                   "--denoise",
                                   "on",
                                   "-v",
                                   "-o",
                                   "out.exr"});
    EXPECT_EQ(options.choices.size, (PixelSize{64, 48}));
    EXPECT_EQ(options.choices.spp, 9u);
    EXPECT_EQ(options.choices.seed, 4294967295u);
    EXPECT_EQ(options.fov_deg, 12.5);
    EXPECT_EQ(options.choices.integrator, Integrator::kPath);
    EXPECT_EQ(options.choices.bounces, 7u);
    EXPECT_EQ(options.choices.room, Room::kMirror);
    EXPECT_EQ(options.choices.lights, 0u);
    EXPECT_FALSE(*options.choices.shadows || *options.choices.blend || *options.choices.caustics);
    EXPECT_EQ(options.choices.relight, true);
    EXPECT_EQ(options.limits.seconds, 2.5);
    EXPECT_EQ(options.limits.noise, 0.02);
    EXPECT_EQ(options.choices.denoise, DenoiseChoice::kOn);
    EXPECT_EQ(options.choices.reflectivity, 0.25f);
    EXPECT_EQ(options.device, "H100");
    EXPECT_EQ(options.bench_frames, 3u);
    EXPECT_EQ(options.stats, "-");
    EXPECT_TRUE(options.verbose);
}

TEST(Options, TakesParallelProjection) {
    const CameraRequest height = parse({"a.pro", "-o", "a.png", "--ortho", "2.5"}).camera;
    EXPECT_TRUE(height.ortho);
    EXPECT_EQ(height.ortho_height, 2.5);
    const CameraRequest fit = parse({"a.pro", "-o", "a.png", "--ortho", "fit"}).camera;
    EXPECT_TRUE(fit.ortho && !fit.ortho_height);
    EXPECT_SAYS(refusal({"--ortho", "2", "--fov", "30"}), "--fov *--ortho *combined");
}

TEST(Options, APlanSetsItsCameraItself) {
    EXPECT_EQ(parse({"a.pro", "-o", "a.tif", "--plan", "0.25"}).plan, 0.25);
    EXPECT_TRUE(writesToneMapped(parse({"a.pro", "-o", "a.tif"})));
    EXPECT_SAYS(refusal({"--plan", "1", "--view", "top"}), "--plan and --view cannot be combined*");
    EXPECT_SAYS(refusal({"--plan", "1", "--target", "1,2,3"}),
                "--plan and --target without --size cannot be combined*");
    EXPECT_SAYS(refusal({"--plan", "0"}), "--plan: *0*");
    EXPECT_NO_THROW(parse({"a.pro", "-o", "a.png", "--plan", "1", "--target", "1,2,3", "--size", "8x8"}));
    EXPECT_THROW(parse({"a.pro", "-o", "a.exr", "--plan", "1"}), Error);
}

TEST(Options, TakesNegativeCoordinates) {
    const Options options =
        parse({"a.pro", "-o", "a.png", "--eye", "-1,-.5,1e3", "--target=500000.25,-2,0", "--up", "0,0,1"});
    EXPECT_EQ(options.camera.eye->x, -1);
    EXPECT_EQ(options.camera.eye->y, -0.5);
    EXPECT_EQ(options.camera.eye->z, 1000);
    EXPECT_EQ(options.camera.target->x, 500000.25);
    EXPECT_EQ(options.camera.up->z, 1);
}

TEST(Options, TakesClipsAndASection) {
    const Options options =
        parse({"a.pro", "-o", "a.png", "--clip", "-1,-2,-3,1,2,3", "--clip=0,0,0,9,9,9", "--section", "-x=12.5:0.5"});
    ASSERT_EQ(options.clips.size(), 2u);
    EXPECT_EQ(std::get<ClipBox>(options.clips[0].form).low, (Vec3{-1, -2, -3}));
    EXPECT_EQ(std::get<ClipBox>(options.clips[1].form).high, (Vec3{9, 9, 9}));
    ASSERT_TRUE(options.section);
    const auto& plane = std::get<AxisSection>(options.section->plane);
    EXPECT_TRUE(plane.axis == 0 && plane.at == 12.5 && plane.reversed && options.section->thickness == 0.5);
    EXPECT_SAYS(refusal({"--clip", "0,0,0,1,1"}), "--clip: \"0,0,0,1,1\" *MINX,MINY,MINZ,MAXX,MAXY,MAXZ");
    EXPECT_SAYS(refusal({"--clip", "0,0,0,1,0,1"}), "--clip: *\"0,0,0,1,0,1\" *y ");
    EXPECT_SAYS(refusal({"--clip", "0,0,nan,1,1,1"}), "--clip: \"0,0,nan,1,1,1\" ");
    EXPECT_SAYS(refusal({"--section", "12"}), "--section: \"12\" *z=1.2:0.5");
    EXPECT_SAYS(refusal({"--section", "z=1:0"}), "--section: \"0\" *above 0");
}

TEST(Options, TakesAnAxisForUp) {
    const Options axis = parse({"a.pro", "-o", "a.png", "--up", "-z"});
    EXPECT_EQ(axis.up_axis, (Vec3{0, 0, -1}));
    EXPECT_EQ(axis.camera.up, axis.up_axis);
    EXPECT_EQ(axis.camera.side, (Vec3{0, -1, 0}));
    const Options vector = parse({"a.pro", "-o", "a.png", "--up", "z", "--up", "0,0,1"});
    EXPECT_FALSE(vector.up_axis);
    EXPECT_EQ(vector.camera.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(vector.camera.side, (Vec3{0, 0, 1}));
    EXPECT_EQ(parse({"a.pro", "-o", "a.png", "--up", "z", "--up", "auto"}).camera, CameraRequest{});
    EXPECT_SAYS(refusal({"--up", "upwards"}), "--up: \"upwards\" *auto, x, y, z, -x, -y, -z*X,Y,Z");
}

TEST(Options, TakesColours) {
    const Options options = parse({"a.pro", "-o", "a.png", "--color-by", "gps_time", "--color-map", "magma",
                                   "--color-range", "-1,2", "--legend", "on"});
    EXPECT_EQ(options.choices.color_by, "gps_time");
    EXPECT_EQ(options.choices.color_map, ColorMap::kMagma);
    EXPECT_EQ(options.choices.color_range, (ValueRange{-1, 2}));
    EXPECT_EQ(options.choices.legend, true);
    EXPECT_SAYS(refusal({"--color-range", "3,2"}), "--color-range: \"3,2\" *LO,HI");
    EXPECT_SAYS(refusal({"--color-by", "a\nb"}), "--color-by: \"a\\nb\" *name");
    EXPECT_SAYS(refusal({"-o", "a.exr", "--legend", "on"}), "--legend: *FILE.png");
}

TEST(Options, TakesABackground) {
    EXPECT_EQ(parse({"a.pro", "-o", "a.png", "--background", "white"}).choices.background,
              (Background{{255, 255, 255}, false}));
    EXPECT_FALSE(parse({"a.pro", "-o", "a.png"}).choices.background);
    EXPECT_SAYS(refusal({"--background", "gr\ney"}), "--background: \"gr\\ney\" *black, white, transparent *#ff8000");
}

TEST(Options, TakesTheLastOfARepeatedOption) {
    EXPECT_EQ(parse({"a.pro", "-o", "a.png", "--spp", "2", "--spp", "8"}).choices.spp, 8u);
}

TEST(Options, ResumeNeedsExrAndExposureNeedsPng) {
    EXPECT_TRUE(parse({"a.pro", "-o", "a.exr", "--resume"}).resume);
    EXPECT_EQ(parse({"a.pro", "-o", "a.png", "--exposure", "-1.5"}).choices.exposure, -1.5f);
    EXPECT_SAYS(refusal({"--resume"}), "--resume: *FILE.exr");
    EXPECT_SAYS(refusal({"-o", "a.exr", "--exposure", "1"}), "--exposure: *FILE.png");
    EXPECT_NE(refusal({"-o", "a.exr", "--resume", "--bench", "1"}), "");
}

TEST(Options, TakesATurntableWithAPattern) {
    EXPECT_EQ(parse({"a.toml", "-o", "a%d.png", "--turntable", "36", "--view", "top"}).turntable, 36u);
    EXPECT_NE(refusal({"--turntable", "36"}), "");
    EXPECT_NE(refusal({"-o", "%d.png"}), "");
    for (const char* text : {"0", "100001", "-1", "x"})
        EXPECT_TRUE(contains(refusal({"-o", "%d.png", "--turntable", text}), "--turntable: ")) << text;
    EXPECT_SAYS(refusal({"-o", "%d.exr", "--turntable", "3", "--resume"}), "--turntable *--resume *combined");
    EXPECT_SAYS(refusal({"-o", "%d.png", "--turntable", "3", "--bench", "1"}), "--turntable *--bench *combined");
}

TEST(Options, ListsDevicesWithoutAScene) {
    EXPECT_TRUE(parse({"--device", "list"}).list_devices);
    EXPECT_SAYS(refusal({"--device", "list"}), "--device list *other");
}

TEST(Options, DepthUnitNeedsTheDepthLayer) {
    EXPECT_SAYS(refusal({"--cameras", "list.json", "-o", "set", "--layers", "rgb", "--depth-unit", "0.001"}),
                "--depth-unit: *depth *--layers");
    EXPECT_EQ(refusal({"--cameras", "list.json", "-o", "set", "--layers", "rgb,depth", "--depth-unit", "0.001"}), "");
}

TEST(Options, RefusesBadValuesByName) {
    for (const char* text : {"64", "0x64", "64x0", "64x-1", "64x64x64", "16385x1", "ax b", ""})
        EXPECT_TRUE(contains(refusal({"--size", text}), "--size: ")) << text;
    for (const char* text : {"0", "-1", "1.5", "many", "99999999999"})
        EXPECT_TRUE(contains(refusal({"--spp", text}), "--spp: ")) << text;
    for (const char* text : {"0", "180", "nan", "inf", "-5", "4o"})
        EXPECT_TRUE(contains(refusal({"--fov", text}), "--fov: ")) << text;
    for (const char* text : {"0", "-1", "nan", "inf", "1e13", "all", ""})
        EXPECT_TRUE(contains(refusal({"--ortho", text}), "--ortho: ")) << text;
    for (const char* text : {"1,2", "1,2,3,4", "1,,3", "1, 2,3", "nan,0,0", "1e999,0,0", ","})
        EXPECT_TRUE(contains(refusal({"--eye", text}), "--eye: ")) << text;
    for (const char* text : {"-0.1", "1.1", "x"})
        EXPECT_TRUE(contains(refusal({"--reflectivity", text}), "--reflectivity: ")) << text;
    for (const char* text : {"0", "-1", "nan", "inf", "soon"})
        EXPECT_TRUE(contains(refusal({"--time-limit", text}), "--time-limit: ")) << text;
    for (const char* text : {"0", "1.01", "nan", "2%"})
        EXPECT_TRUE(contains(refusal({"--noise", text}), "--noise: ")) << text;
    for (const char* text : {"-21", "21", "nan", "+1EV"})
        EXPECT_TRUE(contains(refusal({"--exposure", text}), "--exposure: ")) << text;
    EXPECT_SAYS(refusal({"--denoise", "maybe"}), "--denoise: \"maybe\" *on, off, auto");
    EXPECT_SAYS(refusal({"--room", "cellar"}), "--room: \"cellar\" *none, mirror, matte");
    EXPECT_TRUE(contains(refusal({"--integrator", "bidirectional"}), "whitted"));
    EXPECT_TRUE(contains(refusal({"--shadows", "yes"}), "--shadows: "));
    EXPECT_TRUE(contains(refusal({"--lights", "17"}), "--lights: "));
    EXPECT_TRUE(contains(refusal({"--bounces", "65"}), "--bounces: "));
    EXPECT_TRUE(contains(refusal({"--bench", "0"}), "--bench: "));
    EXPECT_TRUE(contains(refusal({"--seed", "-1"}), "--seed: "));
    EXPECT_SAYS(refusal({"-o", "a.jpeg"}), "a.jpeg: *.png*.tif*.exr");
}

TEST(Options, RefusesUnknownArguments) {
    EXPECT_TRUE(contains(refusal({"--frobnicate"}), "frobnicate"));
    EXPECT_TRUE(contains(refusal({"second.toml"}), "a.pro"));
    EXPECT_NE(refusal({"--spp"}), "");
    EXPECT_NE(refusal({"-q", "-v"}), "");
}

TEST(Options, ThumbnailsAreSmallPngsWithATimeLimit) {
    const Options options = parse({"a.pro", "-o", "a.thumb", "--thumbnail", "128"});
    EXPECT_TRUE(writesToneMapped(options));
    EXPECT_EQ(options.choices.size, (PixelSize{128, 128}));
    EXPECT_EQ(options.choices.spp, 4u);
    EXPECT_EQ(options.limits.seconds, 1);
    EXPECT_TRUE(options.quiet);
    EXPECT_EQ(parse({"a.pro", "-o", "a", "--thumbnail", "128", "--spp", "16"}).choices.spp, 16u);
    EXPECT_THROW(parse({"a.pro", "--thumbnail", "128"}), Error);
    EXPECT_THROW(parse({"a.pro", "-o", "a.exr", "--thumbnail", "128"}), Error);
    EXPECT_THROW(parse({"a.pro", "-o", "a.png", "--thumbnail", "0"}), Error);
    EXPECT_THROW(parse({"a.pro", "-o", "a.png", "--thumbnail", "128", "--size", "8x8"}), Error);
}

TEST(Options, RefusesIncompleteCommandLines) {
    EXPECT_THROW(parse({}), Error);
    EXPECT_THROW(parse({"-o", "a.png"}), Error);
    EXPECT_THROW(parse({"a.pro", "--offscreen"}), Error);
    EXPECT_THROW(parse({"a.pro", "--replay", "r", "-o", "a.png"}), Error);
    EXPECT_THROW(parse({"a.pro", "--replay", "r", "--record", "r"}), Error);
    EXPECT_THROW(parse({"a.pro", "--time-limit", "1"}), Error);
    EXPECT_TRUE(opensWindow(parse({"a.pro"})));
    EXPECT_TRUE(opensWindow(parse({"a.pro", "--exposure", "1", "--replay", "r", "--offscreen"})));
    EXPECT_EQ(parse({"a.pro", "--bench", "1"}).output, "");
}

TEST(Options, HelpNamesEveryOptionWithItsDefault) {
    const Arguments arguments = {"pointrt-view", "--help"};
    Options options;
    testing::internal::CaptureStdout();
    EXPECT_EQ(parseOptions(2, arguments.data(), options), 0);
    std::string help = testing::internal::GetCapturedStdout();
    for (std::size_t at = 0; (at = help.find("\n" + std::string(26, ' '))) != help.npos;) help.replace(at, 27, " ");
    for (const char* part : {"512x512",   "--spp",      "--seed",         "--eye",     "--target", "--up",
                             "--fov",     "default 40", "phong",          "--bounces", "--room",   "--lights",
                             "--shadows", "--blend",    "--reflectivity", "--device",  "--ortho",  "--bench",
                             "--stats",   "--quiet",    "--verbose",      "--version", "Camera",   "--caustics",
                             "--denoise", "--exposure", "--time-limit",   "--noise",   "--resume", ".toml"})
        EXPECT_TRUE(contains(help, part)) << part;
}

TEST(Options, PrintsItsVersion) {
    const Arguments arguments = {"pointrt-view", "--version"};
    Options options;
    testing::internal::CaptureStdout();
    EXPECT_EQ(parseOptions(2, arguments.data(), options), 0);
    EXPECT_TRUE(contains(testing::internal::GetCapturedStdout(), "pointrt-view "));
}

} // namespace
} // namespace pointrt
