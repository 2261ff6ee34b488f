// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/axis_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

namespace pointrt {
namespace {

/// Names of one kind for x and y, separated by blanks; each complete pair is preferred to the next.
struct AxisNames {
    std::string_view x, y;
    bool degrees = false;
};

constexpr AxisNames kAxisNames[] = {
    {"x", "y"},
    {"easting east eastings e", "northing north northings n"},
    {"rechtswert rechts rw ostwert ost est este", "hochwert hoch hw nordwert nord norte"},
    {"longitude lon long lng", "latitude lat", true},
    {"points0", "points1"}, // ParaView's names "Points:0" or "Points_0"
};
/// Names of heights, which do not depend on those of x and y; "Höhe" in UTF-8 and in Latin-1, as German programs write
/// it.
constexpr std::string_view kHeights = "z height elevation elev altitude alt h hoehe höhe h\xf6he cota quota up points2";

bool isWordOf(std::string_view words, std::string_view wanted) {
    while (!words.empty()) {
        const std::size_t length = std::min(words.find(' '), words.size());
        if (words.substr(0, length) == wanted) return true;
        words.remove_prefix(std::min(length + 1, words.size()));
    }
    return false;
}

/// Removes one of these words from the start or the end of a longer name.
bool strip(std::string& name, std::string_view word) {
    if (name.size() <= word.size()) return false;
    if (name.starts_with(word))
        name.erase(0, word.size());
    else if (name.ends_with(word))
        name.erase(name.size() - word.size());
    else
        return false;
    return true;
}

/// Converts to lower case and removes signs and words that headers add: "Pos_X" and "x coordinate" become "x".
std::string essence(std::string_view written) {
    std::string name;
    for (const std::string_view unit : std::initializer_list<std::string_view>{"_m", " m", "_ft", " ft"})
        if (written.ends_with(unit)) written.remove_suffix(unit.size());
    for (const char letter : written)
        if (static_cast<unsigned char>(letter) >= 0x80 || std::isalnum(static_cast<unsigned char>(letter)))
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (name.size() == 7 && name.starts_with("points") && std::isdigit(static_cast<unsigned char>(name.back())))
        return name;
    constexpr std::string_view kAdded[] = {"coordinates", "coordinate", "coords",  "coord", "position", "pos",
                                           "points",      "point",      "degrees", "deg",   "metres",   "meters",
                                           "metre",       "meter",      "feet",    "utm",   "world",    "cartesian"};
    for (const std::string_view word : kAdded)
        if (strip(name, word)) break;
    return name;
}

} // namespace

bool findAxes(std::span<const std::string> names, std::span<Dimension> dimensions) {
    std::vector<std::string> essences;
    for (const std::string& name : names) essences.push_back(essence(name));
    const auto columnOf = [&](std::string_view words) {
        return std::find_if(essences.begin(), essences.end(),
                            [&](const std::string& each) { return isWordOf(words, each); }) -
               essences.begin();
    };
    const auto isFree = [&](std::ptrdiff_t column) {
        return column < std::ptrdiff_t(names.size()) && dimensions[std::size_t(column)] == kIgnored;
    };
    const auto has = [&](Dimension wanted) {
        return std::find(dimensions.begin(), dimensions.end(), wanted) != dimensions.end();
    };
    bool degrees = false;
    for (const AxisNames& each : kAxisNames) {
        const auto x = columnOf(each.x), y = columnOf(each.y);
        if ((has(kX) && has(kY)) || !isFree(x) || !isFree(y)) continue;
        std::replace(dimensions.begin(), dimensions.end(), kX, kIgnored);
        std::replace(dimensions.begin(), dimensions.end(), kY, kIgnored);
        dimensions[std::size_t(x)] = kX;
        dimensions[std::size_t(y)] = kY;
        degrees = each.degrees;
    }
    if (const auto z = columnOf(kHeights); !has(kZ) && isFree(z)) dimensions[std::size_t(z)] = kZ;
    return degrees;
}

} // namespace pointrt
