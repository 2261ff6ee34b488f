// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/e57_columns.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "format/base/error.h"
#include "preprocess/cloud/scalar.h"

namespace pointrt {
namespace {

constexpr std::size_t kLongestName = 31; // of an attribute in a .pro

struct KnownName {
    std::string_view column, attribute;
    std::string_view invalid = ""; ///< the column that marks invalid values
    bool untyped = false;          ///< grid indices: their limits are those of the grid
};

constexpr KnownName kKnown[] = {
    {"intensity", "intensity", "isIntensityInvalid"},
    {kE57RowIndex, "row", "", true},
    {kE57ColumnIndex, "column", "", true},
    {kE57ReturnIndex, "return_number"},
    {kE57ReturnCount, "number_of_returns"},
    {"timeStamp", "time_stamp", "isTimeStampInvalid"},
};

/// Columns that qualify others or are read together with them.
constexpr std::string_view kNoAttributes[] = {
    "cartesianX",         "cartesianY",        "cartesianZ",         "cartesianInvalidState",
    "sphericalRange",     "sphericalAzimuth",  "sphericalElevation", "sphericalInvalidState",
    "colorRed",           "colorGreen",        "colorBlue",          "isColorInvalid",
    "isTimeStampInvalid", "isIntensityInvalid"};

constexpr std::string_view kOfLas[] = {"return_number",
                                       "number_of_returns",
                                       "scan_direction_flag",
                                       "edge_of_flight_line",
                                       "classification",
                                       "synthetic",
                                       "key_point",
                                       "withheld",
                                       "overlap",
                                       "scanner_channel",
                                       "scan_angle",
                                       "scan_angle_rank",
                                       "user_data",
                                       "point_source_id",
                                       "gps_time",
                                       "nir"};

template <typename List, typename Item>
bool holds(const List& list, const Item& item) {
    return std::find(std::begin(list), std::end(list), item) != std::end(list);
}

std::optional<std::size_t> find(const E57Scan& scan, std::string_view name) {
    for (std::size_t i = 0; i < scan.columns.size(); ++i)
        if (scan.columns[i].name == name) return i;
    return std::nullopt;
}

std::string_view withoutPrefix(std::string_view name) { return name.substr(name.find(':') + 1); }

/// As find, for the column of an extension under any prefix.
std::optional<std::size_t> findExtension(const E57Scan& scan, std::string_view name) {
    for (std::size_t i = 0; i < scan.columns.size(); ++i)
        if (withoutPrefix(scan.columns[i].name) == name) return i;
    return std::nullopt;
}

template <typename Find>
std::optional<E57Triple> findThree(const E57Scan& scan, const Find& find_one, std::string_view first,
                                   std::string_view second, std::string_view third) {
    const auto a = find_one(scan, first), b = find_one(scan, second), c = find_one(scan, third);
    if (!a || !b || !c) return std::nullopt;
    return E57Triple{*a, *b, *c};
}

/// "pointSourceId" to "point_source_id".
std::string snakeCase(std::string_view name) {
    std::string snake;
    for (const char letter : name) {
        const auto code = static_cast<unsigned char>(letter);
        if (std::isupper(code) && !snake.empty()) snake += '_';
        snake += static_cast<char>(std::isupper(code) ? std::tolower(code) : code);
    }
    return snake;
}

/// Truncates a name to the limit of attributes, between two UTF-8 characters.
std::string cutName(std::string_view name) {
    std::size_t size = std::min(name.size(), kLongestName);
    while (size > 0 && size < name.size() && (static_cast<unsigned char>(name[size]) & 0xC0) == 0x80) --size;
    return std::string(name.substr(0, size));
}

std::string nameOfExtension(std::string_view column) {
    const std::string_view name = withoutPrefix(column);
    const std::string snake = snakeCase(name);
    return holds(kOfLas, snake) ? snake : cutName(name);
}

template <typename Value>
bool holdsBoth(double least, double most) {
    return least >= static_cast<double>(std::numeric_limits<Value>::lowest()) &&
           most <= static_cast<double>(std::numeric_limits<Value>::max());
}

Scalar wholeTypeFor(double least, double most) {
    if (holdsBoth<std::uint8_t>(least, most)) return Scalar::kU8;
    if (holdsBoth<std::int8_t>(least, most)) return Scalar::kI8;
    if (holdsBoth<std::uint16_t>(least, most)) return Scalar::kU16;
    if (holdsBoth<std::int16_t>(least, most)) return Scalar::kI16;
    if (holdsBoth<std::uint32_t>(least, most)) return Scalar::kU32;
    if (holdsBoth<std::int32_t>(least, most)) return Scalar::kI32;
    return Scalar::kI64;
}

Scalar typeFor(const E57Column& column, std::int64_t add) {
    switch (column.kind) {
    case E57Kind::kWhole:
        return wholeTypeFor(static_cast<double>(column.least) + static_cast<double>(add),
                            static_cast<double>(column.most) + static_cast<double>(add));
    case E57Kind::kSingle:
        return Scalar::kF32;
    case E57Kind::kScaled:
    case E57Kind::kDouble:
        break;
    }
    return Scalar::kF64;
}

/// Whether the file states no limits for an integer. The type of the attribute then depends on its values (untyped).
bool hasNoLimits(const E57Column& column) {
    return column.kind == E57Kind::kWhole && column.least == std::numeric_limits<std::int64_t>::min() &&
           column.most == std::numeric_limits<std::int64_t>::max();
}

void addAttribute(E57Plan& plan, const E57Scan& scan, std::size_t number, const KnownName& known,
                  bool returns_from_one) {
    const E57Column& column = scan.columns[number];
    const auto taken = [&](const ColumnTraits& each) { return each.name == known.attribute; };
    if (std::any_of(plan.traits.columns.begin(), plan.traits.columns.end(), taken))
        throw Error(ExitCode::kBadInput, fmt::format("has two columns '{}'", known.attribute));
    const std::int64_t add = column.name == kE57ReturnIndex && !returns_from_one ? 1 : 0;
    const Scalar type = typeFor(column, add);
    const bool untyped = known.untyped || hasNoLimits(column) || column.kind == E57Kind::kScaled;
    plan.traits.columns.push_back({std::string(known.attribute), type, 1, untyped});
    plan.attributes.push_back({number, find(scan, known.invalid), type, plan.value_bytes, add});
    plan.value_bytes += scalarSize(type);
}

void planPositions(E57Plan& plan, const E57Scan& scan) {
    plan.cartesian = findThree(scan, find, "cartesianX", "cartesianY", "cartesianZ");
    plan.spherical = findThree(scan, find, "sphericalRange", "sphericalAzimuth", "sphericalElevation");
    if (!plan.cartesian && !plan.spherical) throw Error(ExitCode::kBadInput, "has no coordinates");
    if (plan.cartesian) plan.cartesian_invalid = find(scan, "cartesianInvalidState");
    // if a point has both kinds, the cartesian ones are used unless they are invalid
    if (plan.cartesian && !plan.cartesian_invalid) plan.spherical.reset();
    if (plan.spherical) plan.spherical_invalid = find(scan, "sphericalInvalidState");
}

bool haveUsefulLimits(const E57Scan& scan) {
    return std::all_of(scan.color_limits.begin(), scan.color_limits.end(), [](const auto& limits) {
        return limits && std::isfinite(limits->most - limits->least) && limits->most > limits->least;
    });
}

/// Number of steps between a colour's limits; unbounded for reals.
double stepsOf(const E57Column& column, const E57Limits& limits) {
    if (column.kind == E57Kind::kSingle || column.kind == E57Kind::kDouble)
        return std::numeric_limits<double>::infinity();
    return (limits.most - limits.least) / std::abs(column.kind == E57Kind::kScaled ? column.scale : 1);
}

void planColors(E57Plan& plan, const E57Scan& scan) {
    plan.colors = findThree(scan, find, "colorRed", "colorGreen", "colorBlue");
    if (!plan.colors) return;
    plan.color_invalid = find(scan, "isColorInvalid");
    plan.traits.colors = true;
    plan.scaled_colors = haveUsefulLimits(scan);
    bool real = false, wide = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const E57Column& column = scan.columns[(*plan.colors)[i]];
        real = real || column.kind != E57Kind::kWhole;
        wide = wide || (plan.scaled_colors && stepsOf(column, *scan.color_limits[i]) > 255);
    }
    if (!plan.scaled_colors) plan.traits.color_scale = real ? ColorScale::kReal : ColorScale::kInteger;
    if (!wide) return;
    plan.traits.columns.push_back({kRgb16, Scalar::kU16, 3});
    plan.rgb16_offset = plan.value_bytes;
    plan.value_bytes += 3 * scalarSize(Scalar::kU16);
}

void planAttributes(E57Plan& plan, const E57Scan& scan, bool returns_from_one) {
    for (const KnownName& known : kKnown)
        if (const auto column = find(scan, known.column)) addAttribute(plan, scan, *column, known, returns_from_one);
    for (std::size_t i = 0; i < scan.columns.size(); ++i) {
        const std::string& name = scan.columns[i].name;
        const auto is_known = [&](const KnownName& known) { return known.column == name; };
        const bool is_normal = plan.normals && holds(*plan.normals, i);
        if (is_normal || holds(kNoAttributes, name) || std::any_of(std::begin(kKnown), std::end(kKnown), is_known))
            continue;
        const std::string attribute = nameOfExtension(name);
        addAttribute(plan, scan, i, {name, attribute}, returns_from_one);
    }
}

void markWanted(E57Plan& plan, std::size_t columns) {
    plan.used.resize(columns);
    for (const auto& triple : {plan.cartesian, plan.spherical, plan.normals, plan.colors})
        if (triple)
            for (const std::size_t column : *triple) plan.used[column] = true;
    for (const auto& column : {plan.cartesian_invalid, plan.spherical_invalid, plan.color_invalid})
        if (column) plan.used[*column] = true;
    for (const E57Attribute& attribute : plan.attributes) {
        plan.used[attribute.column] = true;
        if (attribute.invalid) plan.used[*attribute.invalid] = true;
    }
}

/// The standard has 20, extensions add a few.
constexpr std::size_t kMostColumns = 1024;

void checkColumns(const E57Scan& scan) {
    if (scan.columns.size() > kMostColumns)
        throw Error(ExitCode::kBadInput,
                    fmt::format("has {} columns, more than {}", scan.columns.size(), kMostColumns));
    for (std::size_t i = 0; i < scan.columns.size(); ++i)
        if (find(scan, scan.columns[i].name) != i)
            throw Error(ExitCode::kBadInput, fmt::format("has two columns {}", inQuotes(scan.columns[i].name)));
}

} // namespace

E57Plan planE57(const E57Scan& scan, bool returns_from_one) {
    checkColumns(scan);
    E57Plan plan;
    plan.traits.vertices = scan.points;
    plan.traits.faces = false;
    planPositions(plan, scan);
    plan.normals = findThree(scan, findExtension, "normalX", "normalY", "normalZ");
    plan.traits.normals = plan.normals.has_value();
    planColors(plan, scan);
    planAttributes(plan, scan, returns_from_one);
    markWanted(plan, scan.columns.size());
    return plan;
}

} // namespace pointrt
