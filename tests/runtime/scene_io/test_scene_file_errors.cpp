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
#include "tests/support/says.h"

namespace pointrt {
namespace {

TEST_F(SceneFile, SuggestsTheNearestKey) {
    EXPECT_SAYS(refusal("[material.a]\n\ncolour = [1, 1, 1]"),
                "scene.toml:3: key \"material.a.colour\": *\"colour\"*\"color\"");
    EXPECT_SAYS(refusal("[[light]]\n[[light]]\n"), "scene.toml:1: key \"light[0]\": \"type\" *missing");
    EXPECT_SAYS(refusal("[[lihgt]]"), "scene.toml:1: key \"lihgt\": *\"lihgt\"*\"light\"");
    EXPECT_SAYS(
        refusal("[material.a]\nkind = 'metal'\nindex = 2"),
        "scene.toml:3: key \"material.a.index\": *\"index\"*\"metal\" *kind, color, splat_color, emission, roughness");
    EXPECT_SAYS(
        refusal("[render]\nroom = 'none'"),
        "scene.toml:2: key \"render.room\": *\"room\"*render *integrator, bounces, spp, size, seed, denoise, exposure, "
        "lights, shadows, caustics, blend, reflectivity, color_by, color_map, color_range, legend, detail, "
        "relight");
    EXPECT_SAYS(refusal("[material.gold]\n[[instance]]\nfile = 'statue.pro'\nmaterial = 'godl'"),
                "scene.toml:4: key \"instance[0].material\": *[material.godl]*\"gold\"");
}

TEST_F(SceneFile, RefusesWrongTypes) {
    EXPECT_SAYS(refusal("[camera]\neye = 1"), "scene.toml:2: key \"camera.eye\": *list*3");
    EXPECT_SAYS(refusal("[camera]\neye = [1, 2]"), "scene.toml:2: key \"camera.eye\": *list*3");
    EXPECT_SAYS(refusal("[camera]\neye = [1,\n2,\n'3']"), "scene.toml:4: key \"camera.eye[2]\": *number");
    EXPECT_SAYS(refusal("camera = 3"), "scene.toml:1: key \"camera\": *table");
    EXPECT_SAYS(refusal("[light]"), "scene.toml:1: key \"light\": *tables*[[light]]");
    EXPECT_SAYS(refusal("light = [1]"), "scene.toml:1: key \"light[0]\": *table");
    EXPECT_SAYS(refusal("material.a = 1"), "scene.toml:1: key \"material.a\": *table*[material.NAME]");
    EXPECT_SAYS(refusal("[render]\nspp = 1.5"), "scene.toml:2: key \"render.spp\": *integer*1 *65536");
    EXPECT_SAYS(refusal("[render]\nsize = [1]"), "scene.toml:2: key \"render.size\": *[width, height]");
    EXPECT_SAYS(refusal("[material.a]\nsplat_color = 1"), "scene.toml:2: key \"material.a.splat_color\": *true *false");
    EXPECT_SAYS(refusal("[material.a]\ncolor = 1"),
                "scene.toml:2: key \"material.a.color\": *[red, green, blue]*\"#rrggbb\"");
    EXPECT_SAYS(refusal("[material.a]\ncolor = 'ff0000'"),
                "scene.toml:2: key \"material.a.color\": \"ff0000\" *\"#ff8000\"");
    EXPECT_SAYS(refusal("[material.a]\ncolor = '#ff-100'"),
                "scene.toml:2: key \"material.a.color\": \"#ff-100\" *\"#ff8000\"");
    EXPECT_SAYS(refusal("room = 1"), "scene.toml:1: key \"room\": *string");
    EXPECT_SAYS(refusal("room = ''"), "scene.toml:1: key \"room\": *empty");
    EXPECT_SAYS(refusal("room = 'cellar'"), "scene.toml:1: key \"room\": \"cellar\" *none, mirror, matte");
    EXPECT_SAYS(refusal("background = 1"), "scene.toml:1: key \"background\": *string");
    EXPECT_SAYS(refusal("background = 'grey'"),
                "scene.toml:1: key \"background\": \"grey\" *black, white, transparent *#ff8000");
    EXPECT_SAYS(refusal("[material.\"a\\nb\"]"), "scene.toml:1: key \"material.a\\nb\": *name");
}

TEST_F(SceneFile, RefusesMeasurementsOfTooFewPoints) {
    EXPECT_SAYS(refusal("[[measure]]"), "scene.toml:1: key \"measure[0]\": \"points\" *missing");
    EXPECT_SAYS(refusal("[[measure]]\npoints = [[0, 0, 0]]"), "scene.toml:2: key \"measure[0].points\": *two points");
    EXPECT_SAYS(refusal("[[measure]]\nclosed = true\npoints = [[0, 0, 0], [1, 0, 0]]"),
                "scene.toml:3: key \"measure[0].points\": *three points");
    EXPECT_SAYS(refusal("[[measure]]\npoints = [[0, 0, 0], [1, inf, 0]]"),
                "scene.toml:2: key \"measure[0].points[1][1]\": *inf");
    EXPECT_SAYS(refusal("[[measure]]\npoints = 'here'"), "scene.toml:2: key \"measure[0].points\": *list");
    EXPECT_SAYS(refusal("[[measure]]\npoints = [[0, 0, 0], [1, 0, 0]]\nlength = 1"),
                "scene.toml:3: key \"measure[0].length\": *measurement *points, closed, visible, name, locked");
}

TEST_F(SceneFile, RefusesClipsThatCutNothingOrAll) {
    EXPECT_SAYS(refusal("[[clip]]"), "scene.toml:1: key \"clip[0]\": \"type\" *missing");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'ball'"), "scene.toml:2: key \"clip[0].type\": \"ball\" *box, plane");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'box'\nmin = [0, 0, 0]"), "scene.toml:1: key \"clip[0]\": \"max\" *missing");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'box'\nmin = [0, 0, 0]\nmax = [1, 0, 1]"),
                "scene.toml:4: key \"clip[0].max\": *\"min\"");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'box'\nmin = [0, nan, 0]\nmax = [1, 1, 1]"),
                "scene.toml:3: key \"clip[0].min[1]\": *nan");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 0, 0]"),
                "scene.toml:4: key \"clip[0].normal\": *zero");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'plane'\nmin = [0, 0, 0]"),
                "scene.toml:3: key \"clip[0].min\": *\"min\"*plane *type, enabled, name, locked, point, normal");
    EXPECT_SAYS(refusal("[[clip]]\ntype = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nenabled = 1"),
                "scene.toml:5: key \"clip[0].enabled\": *true *false");
    std::string boxes;
    for (int box = 0; box < 6; ++box) boxes += "[[clip]]\ntype = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n";
    EXPECT_SAYS(refusal(boxes), "scene.toml:21: key \"clip[5]\": *32");
    EXPECT_SAYS(refusal("[[filter]]\nvalues = [2]"), "scene.toml:1: key \"filter[0]\": \"attribute\" *missing");
    EXPECT_SAYS(refusal("[[filter]]\nattribute = 'class'\nvalues = []"),
                "scene.toml:3: key \"filter[0].values\": *list of numbers");
    EXPECT_SAYS(refusal("[[filter]]\nattribute = 'class'\nrange = [3, 2]"), "scene.toml:3: key \"filter[0].range*");
    EXPECT_SAYS(refusal("[[filter]]\nattribute = 'class'\nvalues = [2]\nrange = [1, 2]"),
                "scene.toml:4: key \"filter[0].range\": *\"values\"");
    EXPECT_SAYS(refusal("[[instance]]\nfile = 'statue.pro'\nclip = 'no'"),
                "scene.toml:3: key \"instance[0].clip\": *true *false");
}

TEST_F(SceneFile, RefusesNumbersOutOfRange) {
    EXPECT_SAYS(refusal("[camera]\nfov = 180"), "scene.toml:2: key \"camera.fov\": *180*0.001 *179.999");
    EXPECT_SAYS(refusal("[camera]\nfov = nan"), "scene.toml:2: key \"camera.fov\": *nan*0.001 *179.999");
    EXPECT_SAYS(refusal("[camera]\northo = 0"), "scene.toml:2: key \"camera.ortho\": *0*1e-09 *1e+12");
    for (const char* text : {"true", "'all'"})
        EXPECT_SAYS(refusal(std::string("[camera]\northo = ") + text),
                    "scene.toml:2: key \"camera.ortho\": *height*\"fit\"");
    EXPECT_SAYS(refusal("[camera]\nfov = 30\northo = 2"),
                "scene.toml:3: key \"camera.ortho\": cannot be combined with \"fov\"");
    EXPECT_SAYS(refusal("[camera]\neye = [0, inf, 0]"), "scene.toml:2: key \"camera.eye[1]\": *inf*-1e+12 *1e+12");
    EXPECT_SAYS(refusal("[render]\nbounces = -1"), "scene.toml:2: key \"render.bounces\": *integer*0 *64");
    EXPECT_SAYS(refusal("[render]\nsize = [16385, 1]"), "scene.toml:2: key \"render.size[0]\": *integer*1 *16384");
    EXPECT_SAYS(refusal("[material.a]\ncolor = [0, 0, 1.1]"), "scene.toml:2: key \"material.a.color[2]\": *1.1*0 *1");
    EXPECT_SAYS(refusal("[material.a]\nemission = [0, 0, -1]"),
                "scene.toml:2: key \"material.a.emission[2]\": *-1*0 *1e+12");
    EXPECT_SAYS(refusal("[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 0"),
                "scene.toml:4: key \"shape[0].radius\": *0*1e-09 *1e+12");
    EXPECT_SAYS(refusal("[[light]]\ntype = 'spot'\nposition = [0, 0, 0]\ntarget = [0, 1, 0]\nouter = 20\ninner = 21"),
                "scene.toml:6: key \"light[0].inner\": *21*0 *20");
}

TEST_F(SceneFile, RefusesBrokenGeometry) {
    EXPECT_SAYS(refusal("up = [0, 0, 0]"), "scene.toml:1: key \"up\": *zero");
    EXPECT_SAYS(refusal("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]"),
                "scene.toml:3: key \"camera.target\": *\"eye\"");
    EXPECT_SAYS(refusal("[[instance]]\nfile = 'statue.pro'\nscale = [1, 2, 1]"),
                "scene.toml:3: key \"instance[0].scale\": *axes");
    EXPECT_SAYS(
        refusal("[[instance]]\nfile = 'statue.pro'\nrotate = [{axis = [1, 0, 0], degrees = 9},\n{axis = [0, 0, 0], "
                "degrees = 1}]"),
        "scene.toml:4: key \"instance[0].rotate[1].axis\": *zero");
    EXPECT_SAYS(refusal("[[instance]]\nfile = 'statue.pro'\nrotate = {axis = [1, 0, 0]}"),
                "scene.toml:3: key \"instance[0].rotate\": \"degrees\" *missing");
    EXPECT_SAYS(refusal("[[shape]]\ntype = 'quad'\ncenter = [0, 0, 0]\nu = [1, 0, 0]\nv = [0.1, 1, 0]"),
                "scene.toml:5: key \"shape[0].v\": *right angles*\"u\"");
    EXPECT_SAYS(refusal("[[shape]]\ntype = 'box'\nmin = [0, 0, 0]\nmax = [1, 0, 1]"),
                "scene.toml:4: key \"shape[0].max\": *above \"min\"");
    EXPECT_EQ(refusal("[[shape]]\ntype = 'box'\ncenter = [0, 0, 0]\nsize = [1, 1, 1]\nmax = [1, 0, 1]"),
              "scene.toml:5: key \"shape[0].max\": cannot be combined with \"center\"");
    EXPECT_SAYS(refusal("[[shape]]\ntype = 'box'\nsize = [1, 1, 1]"),
                "scene.toml:3: key \"shape[0].size\": *effect*\"center\"");
    EXPECT_SAYS(refusal("[[light]]\ntype = 'spot'\nposition = [1, 0, 0]\ntarget = [1, 0, 0]"),
                "scene.toml:4: key \"light[0].target\": *\"position\"");
}

TEST_F(SceneFile, RefusesInvalidMaterials) {
    EXPECT_SAYS(refusal("[material.a]\nkind = 'wood'"),
                "scene.toml:2: key \"material.a.kind\": \"wood\" *matte, metal, plastic, mirror, glass");
    const std::string glass = "[material.a]\nkind = 'glass'\n";
    EXPECT_SAYS(refusal(glass + "tint = [1, 1, 0]"), "scene.toml:3: key \"material.a.tint\": *above 0");
    EXPECT_EQ(refusal(glass + "tint = [1, 1, 1]\nabsorption = [1, 1, 1]"),
              "scene.toml:4: key \"material.a.absorption\": cannot be combined with \"tint\"");
    EXPECT_SAYS(refusal(glass + "tint_distance = 1"),
                "scene.toml:3: key \"material.a.tint_distance\": *effect*\"tint\"");
    EXPECT_SAYS(refusal(glass + "thin = true\nabsorption = [1, 1, 1]"),
                "scene.toml:4: key \"material.a.absorption\": *thin*\"color\"");
    EXPECT_SAYS(refusal("[material.a]\n[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 'a'"),
                "scene.toml:6: key \"shape[0].material\": *\"color\"");
    const std::string instance =
        "[material.a]\n[[instance]]\nfile = 'statue.pro'\n[[instance.override]]\nmaterial = 'a'\n";
    EXPECT_SAYS(refusal(instance),
                "scene.toml:4: key \"instance[0].override[0]\": \"row\", \"colors\" *\"attribute\" *missing");
    EXPECT_EQ(refusal(instance + "row = 1\ncolors = []"),
              "scene.toml:7: key \"instance[0].override[0].colors\": cannot be combined with \"row\"");
    EXPECT_SAYS(refusal(instance + "colors = ['#000001', '#ffff00']"),
                "scene.toml:6: key \"instance[0].override[0].colors\": *range");
}

TEST_F(SceneFile, RefusesInvalidAttributeOverrides) {
    const std::string over = "[material.a]\n[[instance]]\nfile = 'statue.pro'\n[[instance.override]]\nmaterial = 'a'\n";
    const std::string place = "scene.toml:6: key \"instance[0].override[0].", by_class = over + "attribute = 'class'\n";
    EXPECT_SAYS(refusal(over + "values = [1]"), place + "values\": *effect*\"attribute\"");
    EXPECT_EQ(refusal(over + "row = 1\nattribute = 'class'"), place + "row\": cannot be combined with \"attribute\"");
    EXPECT_SAYS(refusal(by_class), "scene.toml:4: key \"instance[0].override[0]\": \"values\" *\"range\" *missing");
    const std::string next = "scene.toml:7: key \"instance[0].override[0].";
    EXPECT_SAYS(refusal(by_class + "values = []"), next + "values\": *list");
    EXPECT_SAYS(refusal(by_class + "values = ['a']"), next + "values[0]\": *number");
    EXPECT_SAYS(refusal(by_class + "range = [2, 2]"), next + "range\": *lower");
    EXPECT_SAYS(refusal(by_class + "range = [1, 2, 3]"), next + "range\": *list*2");
    EXPECT_SAYS(refusal("up = 'Z'"), "scene.toml:1: key \"up\": \"Z\" *[0, 0, 1]*auto, x, y, z, -x, -y, -z");
    EXPECT_SAYS(refusal("[render]\ncolor_map = 'jet'"),
                "scene.toml:2: key \"render.color_map\": \"jet\" *viridis, "
                "magma, inferno, plasma, cividis, turbo, coolwarm, grey, classes, scans");
}

TEST_F(SceneFile, RefusesInvalidLights) {
    const std::string point = "[[light]]\ntype = 'point'\nposition = [0, 0, 0]\n", sun = "[[light]]\ntype = 'sun'\n";
    EXPECT_SAYS(refusal(point), "scene.toml:1: key \"light[0]\": \"intensity\" *\"power\" *missing");
    EXPECT_EQ(refusal(point + "power = 1\nintensity = 1"),
              "scene.toml:4: key \"light[0].power\": cannot be combined with \"intensity\"");
    EXPECT_SAYS(refusal(point + "intensity = [1, 1, 1]\ncolor = [1, 1, 1]"),
                "scene.toml:5: key \"light[0].color\": \"intensity\" *colour");
    EXPECT_SAYS(refusal(sun), "scene.toml:1: key \"light[0]\": \"towards\" *\"time\" *missing");
    EXPECT_SAYS(refusal(sun + "towards = [0, 1, 0]\nnorth = [1, 0, 0]"),
                "scene.toml:4: key \"light[0].north\": *effect*\"time\"");
    const std::string zero = sun + "latitude = 0\nlongitude = 0\nirradiance = 1\n";
    const std::string wants_offset = "scene.toml:6: key \"light[0].time\": *2026-06-21T18:30:00+02:00";
    for (const char* time : {"2026-06-21", "12:00:00", "2026-06-21T12:00:00", "'noon'", "7"})
        EXPECT_SAYS(refusal(zero + "time = " + time), wants_offset);
    EXPECT_SAYS(refusal(zero + "time = 1899-06-21T12:00:00Z"), "scene.toml:6: key \"light[0].time\": *1900 *2100");
    // Midnight on the equator at the solstice: 90 degrees minus the ecliptic's 23.44.
    EXPECT_SAYS(refusal(zero + "time = 2024-06-21T00:00:00Z"), "scene.toml:6: key \"light[0].time\": *66.6 *below");
    EXPECT_SAYS(refusal("up = [0, 1, 0]\n" + zero + "time = 2024-03-20T12:00:00Z\nnorth = [0, 1, 0]"),
                "scene.toml:8: key \"light[0].north\": *along*\"up\"");
}

TEST_F(SceneFile, RefusesMissingFiles) {
    EXPECT_SAYS(refusal("[[instance]]"), "scene.toml:1: key \"instance[0]\": \"file\" *missing");
    EXPECT_SAYS(refusal("\n[[instance]]\nfile = 'gone.pro'"),
                "scene.toml:3: key \"instance[0].file\": *\"" + path("gone.pro") + "\"");
    const std::string deep = std::string(100, 'a') + "/gone.pro";
    EXPECT_HAS(refusal("\n[[instance]]\nfile = '" + deep + "'"), path(deep.c_str()));
    EXPECT_SAYS(refusal("[[instance]]\nfile = 'sub.pro'"),
                "scene.toml:2: key \"instance[0].file\": *\"" + path("sub.pro") + "\"");
    EXPECT_SAYS(refusal("[[instance]]\nfile = \"statue.pro\\u0000\""),
                "scene.toml:2: key \"instance[0].file\": *control");
    EXPECT_SAYS(refusal("[sky]\nimage = 'statue.pro'"), "scene.toml:2: key \"sky.image\": *.hdr *.exr");
    EXPECT_EQ(refusal("[sky]\nimage = 'sky.hdr'\ncolor = [1, 1, 1]"),
              "scene.toml:3: key \"sky.color\": cannot be combined with \"image\"");
    EXPECT_SAYS(refusal("[sky]\nrotation = 1"), "scene.toml:2: key \"sky.rotation\": *effect*\"image\"");
    EXPECT_SAYS(refusal(""), "scene.toml:1: *[[instance]] *[[shape]]");
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
    EXPECT_SAYS(refusal(repeated(instance, 255)), "scene.toml:509: key \"instance[254]\": *254 instances");
    const std::string shape = "[[shape]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\n";
    const std::string lamp = "[[light]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nradiance = 1\n";
    EXPECT_EQ(parse(repeated(shape, 32) + repeated(lamp, 32)).lights.size(), 32u);
    EXPECT_SAYS(refusal(repeated(shape, 33) + repeated(lamp, 32)), "scene.toml:288: key \"light[31]\": *64 shapes");
    EXPECT_SAYS(refusal(repeated(shape, 1) + repeated(lamp, 33)), "scene.toml:165: key \"light[32]\": *32 lights");
    EXPECT_SAYS(refusal(repeated(lamp, 32) + shape + "[sky]\nimage = 'sky.hdr'\n"),
                "scene.toml:166: key \"sky.image\": *light*32");
    std::string materials;
    for (int i = 100; i < 357; ++i) materials += "[material.m" + std::to_string(i) + "]\n";
    EXPECT_SAYS(refusal(materials), "scene.toml:257: key \"material.m356\": *256 materials");
    const std::string range = "[[instance.override]]\ncolors = ['#000000', '#000000']\nmaterial = 'a'\n";
    EXPECT_EQ(parse("[material.a]\n" + instance + repeated(range, 8)).instances[0].overrides.size(), 8u);
    EXPECT_SAYS(refusal("[material.a]\n" + instance + repeated(range, 9)),
                "scene.toml:28: key \"instance[0].override[8]\": *8 *ranges");
}

TEST_F(SceneFile, ReportsTheLineOfInvalidToml) {
    EXPECT_EQ(refusal("up = [0,\n1,\n0\nroom = 'none'").substr(0, 14), "scene.toml:4: ");
    EXPECT_EQ(refusal("a = 1\na = 2").substr(0, 14), "scene.toml:2: ");
    EXPECT_EQ(refusal("\n\nup = [1e999, 0, 0]").substr(0, 14), "scene.toml:3: ");
    EXPECT_EQ(refusal("\nroom = \"\xff\"").substr(0, 14), "scene.toml:2: ");
}

// toml++ assumes that these are never looked up in its tables of white space (runtime/scene_io/toml_defined.h).
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
    EXPECT_SAYS(refusal(std::string("\n") + repeated("a.", deep) + "a = 1"), "scene.toml:2: *64 dots");
    EXPECT_SAYS(refusal(std::string("[") + repeated("a . ", deep) + "a]"), "scene.toml:1: *64 dots");
    // as deep as both limits allow
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
    EXPECT_SAYS(reading(large), large + ": *1 MiB");
}

std::string exampleText() {
    std::ifstream file(POINTRT_EXAMPLE_SCENE);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// text with one random change.
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
    // both outcomes must occur often
    EXPECT_GT(parsed, tries / 50);
    EXPECT_LT(parsed, tries * 9 / 10);
}

TEST_F(SceneFile, RefusesIntegersBeyondDoublePrecision) {
    EXPECT_SAYS(refusal("[camera]\nfov = 9223372036854775807"),
                "scene.toml:2: key \"camera.fov\": *9.223372037e+18*0.001 *179.999");
}

TEST_F(SceneFile, RefusesDuplicateViewNames) {
    EXPECT_SAYS(refusal("[[view]]\nname = 'a'\n[[view]]\nname = 'a'"), "scene.toml:4: key \"view[1].name\": *another");
    EXPECT_SAYS(refusal("[[view]]\nfov = 30"), "scene.toml:1: key \"view[0]\": \"name\" *missing");
}

TEST_F(SceneFile, RefusesMatricesOtherThanRotations) {
    const auto rotated = [&](const std::string& matrix) {
        return refusal("[[instance]]\nfile='statue.pro'\nrotate={ matrix=" + matrix + " }");
    };
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, 1.1]]").find("rows of length 1"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0.6, 0.8, 0], [0, 0, 1]]").find("perpendicular"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, -1]]").find("right-handed"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0]]").find("3 vectors"), std::string::npos);
    EXPECT_NE(rotated("[[1, 0, 0], [0, 1, 0], [0, 0, 1]], degrees=1").find("cannot be combined"), std::string::npos);
}

TEST_F(SceneFile, RefusesAxesThatDoNotFitTheShape) {
    const auto shape = [&](const std::string& type, const std::string& axes) {
        return refusal("[[shape]]\ntype='" + type + "'\ncenter=[0, 0, 0]\naxes=" + axes);
    };
    EXPECT_NE(shape("box", "[[1, 0, 0], [1, 1, 0], [0, 0, 1]]").find("perpendicular"), std::string::npos);
    EXPECT_NE(shape("box", "[[1, 0, 0], [0, 0, 0], [0, 0, 1]]").find("length zero"), std::string::npos);
    EXPECT_NE(shape("quad", "[[1, 0, 0], [0, 3, 0], [0, 0, 2]]").find("length"), std::string::npos);
    EXPECT_NE(shape("disc", "[[1, 0, 0], [0, 3, 0], [0, 0, 1]]").find("first two"), std::string::npos);
    EXPECT_NE(shape("sphere", "[[2, 0, 0], [0, 2, 0], [0, 0, 1]]").find("the radius"), std::string::npos);
    EXPECT_NE(shape("sphere", "[[2, 0, 0], [0, 2, 0], [0, 0, 2]]\nradius=2").find("cannot be combined"),
              std::string::npos);
    EXPECT_NE(refusal("[[shape]]\ntype='plane'\npoint=[0, 0, 0]\nnormal=[0, 1, 0]\ncenter=[0, 0, 0]").find("center"),
              std::string::npos);
}

} // namespace
} // namespace pointrt
