// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/set_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "format/base/error.h"
#include "preprocess/app/options.h"

namespace pointrt {
namespace {

/// The power of 1024 of a unit; -1 if unknown.
int powerOf(const std::string& unit) {
    if (unit.empty()) return 0;
    const auto power = std::string("KMGT").find(static_cast<char>(unit[0] & ~0x20)); // in either case
    const bool known = unit.size() == 1 || unit.substr(1) == "B" || unit.substr(1) == "iB";
    return known && power != std::string::npos ? static_cast<int>(power) + 1 : -1;
}

struct StepName {
    std::string_view name;
    SetStep step;
    bool numbered; ///< runs on one block
};
constexpr StepName kSteps[] = {{"plan", SetStep::kPlan, false},  {"split", SetStep::kSplit, false},
                               {"block", SetStep::kBlock, true}, {"levels", SetStep::kLevels, false},
                               {"tile", SetStep::kTile, true},   {"top", SetStep::kTop, false}};

} // namespace

std::uint64_t parseBytes(const std::string& option, const std::string& text) {
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const int power = powerOf(std::string(stop, text.data() + text.size()));
    const double bytes = std::ldexp(value, 10 * power);
    constexpr double kMost = 0x1p60;
    if (error != std::errc() || power < 0 || !(bytes >= 1 && bytes <= kMost))
        refuseUsage(fmt::format("{}: invalid size '{}'; examples: 4G, 800M", option, text));
    return static_cast<std::uint64_t>(bytes);
}

std::string setStepWords() {
    std::string words;
    for (const StepName& each : kSteps)
        words += (words.empty() ? "" : " ") + std::string(each.name) + (each.numbered ? ":" : "");
    return words;
}

void parseSetStep(const std::string& text, TileSetOptions& tiles) {
    const std::size_t colon = text.find(':');
    const auto row = std::find_if(std::begin(kSteps), std::end(kSteps),
                                  [&](const StepName& each) { return each.name == text.substr(0, colon); });
    if (row == std::end(kSteps))
        refuseUsage("--step: '" + text + "' is not one of plan, split, block:N, levels, tile:N, top");
    tiles.step = row->step;
    if (!row->numbered && colon != std::string::npos) refuseUsage(fmt::format("--step: {} takes no number", row->name));
    if (!row->numbered) return;
    const std::string number = colon == std::string::npos ? "" : text.substr(colon + 1);
    const char* const end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, tiles.block);
    if (error != std::errc() || stop != end)
        refuseUsage(fmt::format("--step: '{}' needs a block number, as in {}:0", text, row->name));
}

std::string tileSetSettings(const BakeOptions& options) {
    nlohmann::ordered_json json;
    const FilterOptions& filter = options.read.filter;
    json["tile-splats"] = options.tiles.points_per_tile;
    json["max-memory"] = options.tiles.max_memory;
    json["compact"] = !options.index;
    json["input-format"] = options.read.format;
    if (options.read.sample_count) json["sample"] = *options.read.sample_count;
    json["seed"] = options.read.seed;
    if (filter.bounds) {
        const auto &low = filter.bounds->min(), &high = filter.bounds->max();
        json["bounds"] = {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
    }
    for (std::size_t i = 0; i < filter.keep_classes.size(); ++i)
        if (filter.keep_classes[i]) json["classes"].push_back(i);
    json["thin"] = filter.thin_spacing;
    json["every"] = filter.every;
    if (options.read.salvages) json["salvage"] = true;
    if (!options.read.drops_withheld) json["keep-withheld"] = true;
    if (options.read.level) json["level"] = *options.read.level;
    if (options.read.skim < 1) json["skim"] = options.read.skim;
    if (options.read.transform) {
        const Eigen::Matrix4d& matrix = options.read.transform->matrix();
        for (Eigen::Index i = 0; i < 16; ++i) json["transform"].push_back(matrix(i / 4, i % 4));
    }
    json["up"] = {options.up.x(), options.up.y(), options.up.z()};
    json["attributes"] = options.read.attributes.all ? std::vector<std::string>{"auto"} : options.read.attributes.names;
    json["normals"] = choiceName(options.surface.normals);
    json["neighbors"] = options.surface.neighbors;
    json["orient"] = choiceName(options.surface.orient);
    if (options.surface.splat != SplatShape::kAuto) json["splat"] = choiceName(options.surface.splat);
    json["radius-scale"] = options.surface.radius_scale;
    json["outliers"] = options.surface.remove_outliers ? "remove" : "keep";
    json["clean"] = options.surface.clean;
    json["reflectivity"] = options.reflectivity;
    json["max-leaf-splats"] = options.octree.max_leaf_splats;
    json["max-depth"] = options.octree.max_depth;
    json["prune"] = options.prune;
    json["probe-rays"] = options.pruning.probe_rays;
    json["prune-harm"] = options.pruning.harm;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace); // names need not be UTF-8
}

} // namespace pointrt
