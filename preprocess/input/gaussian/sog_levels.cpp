// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/sog_levels.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "preprocess/ingest/json_value.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

using RangesByFile = std::map<std::uint64_t, std::vector<SogRange>>;

/// The number of a level as the file counts them: 0 is the finest.
std::uint64_t levelNumber(const JsonValue& node, const std::string& key) {
    std::uint64_t number = 0;
    if (!wholeInteger(key, number)) node.refuse(fmt::format("{} is not a level", inQuotes(key)));
    return number;
}

/// The coarsest of a leaf's levels that is at least as fine as the wanted one, else its finest. Null if it has none.
const nlohmann::json* chosenLevel(const JsonValue& levels, std::uint64_t wanted) {
    const nlohmann::json* best = nullptr;
    std::uint64_t best_number = 0;
    for (const auto& [key, reference] : levels.json().items()) {
        const std::uint64_t number = levelNumber(levels, key);
        const bool finer = number <= wanted, best_finer = best && best_number <= wanted;
        const bool better = !best || (finer != best_finer ? finer
                                      : finer             ? number > best_number
                                                          : number < best_number);
        if (!better) continue;
        best = &reference;
        best_number = number;
    }
    return best;
}

void addRange(const InputFile& input, const nlohmann::json& reference, std::uint64_t file_count, RangesByFile& ranges) {
    const JsonValue value(input, reference);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    const std::uint64_t file = value.member("file").integer(file_count - 1);
    const SogRange range{value.member("offset").integer(kMost), value.member("count").integer(kMost)};
    if (range.count > 0) ranges[file].push_back(range);
}

/// Walks the tree, which may be of any depth.
RangesByFile rangesOf(const InputFile& input, const JsonValue& tree, std::uint64_t wanted, std::uint64_t file_count) {
    RangesByFile ranges;
    std::vector<const nlohmann::json*> open = {&tree.json()};
    while (!open.empty()) {
        const JsonValue node(input, *open.back());
        open.pop_back();
        if (const auto levels = node.optionalMember("lods"))
            if (const nlohmann::json* const level = chosenLevel(*levels, wanted))
                addRange(input, *level, file_count, ranges);
        const auto children = node.optionalMember("children");
        for (std::size_t i = 0; children && i < children->size(); ++i) open.push_back(&children->json()[i]);
    }
    return ranges;
}

/// Throws Error if ranges overlap: otherwise a few lines could request any amount of memory.
void checkOverlap(const InputFile& input, const std::string& name, std::vector<SogRange>& ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const SogRange& a, const SogRange& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < ranges.size(); ++i)
        if (ranges[i].first < ranges[i - 1].first + ranges[i - 1].count)
            refuse(input, fmt::format("has parts that overlap in {}", inQuotes(name)));
}

} // namespace

SogLevels parseSogLevels(const InputFile& input, std::optional<int> level) {
    const nlohmann::json json = parseJson(input, input.bytes);
    const JsonValue root(input, json);
    constexpr std::uint64_t kMostLevels = 64; // each has half the Gaussians of the one before, or fewer
    if (root.has("version") && root.member("version").integer() != 1)
        refuse(input, fmt::format("has version {}; this build reads version 1", root.member("version").integer()));
    SogLevels levels;
    levels.count = static_cast<int>(root.member("lodLevels").integer(kMostLevels));
    const auto wanted = static_cast<std::uint64_t>(level ? std::max(0, levels.count - 1 - *level) : 0);
    const JsonValue names = root.member("filenames");
    RangesByFile ranges = rangesOf(input, root.member("tree"), wanted, names.size());
    for (auto& [file, of_file] : ranges) {
        checkOverlap(input, names.at(file).text(), of_file);
        levels.files.push_back({names.at(file).text(), std::move(of_file)});
    }
    if (const auto environment = root.optionalMember("environment")) levels.scene = environment->text();
    return levels;
}

} // namespace pointrt
