// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/color_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>

#include "format/base/error.h"
#include "format/base/near_name.h"
#include "format/base/printable.h"
#include "runtime/device_scene/number_samples.h"
#include "runtime/util/unit_name.h"

namespace pointrt {
namespace {

/// Share of the values that is cut off at each end of the range.
constexpr double kExtremes = 0.01;
/// Integers in a range of at most this width are shown without excluding extremes.
constexpr double kSmallRange = 255;

using ScanNumbers = std::vector<std::optional<SplatNumbers>>;

ValueRange rangeWithoutExtremes(const std::vector<PlacedScan>& scans, const ScanNumbers& sources) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < scans.size(); ++i)
        if (sources[i])
            visitNumbers(scans[i], *sources[i], stepThrough(scans), [&](double number) { numbers.push_back(number); });
    if (numbers.empty()) return {};
    const auto at = [&](double share) {
        const auto place =
            numbers.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
        std::nth_element(numbers.begin(), place, numbers.end());
        return *place;
    };
    const ValueRange inner{at(kExtremes), at(1 - kExtremes)};
    if (inner.low < inner.high) return inner;
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    return {*low, *high};
}

/// The range centred on 0 that contains both ends.
ValueRange aroundZero(ValueRange range) {
    const double most = std::max(std::abs(range.low), std::abs(range.high));
    return {-most, most};
}

/// The full range of integers, if it is small.
std::optional<ValueRange> smallIntegerRange(const ScanNumbers& sources) {
    std::optional<ValueRange> all;
    for (const std::optional<SplatNumbers>& source : sources) {
        if (!source) continue;
        const pro_attribute& attribute = source->attribute;
        if (!attribute.values || attribute.type == PRO_TYPE_F32 || attribute.type == PRO_TYPE_F64) return std::nullopt;
        if (attribute.components > 1) return std::nullopt; // low and high span all components
        if (!all) all = {attribute.low, attribute.high};
        all = {std::min(all->low, attribute.low), std::max(all->high, attribute.high)};
    }
    return all && all->high - all->low <= kSmallRange ? all : std::nullopt;
}

/// A range narrower than this has a tick for each integer.
constexpr double kFewIntegers = 6;

std::vector<LegendTick> integerTicks(ValueRange range) {
    std::vector<LegendTick> ticks;
    const double width = range.high - range.low, first = std::ceil(range.low);
    for (int k = 0; k <= kFewIntegers && first + k <= range.high; ++k) {
        char text[32]; // at most 20 digits
        std::snprintf(text, sizeof text, "%.0f", first + k);
        // here, adjacent doubles are further apart than integers
        if (!ticks.empty() && ticks.back().text == text) break;
        ticks.push_back({width > 0 ? (first + k - range.low) / width : 0.5, text});
    }
    return ticks;
}

/// The integers in the scans, for categorical colour maps.
std::vector<double> categoriesOf(const std::vector<PlacedScan>& scans, const ScanNumbers& sources) {
    constexpr std::size_t kMost = 4096; // a longer list is not one of categories
    std::set<double> found;
    double last = std::nan("");
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (!sources[i]) continue;
        visitNumbers(scans[i], *sources[i], 1, [&](double number) {
            if (number == last || found.size() == kMost) return;
            last = number;
            if (std::round(number) >= 0) found.insert(std::round(number));
        });
    }
    return {found.begin(), found.end()};
}

ColorMap mapFor(const PaintRequest& request) {
    if (request.color_map) return *request.color_map;
    const std::string name = attributeWord(request.color_by);
    return name == "classification" ? ColorMap::kClasses
           : name == "scan"         ? ColorMap::kScans
           : name == kDistance      ? ColorMap::kCoolwarm
                                    : ColorMap::kViridis;
}

/// " (m)" for heights and distances in a known unit, else "".
std::string unitOf(const std::vector<PlacedScan>& scans, const PaintRequest& request) {
    const bool is_length = request.color_by == kHeight || request.color_by == kDistance;
    if (!is_length || scans.empty() || scans[0].instance->placement.scale != 1) return "";
    pro_world world;
    pro_get_world(scans[0].file->file, &world);
    const std::string unit = unitName(world.metres_per_unit);
    return unit.empty() ? "" : " (" + unit + ")";
}

/// The numbers of a representative, with the attribute range of its whole set.
std::optional<SplatNumbers> representativeNumbers(const PlacedScan& scan, const PaintRequest& request) {
    auto numbers = numbersFor(scan, request.color_by, request.up);
    if (!numbers || !scan.set || !numbers->attribute.values) return numbers;
    for (const SetAttribute& each : scan.set->attributes)
        if (each.name == numbers->attribute.name) {
            numbers->attribute.low = each.low;
            numbers->attribute.high = each.high;
        }
    return numbers;
}

ScanNumbers findNumbers(const std::vector<PlacedScan>& representatives, const PaintRequest& request) {
    ScanNumbers sources;
    bool any = representatives.empty();
    for (const PlacedScan& scan : representatives) {
        sources.push_back(representativeNumbers(scan, request));
        any |= sources.back().has_value();
    }
    if (!any)
        throw Error{ExitCode::kBadUsage,
                    "--color-by: " + lackText(representatives, request.color_by, {kOwnColors, kHeight, kNormal})};
    return sources;
}

ColorChoice normalColors(const std::vector<PlacedScan>& scans) {
    ColorChoice choice;
    for (const PlacedScan& scan : scans) choice.colors.emplace_back(NormalColors{scan.instance->placement.rotation});
    return choice;
}

/// Subject of a message: "a.pro has", or "the scans have" for several.
std::string namesOf(const std::vector<PlacedScan>& scans) {
    const auto is_first = [&](const PlacedScan& scan) { return scan.instance->path == scans[0].instance->path; };
    return std::all_of(scans.begin(), scans.end(), is_first) ? scans[0].instance->path + " has" : "the scans have";
}

std::vector<std::string> wordsOf(const std::vector<PlacedScan>& scans, std::vector<std::string> words) {
    for (const PlacedScan& scan : scans)
        for (const std::string& word : numberWords(scan.file->file))
            if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    return words;
}

} // namespace

std::optional<SplatNumbers> numbersFor(const PlacedScan& scan, const std::string& word, Vec3 up) {
    if (scan.file->is_gaussian) return std::nullopt;
    if (word == kHeight) return heightNumbers(scan.file->file, scan.instance->placement, up);
    return attributeNumbers(scan.file->file, word);
}

std::vector<SplatOverride::OfNumbers> selectionsOf(const PlacedScan& scan,
                                                   const std::vector<FilterDescription>& filters, Vec3 up) {
    std::vector<SplatOverride::OfNumbers> selections;
    for (const FilterDescription& filter : filters) {
        if (!hidesSplats(filter)) continue;
        if (auto numbers = numbersFor(scan, filter.shown.attribute, up))
            selections.push_back({*std::move(numbers), filter.shown.ranges});
    }
    return selections;
}

std::string lackText(const std::vector<PlacedScan>& scans, const std::string& word,
                     const std::vector<std::string>& besides) {
    const std::vector<std::string> words = wordsOf(scans, besides);
    const std::vector<std::string_view> names(words.begin(), words.end());
    const std::string_view near = nearestName(word, names);
    std::string text = namesOf(scans) + " no attribute \"" + printable(word) + "\"";
    if (!near.empty()) text += ", did you mean \"" + printable(near) + "\"?";
    std::string list;
    for (const std::string& each : words) list += (list.empty() ? "" : ", ") + printable(each);
    return text + (near.empty() ? "; available: " : " Available: ") + list;
}

ColorChoice chooseColors(const std::vector<PlacedScan>& scans, const PaintRequest& request) {
    if (request.color_by == kNormal) return normalColors(scans);
    const std::vector<PlacedScan> representatives = representativesOf(scans);
    const ScanNumbers sources = findNumbers(representatives, request);
    const ColorMap map = mapFor(request);
    const std::string title = attributeWord(request.color_by) + unitOf(scans, request);
    ColorChoice choice;
    ValueRange range;
    if (isCategorical(map)) {
        choice.legend = listLegend(title, map, categoriesOf(representatives, sources));
    } else {
        const auto integers = smallIntegerRange(sources);
        range = request.color_range ? *request.color_range
                : integers          ? *integers
                                    : rangeWithoutExtremes(representatives, sources);
        if (isDiverging(map) && !request.color_range) range = aroundZero(range);
        choice.legend = barLegend(title, map, range);
        if (integers && !request.color_range && range.high - range.low < kFewIntegers)
            choice.legend->ticks = integerTicks(range);
    }
    for (const PlacedScan& scan : scans)
        choice.colors.emplace_back(
            NumberColors{numbersFor(scan, request.color_by, request.up), ColorScale(map, range)});
    return choice;
}

std::vector<std::string> colorWords(const std::vector<PlacedScan>& scans) {
    if (std::all_of(scans.begin(), scans.end(), [](const PlacedScan& scan) { return scan.file->is_gaussian; }))
        return {kOwnColors};
    return wordsOf(scans, {kOwnColors, kHeight, kNormal});
}

} // namespace pointrt
