// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "format/base/error.h"
#include "runtime/scene_io/scene_file.h"
#include "tests/runtime/scene_io/scene_file_fixture.h"

namespace pointrt {
namespace {

TEST_F(SceneFile, SuggestsTheNearestKey) {
    EXPECT_EQ(refusal("[material.a]\n\ncolour = [1, 1, 1]"),
              "scene.toml:3: key \"material.a.colour\": unknown key \"colour\", did you mean \"color\"?");
    EXPECT_EQ(refusal("[[light]]\n[[light]]\n"), "scene.toml:1: key \"light[0]\": \"type\" is missing");
    EXPECT_EQ(refusal("[[lihgt]]"), "scene.toml:1: key \"lihgt\": unknown key \"lihgt\", did you mean \"light\"?");
    EXPECT_EQ(refusal("[material.a]\nkind = 'metal'\nindex = 2"),
              "scene.toml:3: key \"material.a.index\": unknown key \"index\"; a material of kind \"metal\" has kind, "
              "color, splat_color, emission, roughness");
    EXPECT_EQ(
        refusal("[render]\nroom = 'none'"),
        "scene.toml:2: key \"render.room\": unknown key \"room\"; render has integrator, bounces, spp, size, "
        "seed, denoise, exposure, lights, shadows, caustics, blend, reflectivity, color_by, color_map, color_range, "
        "legend, detail");
    EXPECT_EQ(refusal("[material.gold]\n[[instance]]\nfile = 'statue.pro'\nmaterial = 'godl'"),
              "scene.toml:4: key \"instance[0].material\": there is no [material.godl], did you mean \"gold\"?");
}

TEST_F(SceneFile, RefusesWrongTypes) {
    EXPECT_EQ(refusal("[camera]\neye = 1"), "scene.toml:2: key \"camera.eye\": must be a list of 3 numbers");
    EXPECT_EQ(refusal("[camera]\neye = [1, 2]"), "scene.toml:2: key \"camera.eye\": must be a list of 3 numbers");
    EXPECT_EQ(refusal("[camera]\neye = [1,\n2,\n'3']"), "scene.toml:4: key \"camera.eye[2]\": must be a number");
    EXPECT_EQ(refusal("camera = 3"), "scene.toml:1: key \"camera\": must be a table");
    EXPECT_EQ(refusal("[light]"), "scene.toml:1: key \"light\": must be a list of tables, each begun with [[light]]");
    EXPECT_EQ(refusal("light = [1]"), "scene.toml:1: key \"light[0]\": must be a table");
    EXPECT_EQ(refusal("material.a = 1"),
              "scene.toml:1: key \"material.a\": must be a table, begun with [material.NAME]");
    EXPECT_EQ(refusal("[render]\nspp = 1.5"), "scene.toml:2: key \"render.spp\": must be an integer from 1 to 65536");
    EXPECT_EQ(refusal("[render]\nsize = [1]"), "scene.toml:2: key \"render.size\": must be [width, height]");
    EXPECT_EQ(refusal("[material.a]\nsplat_color = 1"),
              "scene.toml:2: key \"material.a.splat_color\": must be true or false");
    EXPECT_EQ(refusal("[material.a]\ncolor = 1"),
              "scene.toml:2: key \"material.a.color\": must be a colour: [red, green, blue] or \"#rrggbb\"");
    EXPECT_EQ(refusal("[material.a]\ncolor = 'ff0000'"),
              "scene.toml:2: key \"material.a.color\": \"ff0000\" is not a colour such as \"#ff8000\"");
    EXPECT_EQ(refusal("[material.a]\ncolor = '#ff-100'"),
              "scene.toml:2: key \"material.a.color\": \"#ff-100\" is not a colour such as \"#ff8000\"");
    EXPECT_EQ(refusal("room = 1"), "scene.toml:1: key \"room\": must be a string in quotes");
    EXPECT_EQ(refusal("room = ''"), "scene.toml:1: key \"room\": must not be empty");
    EXPECT_EQ(refusal("room = 'cellar'"), "scene.toml:1: key \"room\": \"cellar\" is not one of none, mirror, matte");
    EXPECT_EQ(refusal("[material.\"a\\nb\"]"),
              "scene.toml:1: key \"material.a\\nb\": is not a valid name of a material");
}

TEST_F(SceneFile, RefusesNumbersOutOfRange) {
    EXPECT_EQ(refusal("[camera]\nfov = 180"),
              "scene.toml:2: key \"camera.fov\": is 180, must be from 0.001 to 179.999");
    EXPECT_EQ(refusal("[camera]\nfov = nan"),
              "scene.toml:2: key \"camera.fov\": is nan, must be from 0.001 to 179.999");
    EXPECT_EQ(refusal("[camera]\northo = 0"), "scene.toml:2: key \"camera.ortho\": is 0, must be from 1e-09 to 1e+12");
    for (const char* text : {"true", "'all'"})
        EXPECT_EQ(refusal(std::string("[camera]\northo = ") + text),
                  "scene.toml:2: key \"camera.ortho\": must be a height or \"fit\"");
    EXPECT_EQ(refusal("[camera]\nfov = 30\northo = 2"),
              "scene.toml:3: key \"camera.ortho\": excludes \"fov\": a parallel projection has no field of view");
    EXPECT_EQ(refusal("[camera]\neye = [0, inf, 0]"),
              "scene.toml:2: key \"camera.eye[1]\": is inf, must be from -1e+12 to 1e+12");
    EXPECT_EQ(refusal("[render]\nbounces = -1"),
              "scene.toml:2: key \"render.bounces\": must be an integer from 0 to 64");
    EXPECT_EQ(refusal("[render]\nsize = [16385, 1]"),
              "scene.toml:2: key \"render.size[0]\": must be an integer from 1 to 16384");
    EXPECT_EQ(refusal("[material.a]\ncolor = [0, 0, 1.1]"),
              "scene.toml:2: key \"material.a.color[2]\": is 1.1, must be from 0 to 1");
    EXPECT_EQ(refusal("[material.a]\nemission = [0, 0, -1]"),
              "scene.toml:2: key \"material.a.emission[2]\": is -1, must be from 0 to 1e+12");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 0"),
              "scene.toml:4: key \"shape[0].radius\": is 0, must be from 1e-09 to 1e+12");
    EXPECT_EQ(refusal("[[light]]\ntype = 'spot'\nposition = [0, 0, 0]\ntarget = [0, 1, 0]\nouter = 20\ninner = 21"),
              "scene.toml:6: key \"light[0].inner\": is 21, must be from 0 to 20");
}

TEST_F(SceneFile, RefusesBrokenGeometry) {
    EXPECT_EQ(refusal("up = [0, 0, 0]"), "scene.toml:1: key \"up\": a vector of length zero has no direction");
    EXPECT_EQ(refusal("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]"),
              "scene.toml:3: key \"camera.target\": must be another point than \"eye\"");
    EXPECT_EQ(refusal("[[instance]]\nfile = 'statue.pro'\nscale = [1, 2, 1]"),
              "scene.toml:3: key \"instance[0].scale\": must be one number for all axes: discs have to stay round");
    EXPECT_EQ(
        refusal("[[instance]]\nfile = 'statue.pro'\nrotate = [{axis = [1, 0, 0], degrees = 9},\n{axis = [0, 0, 0], "
                "degrees = 1}]"),
        "scene.toml:4: key \"instance[0].rotate[1].axis\": a vector of length zero has no direction");
    EXPECT_EQ(refusal("[[instance]]\nfile = 'statue.pro'\nrotate = {axis = [1, 0, 0]}"),
              "scene.toml:3: key \"instance[0].rotate\": \"degrees\" is missing");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'quad'\ncenter = [0, 0, 0]\nu = [1, 0, 0]\nv = [0.1, 1, 0]"),
              "scene.toml:5: key \"shape[0].v\": must be at right angles to \"u\"");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'box'\nmin = [0, 0, 0]\nmax = [1, 0, 1]"),
              "scene.toml:4: key \"shape[0].max\": must be above \"min\" in x, y and z");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'box'\ncenter = [0, 0, 0]\nsize = [1, 1, 1]\nmax = [1, 0, 1]"),
              "scene.toml:5: key \"shape[0].max\": excludes \"center\"");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'box'\nsize = [1, 1, 1]"),
              "scene.toml:3: key \"shape[0].size\": has no effect without \"center\"");
    EXPECT_EQ(refusal("[[light]]\ntype = 'spot'\nposition = [1, 0, 0]\ntarget = [1, 0, 0]"),
              "scene.toml:4: key \"light[0].target\": must be another point than \"position\"");
}

TEST_F(SceneFile, RefusesInvalidMaterials) {
    EXPECT_EQ(refusal("[material.a]\nkind = 'wood'"),
              "scene.toml:2: key \"material.a.kind\": \"wood\" is not one of matte, metal, plastic, mirror, glass");
    const std::string glass = "[material.a]\nkind = 'glass'\n";
    EXPECT_EQ(
        refusal(glass + "tint = [1, 1, 0]"),
        "scene.toml:3: key \"material.a.tint\": must be above 0 in red, green and blue: some light comes through");
    EXPECT_EQ(refusal(glass + "tint = [1, 1, 1]\nabsorption = [1, 1, 1]"),
              "scene.toml:4: key \"material.a.absorption\": excludes \"tint\"");
    EXPECT_EQ(refusal(glass + "tint_distance = 1"),
              "scene.toml:3: key \"material.a.tint_distance\": has no effect without \"tint\"");
    EXPECT_EQ(refusal(glass + "thin = true\nabsorption = [1, 1, 1]"),
              "scene.toml:4: key \"material.a.absorption\": a thin pane has no inside that absorbs; use \"color\"");
    EXPECT_EQ(refusal("[material.a]\n[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 'a'"),
              "scene.toml:6: key \"shape[0].material\": needs a \"color\": shapes have no splats to "
              "take colours from");
    const std::string instance =
        "[material.a]\n[[instance]]\nfile = 'statue.pro'\n[[instance.override]]\nmaterial = 'a'\n";
    EXPECT_EQ(refusal(instance),
              "scene.toml:4: key \"instance[0].override[0]\": \"row\", \"colors\" or \"attribute\" is missing");
    EXPECT_EQ(refusal(instance + "row = 1\ncolors = []"),
              "scene.toml:7: key \"instance[0].override[0].colors\": excludes \"row\"");
    EXPECT_EQ(refusal(instance + "colors = ['#000001', '#ffff00']"),
              "scene.toml:6: key \"instance[0].override[0].colors\": empty range: the first colour must not exceed the "
              "second in red, green or blue");
}

TEST_F(SceneFile, RefusesInvalidAttributeOverrides) {
    const std::string over = "[material.a]\n[[instance]]\nfile = 'statue.pro'\n[[instance.override]]\nmaterial = 'a'\n";
    const std::string place = "scene.toml:6: key \"instance[0].override[0].", by_class = over + "attribute = 'class'\n";
    EXPECT_EQ(refusal(over + "values = [1]"), place + "values\": has no effect without \"attribute\"");
    EXPECT_EQ(refusal(over + "row = 1\nattribute = 'class'"), place + "row\": excludes \"attribute\"");
    EXPECT_EQ(refusal(by_class), "scene.toml:4: key \"instance[0].override[0]\": \"values\" or \"range\" is missing");
    const std::string next = "scene.toml:7: key \"instance[0].override[0].";
    EXPECT_EQ(refusal(by_class + "values = []"), next + "values\": must be a list of numbers");
    EXPECT_EQ(refusal(by_class + "values = ['a']"), next + "values[0]\": must be a number");
    EXPECT_EQ(refusal(by_class + "range = [2, 2]"), next + "range\": must be two numbers, the lower first");
    EXPECT_EQ(refusal(by_class + "range = [1, 2, 3]"), next + "range\": must be a list of 2 numbers");
    EXPECT_EQ(refusal("up = 'Z'"),
              "scene.toml:1: key \"up\": \"Z\" is no direction such as [0, 0, 1], and none of auto, x, "
              "y, z, -x, -y, -z");
    EXPECT_EQ(refusal("[render]\ncolor_map = 'jet'"), "scene.toml:2: key \"render.color_map\": \"jet\" is not one of "
                                                      "viridis, magma, inferno, plasma, cividis, turbo, "
                                                      "grey, classes, scans");
}

TEST_F(SceneFile, RefusesInvalidLights) {
    const std::string point = "[[light]]\ntype = 'point'\nposition = [0, 0, 0]\n", sun = "[[light]]\ntype = 'sun'\n";
    EXPECT_EQ(refusal(point), "scene.toml:1: key \"light[0]\": \"intensity\" or \"power\" is missing");
    EXPECT_EQ(refusal(point + "power = 1\nintensity = 1"),
              "scene.toml:4: key \"light[0].power\": excludes \"intensity\"");
    EXPECT_EQ(refusal(point + "intensity = [1, 1, 1]\ncolor = [1, 1, 1]"),
              "scene.toml:5: key \"light[0].color\": \"intensity\" is a colour already; make it a number");
    EXPECT_EQ(refusal(sun), "scene.toml:1: key \"light[0]\": \"towards\" or \"time\" is missing");
    EXPECT_EQ(refusal(sun + "towards = [0, 1, 0]\nnorth = [1, 0, 0]"),
              "scene.toml:4: key \"light[0].north\": has no effect without \"time\"");
    const std::string zero = sun + "latitude = 0\nlongitude = 0\nirradiance = 1\n";
    const std::string wants_offset =
        "scene.toml:6: key \"light[0].time\": must be a date and time with the offset from "
        "UTC, as 2026-06-21T18:30:00+02:00";
    for (const char* time : {"2026-06-21", "12:00:00", "2026-06-21T12:00:00", "'noon'", "7"})
        EXPECT_EQ(refusal(zero + "time = " + time), wants_offset);
    EXPECT_EQ(refusal(zero + "time = 1899-06-21T12:00:00Z"),
              "scene.toml:6: key \"light[0].time\": must be from 1900 to 2100");
    // Midnight on the equator at the solstice: 90 less the ecliptic's 23.44 degrees.
    EXPECT_EQ(refusal(zero + "time = 2024-06-21T00:00:00Z"),
              "scene.toml:6: key \"light[0].time\": the sun is 66.6 degrees below the horizon at that time and place");
    EXPECT_EQ(refusal("up = [0, 1, 0]\n" + zero + "time = 2024-03-20T12:00:00Z\nnorth = [0, 1, 0]"),
              "scene.toml:8: key \"light[0].north\": must not be along the scene's \"up\"");
}

TEST_F(SceneFile, RefusesMissingFiles) {
    EXPECT_EQ(refusal("[[instance]]"), "scene.toml:1: key \"instance[0]\": \"file\" is missing");
    EXPECT_EQ(refusal("\n[[instance]]\nfile = 'gone.pro'"),
              "scene.toml:3: key \"instance[0].file\": there is no file \"" + path("gone.pro") + "\"");
    EXPECT_EQ(refusal("[[instance]]\nfile = 'sub.pro'"),
              "scene.toml:2: key \"instance[0].file\": there is no file \"" + path("sub.pro") + "\"");
    EXPECT_EQ(refusal("[[instance]]\nfile = \"statue.pro\\u0000\""),
              "scene.toml:2: key \"instance[0].file\": must not have control characters");
    EXPECT_EQ(refusal("[sky]\nimage = 'statue.pro'"), "scene.toml:2: key \"sky.image\": must end in .hdr or .exr");
    EXPECT_EQ(refusal("[sky]\nimage = 'sky.hdr'\ncolor = [1, 1, 1]"),
              "scene.toml:3: key \"sky.color\": excludes \"image\"");
    EXPECT_EQ(refusal("[sky]\nrotation = 1"), "scene.toml:2: key \"sky.rotation\": has no effect without \"image\"");
    EXPECT_EQ(refusal(""), "scene.toml:1: the scene has neither an [[instance]] nor a [[shape]]");
    EXPECT_EQ(parse("[[instance]]\nfile = '" + path("statue.pro") + "'").instances[0].path, path("statue.pro"));
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST_F(SceneFile, EnforcesLimits) {
    const std::string instance = "[[instance]]\nfile = 'statue.pro'\n";
    EXPECT_EQ(parse(repeated(instance, 254)).instances.size(), 254u);
    EXPECT_EQ(refusal(repeated(instance, 255)),
              "scene.toml:509: key \"instance[254]\": there are at most 254 instances");
    const std::string shape = "[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\n";
    const std::string lamp = "[[light]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nradiance = 1\n";
    EXPECT_EQ(parse(repeated(shape, 32) + repeated(lamp, 32)).lights.size(), 32u);
    EXPECT_EQ(refusal(repeated(shape, 33) + repeated(lamp, 32)),
              "scene.toml:288: key \"light[31]\": there are at most 64 shapes, sphere, quad and disc lights counted");
    EXPECT_EQ(refusal(repeated(shape, 1) + repeated(lamp, 33)),
              "scene.toml:165: key \"light[32]\": there are at most 32 lights");
    EXPECT_EQ(refusal(repeated(lamp, 32) + shape + "[sky]\nimage = 'sky.hdr'\n"),
              "scene.toml:166: key \"sky.image\": is a light, and there are 32 already");
    std::string materials;
    for (int i = 100; i < 357; ++i) materials += "[material.m" + std::to_string(i) + "]\n";
    EXPECT_EQ(refusal(materials), "scene.toml:257: key \"material.m356\": there are at most 256 materials");
    const std::string range = "[[instance.override]]\ncolors = ['#000000', '#000000']\nmaterial = 'a'\n";
    EXPECT_EQ(parse("[material.a]\n" + instance + repeated(range, 8)).instances[0].overrides.size(), 8u);
    EXPECT_EQ(refusal("[material.a]\n" + instance + repeated(range, 9)),
              "scene.toml:28: key \"instance[0].override[8]\": an instance has at most 8 colour ranges");
}

TEST_F(SceneFile, ReportsTheLineOfInvalidToml) {
    EXPECT_EQ(refusal("up = [0,\n1,\n0\nroom = 'none'").substr(0, 14), "scene.toml:4: ");
    EXPECT_EQ(refusal("a = 1\na = 2").substr(0, 14), "scene.toml:2: ");
    EXPECT_EQ(refusal("\n\nup = [1e999, 0, 0]").substr(0, 14), "scene.toml:3: ");
    EXPECT_EQ(refusal("\nroom = \"\xff\"").substr(0, 14), "scene.toml:2: ");
}

// Of these toml++'s tables of white space know nothing: it promises its compiler that nobody asks them.
TEST_F(SceneFile, RefusesUnexpectedUnicode) {
    for (const char* text :
         {"\u00e9 = 1", "up = \u00e9", "up = 1 \u00e9", "up = [\u0416]", "[\u00e9]", "\u3001 = 1", "\ufe70 = 1"})
        EXPECT_TRUE(refusal(text).starts_with("scene.toml:1: ")) << text;
    EXPECT_EQ(parseMore("# \u00e9\nroom = 'none'\n[material.'\u00e9']\n").materials.back().name, "\u00e9");
}

TEST_F(SceneFile, SurvivesDeepNesting) {
    const int deep = 100000;
    EXPECT_NE(refusal("a = " + std::string(deep, '[')), "");
    EXPECT_NE(refusal("a = {" + repeated("a={", deep)), "");
    EXPECT_EQ(refusal(std::string("\n") + repeated("a.", deep) + "a = 1"), "scene.toml:2: more than 64 dots in a row");
    EXPECT_EQ(refusal(std::string("[") + repeated("a . ", deep) + "a]"), "scene.toml:1: more than 64 dots in a row");
    // as deep as both limits let it be
    EXPECT_NE(refusal(repeated(repeated("a.", 64) + "a = {", 255) + repeated("}", 255)), "");
    const SceneDescription scene = parseMore("# " + repeated("etc. and so on, ", 100));
    EXPECT_EQ(scene.instances.size(), 1u);
}

TEST_F(SceneFile, RefusesFoldersAndLargeFiles) {
    auto reading = [](const std::string& path) -> std::string {
        try {
            readSceneFile(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(reading(path("gone.toml")), path("gone.toml") + ": No such file or directory");
    EXPECT_EQ(reading(path("sub.pro")), path("sub.pro") + ": Is a directory");
    const std::string large = path("large.toml"), scene = "[[instance]]\nfile = 'statue.pro'\n#";
    std::ofstream(large) << scene << std::string((std::size_t{1} << 20) - scene.size(), ' ');
    EXPECT_EQ(reading(large), "");
    std::ofstream(large, std::ios::app) << ' ';
    EXPECT_EQ(reading(large), large + ": a scene file has at most 1 MiB");
}

std::string exampleText() {
    std::ifstream file(POINTRT_EXAMPLE_SCENE);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// text with one thing changed, as a slip of the hand or ill will might.
std::string mutated(std::string text, std::mt19937& random) {
    static const char* const pieces[] = {
        "1e308", "-1e308", "1e-320",  "nan", "-inf", "0",    "-1",   "9223372036854775807",
        "[",     "]",      "{",       "}",   "\"",   "'",    "=",    ".",
        "\n",    "#",      ",",       "[[",  "]]",   "\0",   "\xff", "\xef\xbb\xbf",
        "'''",   "\"\"\"", "\\u0000", "[]",  "{}",   "true", "\r",   "2026-06-21T18:30:00Z"};
    auto below = [&](std::size_t end) { return end ? random() % end : 0; };
    const std::size_t at = below(text.size()), count = below(std::min<std::size_t>(40, text.size() - at));
    const std::string piece = pieces[below(std::size(pieces))];
    const std::size_t number = text.find_first_of("0123456789", at);
    switch (below(6)) {
    case 0:
        return text.erase(at, count);
    case 1:
        return text.insert(at, piece);
    case 2:
        return text.replace(at, count, piece);
    case 3:
        return text.insert(below(text.size()), text.substr(at, count));
    case 4:
        text[at] = static_cast<char>(random());
        return text;
    default:
        return number == std::string::npos ? text : text.replace(number, 1, piece);
    }
}

TEST_F(SceneFile, SurvivesMutations) {
    const std::string example = exampleText();
    ASSERT_EQ(refusal(example), "");
    std::mt19937 random(1);
    int parsed = 0;
    constexpr int tries = 4000;
    for (int i = 0; i < tries; ++i) {
        std::string text = mutated(example, random);
        for (unsigned more = random() % 3; more > 0; --more) text = mutated(text, random);
        if (refusal(text).empty()) ++parsed; // anything but an Error ends the test
    }
    // both ends of the road were walked
    EXPECT_GT(parsed, tries / 50);
    EXPECT_LT(parsed, tries * 9 / 10);
}

TEST_F(SceneFile, RefusesIntegersBeyondDoublePrecision) {
    EXPECT_EQ(refusal("[camera]\nfov = 9223372036854775807"),
              "scene.toml:2: key \"camera.fov\": is 9.223372037e+18, must be from 0.001 to 179.999");
}

TEST_F(SceneFile, RefusesDuplicateViewNames) {
    EXPECT_EQ(refusal("[[view]]\nname = 'a'\n[[view]]\nname = 'a'"),
              "scene.toml:4: key \"view[1].name\": is also the name of another view");
    EXPECT_EQ(refusal("[[view]]\nfov = 30"), "scene.toml:1: key \"view[0]\": \"name\" is missing");
}

TEST_F(SceneFile, RefusesMatricesOtherThanRotations) {
    const auto rotated = [&](const std::string& matrix) {
        return refusal("[[instance]]\nfile='statue.pro'\nrotate={ matrix=" + matrix + " }");
    };
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, 1.1]]").find("rows of length 1"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0.6, 0.8, 0], [0, 0, 1]]").find("right angles"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, -1]]").find("right-handed"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0]]").find("3 vectors"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, 1]], degrees=1").find("excludes"), std::string::npos);
}

TEST_F(SceneFile, RefusesAxesThatDoNotFitTheShape) {
    const auto shape = [&](const std::string& type, const std::string& axes) {
        return refusal("[[shape]]\ntype='" + type + "'\ncenter=[0, 0, 0]\naxes=" + axes);
    };
    EXPECT_NE(shape("box", "[[1, 0, 0], [1, 1, 0], [0, 0, 1]]").find("right angles"), std::string::npos);
    EXPECT_NE(shape("box", "[[1, 0, 0], [0, 0, 0], [0, 0, 1]]").find("length zero"), std::string::npos);
    EXPECT_NE(shape("quad", "[[1, 0, 0], [0, 3, 0], [0, 0, 2]]").find("1 long"), std::string::npos);
    EXPECT_NE(shape("disc", "[[1, 0, 0], [0, 3, 0], [0, 0, 1]]").find("first two"), std::string::npos);
    EXPECT_NE(shape("sphere", "[[2, 0, 0], [0, 2, 0], [0, 0, 1]]").find("the radius"), std::string::npos);
    EXPECT_NE(shape("sphere", "[[2, 0, 0], [0, 2, 0], [0, 0, 2]]\nradius=2").find("excludes"), std::string::npos);
    EXPECT_NE(refusal("[[shape]]\ntype='plane'\npoint=[0, 0, 0]\nnormal=[0, 1, 0]\ncenter=[0, 0, 0]").find("center"),
              std::string::npos);
}

} // namespace
} // namespace pointrt
