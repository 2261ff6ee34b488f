// SPDX-License-Identifier: Apache-2.0
// Hostile set.json files: each rule has a set that breaks it, and no bytes crash, hang or exhaust memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "small_set.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using Json = nlohmann::ordered_json;

std::string goldenText() {
    std::ifstream in(std::string(POINTRT_SET_GOLDEN) + "/set.json", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct HostileSet : testing::Test {
    test::TemporaryFolder folder;

    /// "" if the set can be read, else the error without the file's name.
    std::string faultOf(const std::string& text) {
        const std::string path = "a.proset/set.json";
        try {
            parseTileSet(text, path);
            return "";
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            const std::string line = error.what();
            EXPECT_EQ(line.find('\n'), std::string::npos);
            EXPECT_TRUE(line.starts_with(path + ": ")) << line;
            return line.substr(std::min(line.size(), path.size() + 2));
        }
    }

    std::string faultOfChange(const std::function<void(Json&)>& change) {
        Json json = Json::parse(goldenText());
        change(json);
        return faultOf(json.dump());
    }
};

TEST_F(HostileSet, EveryMemberIsRequired) {
    const Json golden = Json::parse(goldenText());
    for (const auto& [key, value] : golden.items()) {
        EXPECT_SAYS(faultOfChange([&](Json& json) { json.erase(key); }), key + " *missing");
        const std::string wrong = faultOfChange([&](Json& json) { json[key] = "?"; });
        EXPECT_EQ(wrong.empty(), key == "crs") << key;
    }
    for (const char* list : {"tiles", "levels", "attributes"})
        for (const auto& [key, value] : golden[list][1].items()) {
            const std::string place = std::string(list) + "[1]: ";
            EXPECT_SAYS(faultOfChange([&](Json& json) { json[list][1].erase(key); }), place + key + " *missing");
            const std::string wrong = faultOfChange([&](Json& json) { json[list][1][key] = Json::array({1}); });
            EXPECT_SAYS(wrong, place + key + " ");
        }
}

TEST_F(HostileSet, UnknownMembersAreIgnored) {
    EXPECT_EQ(faultOfChange([](Json& json) {
                  json["later"] = {{"a", {1, 2, {{"b", 3}}}}};
                  json["tiles"][2]["later"] = {1, 2, 3};
                  json["levels"][0]["later"] = "word";
              }),
              "");
}

TEST_F(HostileSet, GaussiansIsAFlagThatMayBeMissing) {
    EXPECT_SAYS(faultOfChange([](Json& json) { json["gaussians"] = 1; }), "gaussians *true");
    EXPECT_EQ(faultOfChange([](Json& json) { json["gaussians"] = true; }), "");
}

TEST_F(HostileSet, OtherVersionsAndFormatsAreRefused) {
    EXPECT_SAYS(faultOfChange([](Json& json) { json["version"] = 2; }), "version 2, *1");
    EXPECT_SAYS(faultOfChange([](Json& json) { json["version"] = 1.5; }), "version *whole number");
    EXPECT_SAYS(faultOfChange([](Json& json) { json["format"] = "3tz"; }), "format *\"pointrt tile set\"");
    // The version is checked first: in files of a later version, tiles may be different.
    EXPECT_TRUE(faultOfChange([](Json& json) {
                    json["version"] = 3;
                    json["tiles"] = 7;
                }).starts_with("version 3, "));
}

/// A defect of a set, and the error that it gives.
struct Fault {
    const char* said;
    std::function<void(TileSet&)> make;
};

/// A defect for each rule of findTileSetFault, in its order. They are made after the sums of the set are computed.
const std::vector<Fault> kFaults = {
    {"lattice: origin ", [](TileSet& set) { set.lattice_origin[1] = 2e30; }},
    {"lattice: edge *1e-30", [](TileSet& set) { set.edge = 0; }},
    {"lattice: edge *1e-30", [](TileSet& set) { set.edge = -1; }},
    {"lattice: edge *levels", [](TileSet& set) { set.edge = 0.9e30; }},
    {"levels: *32", [](TileSet& set) { set.levels.clear(); }},
    {"levels: *32", [](TileSet& set) { set.levels.resize(33, set.levels[0]); }},
    {"up: *length",
     [](TileSet& set) {
         set.up = {0, 0, 1.1};
     }},
    {"metres: ", [](TileSet& set) { set.metres = -1; }},
    {"noise: ", [](TileSet& set) { set.noise = -0.5; }},
    {"input_points: ", [](TileSet& set) { set.input_points = 1ull << 60; }},
    {"sensors[1]: ", [](TileSet& set) { set.sensors[1][0] = 1; }},
    {"sensors[0]: ", [](TileSet& set) { set.sensors[0][3] = 2; }},
    {"settings: *object", [](TileSet& set) { set.settings = "[1]"; }},
    {"settings: *object", [](TileSet& set) { set.settings = "{"; }},
    {"levels[1]: radius_max ", [](TileSet& set) { set.levels[1].radius_max = 0.2; }},
    {"levels[1]: radius_max ", [](TileSet& set) { set.levels[1].radius_max = 0.1; }},
    {"levels[0]: radius_max ", [](TileSet& set) { set.levels[0].radius_max = 0; }},
    {"levels[2]: radius_step ", [](TileSet& set) { set.levels[2].radius_step = 1.5; }},
    {"attributes[0]: *name", [](TileSet& set) { set.attributes[0].name = std::string(32, 'a'); }},
    {"attributes[0]: *name", [](TileSet& set) { set.attributes[0].name = "a\nb"; }},
    {"attributes[1]: *type", [](TileSet& set) { set.attributes[1].type = 11; }},
    {"attributes[1]: components ", [](TileSet& set) { set.attributes[1].components = 5; }},
    {"attributes[1]: low and high ", [](TileSet& set) { set.attributes[1].high = -2; }},
    {"attributes: gps_time *twice", [](TileSet& set) { set.attributes[0].name = "gps_time"; }},
    {"attributes: *32", [](TileSet& set) { set.attributes.resize(33, set.attributes[0]); }},
    {"tiles: *2^20", [](TileSet& set) { set.tiles.clear(); }},
    {"tiles[3] 3-0-1-0: level ", [](TileSet& set) { set.tiles[3].level = 3; }},
    {"tiles[3] 1-0-1-0: splats ", [](TileSet& set) { set.tiles[3].splats = 0; }},
    {"tiles[3] 1-0-1-0: splats ", [](TileSet& set) { set.tiles[3].splats = 61; }},
    {"tiles[3] 1-0-1-0: stored ", [](TileSet& set) { set.tiles[3].stored = 1ull << 32; }},
    {"tiles[3] 1-0-1-0: bytes ", [](TileSet& set) { set.tiles[3].bytes = 4095; }},
    {"tiles[3] 1-0-1-0: error *range", [](TileSet& set) { set.tiles[3].error = -1; }},
    {"tiles[3] 1-0-1-0: spacing ", [](TileSet& set) { set.tiles[3].spacing = 1e31; }},
    {"tiles[2] 1-0-0-0: *twice",
     [](TileSet& set) {
         set.tiles[2].cell = {0, 0, 0};
     }},
    {"tiles[3] 1-1-0-0: *Morton", [](TileSet& set) { std::swap(set.tiles[2], set.tiles[3]); }},
    {"tiles[0] 1-0-0-0: *not*highest", [](TileSet& set) { set.tiles.erase(set.tiles.begin()); }},
    {"tiles[1] 2-0-0-1: *second",
     [](TileSet& set) {
         set.tiles[1].level = 2;
         set.tiles[1].cell = {0, 0, 1};
     }},
    {"tiles[8] 0-5-5-5: *parent",
     [](TileSet& set) {
         set.tiles[8].cell = {5, 5, 5};
     }},
    {"tiles[4] 1-3-3-3: *parent",
     [](TileSet& set) {
         set.tiles[4].cell = {3, 3, 3};
     }},
    {"tiles[1] 1-0-0-0: error *parent", [](TileSet& set) { set.tiles[0].error = 0.0625; }},
    {"tiles[1] 1-0-0-0: has children*error", [](TileSet& set) { set.tiles[1].error = 0; }},
    {"tiles[2] 1-1-0-0: *children*error", [](TileSet& set) { set.tiles[2].error = 0.25; }},
    {"tiles: tiles/1-0-0-0.pro ", [](TileSet& set) { set.tiles[2].file = set.tiles[1].file; }},
    {"levels[1]: tiles ", [](TileSet& set) { ++set.levels[1].tiles; }},
    {"levels[1]: splats ", [](TileSet& set) { --set.levels[1].splats; }},
    {"levels[1]: error ", [](TileSet& set) { set.levels[1].error = 0.25; }},
    {"levels[0]: *no tiles",
     [](TileSet& set) {
         set.tiles.resize(5);
         set.tiles[1].error = 0;
     }},
    {"tiles[0] 2-0-0-0: *not*highest", [](TileSet& set) { set.levels.resize(4, set.levels[0]); }},
    {"splats: *sum", [](TileSet& set) { set.splats += 80; }},
    {"bounds: *order", [](TileSet& set) { set.bounds_min[0] = set.bounds_max[0] + 1; }},
    {"bounds: *inside", [](TileSet& set) { set.bounds_max[2] = 465; }},
};

TEST_F(HostileSet, EveryRuleHasASetThatBreaksIt) {
    ASSERT_EQ(findTileSetFault(test::smallSet()), "");
    writeTileSet(test::smallSet(), folder.path);
    for (const Fault& fault : kFaults) {
        TileSet set = test::smallSet();
        fault.make(set);
        EXPECT_SAYS(findTileSetFault(set), fault.said);
        try {
            writeTileSet(set, folder.path);
            ADD_FAILURE() << "written: " << fault.said;
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kCannotRun);
        }
        EXPECT_EQ(readTileSet(folder.path).tiles.size(), 9u) << "the good one stays";
    }
}

TEST_F(HostileSet, SetsAreCheckedAfterReading) {
    EXPECT_SAYS(faultOfChange([](Json& json) { json["tiles"][4]["error"] = 0.25; }),
                "tiles[4] 1-1-1-0: *children*error");
    EXPECT_SAYS(faultOfChange([](Json& json) { json["attributes"][0]["type"] = "uint17"; }), "attributes[0]: *type");
}

TEST_F(HostileSet, ValuesOfOtherTypesAreRefused) {
    const auto refused = [](const char* what, const std::function<void(TileSet&, double)>& put) {
        for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
            TileSet set = test::smallSet();
            put(set, value);
            EXPECT_NE(findTileSetFault(set), "") << what << " " << value;
        }
    };
    refused("origin", [](TileSet& set, double value) { set.lattice_origin[2] = value; });
    refused("edge", [](TileSet& set, double value) { set.edge = value; });
    refused("up", [](TileSet& set, double value) { set.up[0] = value; });
    refused("metres", [](TileSet& set, double value) { set.metres = value; });
    refused("low bound", [](TileSet& set, double value) { set.bounds_min[0] = value; });
    refused("high bound", [](TileSet& set, double value) { set.bounds_max[2] = value; });
    refused("noise", [](TileSet& set, double value) { set.noise = value; });
    refused("radius_max", [](TileSet& set, double value) { set.levels[1].radius_max = value; });
    refused("radius_step", [](TileSet& set, double value) { set.levels[1].radius_step = value; });
    refused("level's error", [](TileSet& set, double value) { set.levels[1].error = value; });
    refused("low", [](TileSet& set, double value) { set.attributes[0].low = value; });
    refused("high", [](TileSet& set, double value) { set.attributes[0].high = value; });
    refused("sensor", [](TileSet& set, double value) { set.sensors[0][1] = value; });
    refused("error", [](TileSet& set, double value) { set.tiles[1].error = value; });
    refused("spacing", [](TileSet& set, double value) { set.tiles[1].spacing = value; });
}

TEST_F(HostileSet, IntegersOutOfRangeAreRefused) {
    const std::string cell = "tiles[1]: cell *-2147483648 *2147483647";
    for (const char* value : {"2147483648", "-2147483649", "1.0", "1e400", "18446744073709551616", "null", "\"1\""}) {
        const std::string said = faultOfChange([&](Json& json) { json["tiles"][1]["cell"][2] = "PLACE"; });
        EXPECT_SAYS(said, cell);
        std::string text = Json::parse(goldenText()).dump();
        const std::string from = "\"cell\":[0,0,0],\"file\":\"tiles/1-";
        text.replace(text.find(from), from.size(), "\"cell\":[0,0," + std::string(value) + "],\"file\":\"tiles/1-");
        EXPECT_SAYS(faultOf(text), std::string(value) == "1e400" ? "*range" : cell) << value;
    }
    EXPECT_SAYS(faultOfChange([](Json& json) { json["tiles"][1]["splats"] = -1; }),
                "tiles[1]: splats *0 *18446744073709551615");
}

TEST_F(HostileSet, FilesStayInTheFolder) {
    for (const char* file :
         {"tiles/../x.pro", "../x.pro", "/etc/x.pro", "tiles//x.pro", "tiles/a/x.pro", "tiles/.pro", "tiles/.x.pro",
          "tiles/x.las", "x.pro", "", "tiles/x.pro/", "tiles/x y.pro", "tiles/x\ny.pro", "tiles/\xc3\xa4.pro"}) {
        EXPECT_SAYS(faultOfChange([&](Json& json) { json["tiles"][2]["file"] = file; }),
                    "tiles[2] 1-1-0-0: file *tiles/*.pro");
    }
    EXPECT_NE(faultOfChange([](Json& json) { json["tiles"][2]["file"] = std::string("tiles/a\0b.pro", 13); }), "");
    const std::string longest = "tiles/" + std::string(251, 'a') + ".pro";
    EXPECT_EQ(faultOfChange([&](Json& json) { json["tiles"][2]["file"] = longest; }), "");
    EXPECT_NE(faultOfChange([&](Json& json) { json["tiles"][2]["file"] = "tiles/a" + longest.substr(6); }), "");
}

TEST_F(HostileSet, TruncatedFilesAreRefused) {
    const std::string whole = goldenText();
    ASSERT_EQ(faultOf(whole), "");
    for (std::size_t bytes = 0; bytes + 2 < whole.size(); ++bytes) // the last line end is optional
        ASSERT_NE(faultOf(whole.substr(0, bytes)), "") << bytes;
    EXPECT_SAYS(faultOf(""), "line 1 *JSON");
    const auto lines = std::count(whole.begin(), whole.begin() + whole.size() / 2, '\n');
    EXPECT_SAYS(faultOf(whole.substr(0, whole.size() / 2)), "line " + std::to_string(1 + lines) + " *JSON");
    EXPECT_NE(faultOf(whole + "x"), "");
}

TEST_F(HostileSet, ChangedBytesDoNotCrash) {
    const std::string whole = goldenText();
    std::size_t refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const char put : {'9', '[', '"', '\x80'}) {
            std::string changed = whole;
            changed[i] = put;
            refused += faultOf(changed) != "";
        }
    EXPECT_GT(refused, whole.size() * 3) << "what is left is spaces, digits of coordinates and names";
}

struct HostileSize : HostileSet {
    /// Expects an error within a time limit and a gigabyte.
    void expectRefused(const char* what, const std::string& text) {
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_NE(faultOf(text), "") << what;
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(kSecondsMax)) << what;
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        EXPECT_LT(usage.ru_maxrss, 1 << 20) << what; // KiB
    }

    static std::string repeated(const std::string& text, std::size_t times) {
        std::string all;
        all.reserve(text.size() * times);
        for (std::size_t i = 0; i < times; ++i) all += text;
        return all;
    }

    static constexpr int kSecondsMax = 60; ///< on a loaded machine with sanitizers; normally below one
};

TEST_F(HostileSize, IsBounded) {
    constexpr std::size_t kMany = 10'000'000;
    expectRefused("nested lists", std::string(kMany, '['));
    expectRefused("nested objects", repeated("{\"a\":", kMany / 5));
    expectRefused("nested where nobody looks", "{\"x\":" + std::string(kMany, '['));
    expectRefused("a long list", "{\"sensors\":[" + repeated("0,", kMany));
    expectRefused("a long list that no reader uses", "{\"x\":[" + repeated("0,", kMany) + "0]}");
    expectRefused("many objects", "{\"sensors\":[" + repeated("{},", kMany / 3));
    expectRefused("many objects behind a long list",
                  "{\"sensors\":[" + repeated("0,", 1'000'000) + repeated("{},", kMany / 3));
    expectRefused("no tiles", "{\"tiles\":[" + repeated("0,", kMany));
    expectRefused("empty tiles", "{\"tiles\":[" + repeated("{},", kMany / 3));
    expectRefused("lists for tiles", "{\"tiles\":[" + repeated("[],", kMany / 3));
    std::string keys = "{\"settings\":{";
    for (std::size_t i = 0; i < 1'000'000; ++i) keys += "\"" + std::to_string(i) + "\":0,";
    expectRefused("many keys", keys);
    expectRefused("a long number", "{\"edge\":" + std::string(kMany, '9') + "}");
    expectRefused("a long word", "{\"crs\":\"" + std::string(kMany, 'a') + "\"}");
}

TEST_F(HostileSize, AGigabyteIsNotRead) {
    const std::string path = folder.write("set.json", "{");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
    try {
        readTileSet(folder.path);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_SAYS(error.what(), path + ": *1099511627776 bytes*limit");
    }
}

TEST_F(HostileSet, MissingFoldersAndFilesAreNamed) {
    const auto said = [&](const std::string& path) -> std::string {
        try {
            readTileSet(path);
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    };
    EXPECT_EQ(said(folder.file("no.proset")), folder.file("no.proset/set.json") + ": No such file or directory");
    EXPECT_EQ(said(folder.write("file.proset", "x")), folder.file("file.proset/set.json") + ": Not a directory");
    folder.write("set.json", "");
    EXPECT_SAYS(said(folder.path), folder.file("set.json") + ": *empty");
    folder.write("set.json", "{");
    EXPECT_SAYS(said(folder.path), folder.file("set.json") + ": line 1 *JSON");
    EXPECT_THROW(writeTileSet(test::smallSet(), folder.file("no.proset")), Error);
}

} // namespace
} // namespace pointrt
