// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>

#include "runtime/studies/sensor_keys.h"
#include "runtime/studies/sensor_limits.h"

namespace pointrt {
namespace {

double numberIn(const SceneValue& table, std::string_view key, LidarLimit limit) {
    return numberOf(require(table, key), {limit.low, limit.high});
}

std::vector<double> elevationsOf(const SceneValue& list) {
    if (!list.node->is_array() || list.node->as_array()->empty()) refuse(list, "must be a list of numbers");
    if (list.node->as_array()->size() > kMaxLidarRings) refuse(list, "must have at most 65536 numbers");
    std::vector<double> elevations;
    for (const SceneValue& each : elementsOf(list))
        elevations.push_back(numberOf(each, {kLidarElevations.low, kLidarElevations.high}));
    return elevations;
}

/// `beams` elevations, evenly spaced from the lowest to the highest.
std::vector<double> evenElevations(const SceneValue& table) {
    const std::uint32_t count = wholeNumberOf(*find(table, "beams"), 1, kMaxLidarRings);
    const double lowest = numberIn(table, "lowest_deg", kLidarElevations);
    const double highest = numberIn(table, "highest_deg", kLidarElevations);
    if (lowest > highest) refuse(*find(table, "highest_deg"), "must not be below \"lowest_deg\"");
    std::vector<double> elevations;
    for (std::uint32_t i = 0; i < count; ++i)
        elevations.push_back(count == 1 ? lowest : lowest + (highest - lowest) * i / (count - 1));
    return elevations;
}

LidarSpinning spinningOf(const SceneValue& table) {
    requireKnownKeys(
        table, "a spinning scanner",
        {"elevations_deg", "beams", "lowest_deg", "highest_deg", "rotation_hz", "step_deg", "start_deg", "clockwise"});
    LidarSpinning spinning;
    if (hasFirst(table, "elevations_deg", "beams")) {
        forbid(table, {"lowest_deg", "highest_deg"}, "cannot be combined with \"elevations_deg\"");
        spinning.elevations_deg = elevationsOf(*find(table, "elevations_deg"));
    } else {
        spinning.elevations_deg = evenElevations(table);
    }
    spinning.rotation_hz = numberIn(table, "rotation_hz", kLidarRates);
    spinning.step_deg = numberIn(table, "step_deg", kLidarSteps);
    takeNumber(table, "start_deg", {kLidarAngles.low, kLidarAngles.high}, spinning.start_deg);
    takeFlag(table, "clockwise", spinning.clockwise);
    return spinning;
}

std::array<SceneValue, 2> pairOf(const SceneValue& list) {
    if (!list.node->is_array() || list.node->as_array()->size() != 2)
        refuse(list, "must be two numbers, horizontal and vertical");
    const std::vector<SceneValue> both = elementsOf(list);
    return {both[0], both[1]};
}

LidarFlash flashOf(const SceneValue& table) {
    requireKnownKeys(table, "a flash", {"pixels", "field_of_view_deg", "frame_hz"});
    const auto pixels = pairOf(require(table, "pixels")), field = pairOf(require(table, "field_of_view_deg"));
    const Range fields{kLidarFields.low, kLidarFields.high};
    return {wholeNumberOf(pixels[0], 1, kMaxLidarPixels), wholeNumberOf(pixels[1], 1, kMaxLidarPixels),
            numberOf(field[0], fields), numberOf(field[1], fields), numberIn(table, "frame_hz", kLidarRates)};
}

LidarOscillating oscillatingOf(const SceneValue& table) {
    requireKnownKeys(table, "an oscillating mirror", {"field_of_view_deg", "scan_hz", "pulse_hz", "sinusoidal"});
    LidarOscillating mirror{numberIn(table, "field_of_view_deg", kLidarFields), numberIn(table, "scan_hz", kLidarRates),
                            numberIn(table, "pulse_hz", kLidarRates), false};
    takeFlag(table, "sinusoidal", mirror.sinusoidal);
    return mirror;
}

LidarTable tableOf(const SceneValue& table) {
    requireKnownKeys(table, "a table of angles", {"file", "repeat_hz"});
    LidarTable pattern{readBeams(relativePath(require(table, "file"))), numberIn(table, "repeat_hz", kLidarRates)};
    for (const LidarBeam& beam : pattern.beams)
        if (beam.delay_s * pattern.repeat_hz > 1)
            refuse(*find(table, "file"), "a delay_s is longer than the period 1 / repeat_hz");
    return pattern;
}

struct PatternKind {
    std::string_view name;
    LidarPattern (*read)(const SceneValue& table);
};

template <auto kRead>
LidarPattern as(const SceneValue& table) {
    return kRead(table);
}

constexpr std::array kKinds{PatternKind{"spinning", as<spinningOf>}, PatternKind{"flash", as<flashOf>},
                            PatternKind{"oscillating", as<oscillatingOf>}, PatternKind{"table", as<tableOf>}};

} // namespace

std::vector<std::string_view> patternTables() {
    std::vector<std::string_view> names;
    for (const PatternKind& kind : kKinds) names.push_back(kind.name);
    return names;
}

LidarPattern readPattern(const SceneValue& file) {
    const PatternKind* found = nullptr;
    for (const PatternKind& kind : kKinds) {
        const auto table = findTable(file, kind.name);
        if (table && found)
            refuse(*table, "cannot be combined with [" + std::string(found->name) + "]: a sensor has one pattern");
        if (table) found = &kind;
    }
    if (!found) refuse(file, "a sensor must have a pattern, one of the tables " + joined(patternTables()));
    return found->read(*find(file, found->name));
}

std::string relativePath(const SceneValue& value) {
    return (std::filesystem::path(*value.file).parent_path() / textOf(value)).string();
}

} // namespace pointrt
