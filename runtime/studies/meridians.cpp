// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/meridians.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "format/base/wkt.h"

namespace pointrt {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Numbers of the cone that touches or cuts the earth at these latitudes.
double lambertCone(double first_deg, double second_deg) {
    const double a = first_deg * kDegree, b = second_deg * kDegree;
    if (std::abs(a - b) < 1e-9) return std::sin(a); // the limit of what follows
    const auto up = [](double latitude) { return std::log(std::tan(std::numbers::pi / 4 + latitude / 2)); };
    return std::log(std::cos(a) / std::cos(b)) / (up(b) - up(a));
}
double albersCone(double first_deg, double second_deg) {
    return (std::sin(first_deg * kDegree) + std::sin(second_deg * kDegree)) / 2;
}

// ---- EPSG ----

std::optional<Meridians> meridiansOfEpsg(int code) {
    const auto zone = [code](int first, int last, int number) -> std::optional<Meridians> {
        if (code < first || code > last) return {};
        return Meridians{true, 6.0 * (number + code - first) - 183, 0}; // of UTM, whose zone 1 is around 177 W
    };
    for (const auto& [first, last, number] : {std::array{32601, 32660, 1},  // WGS 84, north
                                              std::array{32701, 32760, 1},  // WGS 84, south
                                              std::array{26901, 26923, 1},  // NAD83
                                              std::array{26701, 26722, 1},  // NAD27
                                              std::array{25828, 25838, 28}, // ETRS89
                                              std::array{28348, 28358, 48}, // GDA94
                                              std::array{7846, 7859, 46}})  // GDA2020
        if (const auto found = zone(first, last, number)) return found;
    switch (code) {
    case 27700: // British National Grid
        return Meridians{true, -2, 0};
    case 2157: // Irish Transverse Mercator
        return Meridians{true, -8, 0};
    case 2154: // RGF93, Lambert-93
        return Meridians{false, 3, lambertCone(44, 49)};
    case 5070: // NAD83, Conus Albers
        return Meridians{false, -96, albersCone(29.5, 45.5)};
    case 3857: // Web Mercator
    case 3395: // World Mercator
        return Meridians{};
    default:
        return {};
    }
}

// ---- WKT ----

std::string_view quoted(std::string_view inside) {
    const std::size_t open = inside.find('"'), close = inside.find('"', open + 1);
    return open == inside.npos || close == inside.npos ? std::string_view{} : inside.substr(open + 1, close - open - 1);
}

/// The number behind the quoted name.
std::optional<double> numberBehindName(std::string_view inside) {
    const std::size_t open = inside.find('"'), close = inside.find('"', open + 1);
    if (open == inside.npos || close == inside.npos) return {};
    std::size_t at = inside.find(',', close);
    if (at == inside.npos) return {};
    while (at < inside.size() && (inside[at] == ',' || inside[at] == ' ')) ++at;
    double number = 0;
    const auto [end, failure] = std::from_chars(inside.data() + at, inside.data() + inside.size(), number);
    if (failure != std::errc() || !std::isfinite(number)) return {};
    return number;
}

/// Lower case, without what versions write differently: "Transverse_Mercator" is "transversemercator".
std::string plainName(std::string_view name) {
    std::string plain;
    for (const char letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)))
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return plain;
}

/// What a projected system says of its map.
struct MapWords {
    std::string method;
    std::string_view parameters; ///< PARAMETERs among its children

    std::optional<double> parameter(std::initializer_list<std::string_view> names) const {
        std::optional<double> found;
        forWktChildren(parameters, [&](std::string_view keyword, std::string_view content) {
            if (keyword == "PARAMETER" && isOneOf(plainName(quoted(content)), names)) found = numberBehindName(content);
            return found.has_value();
        });
        return found;
    }
};

/// The contents of the projected system, whatever it is wrapped in.
std::optional<std::string_view> projectedSystem(std::string_view wkt, int depth = 0) {
    constexpr int kDeepest = 4; // a system bound to another one, of a compound one: none is deeper
    if (const auto system = wktChild(wkt, {"PROJCS", "PROJCRS", "PROJECTEDCRS"})) return system;
    if (depth == kDeepest) return {};
    const auto wrapping = wktChild(wkt, {"COMPD_CS", "COMPOUNDCRS", "BOUNDCRS", "SOURCECRS"});
    return wrapping ? projectedSystem(*wrapping, depth + 1) : std::nullopt;
}

/// Whether the system counts degrees from Greenwich.
bool countsDegrees(std::string_view system) {
    const auto base = wktChild(system, {"GEOGCS", "BASEGEOGCRS", "BASEGEODCRS"});
    if (!base) return true;
    const auto meridian = wktChild(*base, {"PRIMEM", "PRIMEMERIDIAN"});
    if (meridian && numberBehindName(*meridian).value_or(0) != 0) return false;
    const auto unit = wktChild(*base, {"UNIT", "ANGLEUNIT"});
    return !unit || std::abs(numberBehindName(*unit).value_or(kDegree) / kDegree - 1) < 1e-6;
}

MapWords mapOf(std::string_view system) {
    if (const auto conversion = wktChild(system, {"CONVERSION"})) {
        const auto method = wktChild(*conversion, {"METHOD", "PROJECTION"});
        return {plainName(quoted(method.value_or(""))), *conversion};
    }
    return {plainName(quoted(wktChild(system, {"PROJECTION"}).value_or(""))), system};
}

std::optional<Meridians> meridiansOf(const MapWords& map) {
    const double central =
        map.parameter({"centralmeridian", "longitudeofnaturalorigin", "longitudeoffalseorigin", "longitudeoforigin",
                       "longitudeofcenter", "straightverticallongitudefrompole"})
            .value_or(0);
    const double origin = map.parameter({"latitudeoforigin", "latitudeofnaturalorigin"}).value_or(0);
    const double first = map.parameter({"standardparallel1", "latitudeof1ststandardparallel"}).value_or(origin);
    const double second = map.parameter({"standardparallel2", "latitudeof2ndstandardparallel"}).value_or(first);
    const auto is = [&](std::string_view start) { return map.method.starts_with(start); };
    if (is("transversemercator") || is("gausskruger")) return Meridians{true, central, 0};
    if (is("mercator") || is("popularvisualisation")) return Meridians{};
    if (is("lambertconformalconic") || is("lambertconic")) return Meridians{false, central, lambertCone(first, second)};
    if (is("albers")) return Meridians{false, central, albersCone(first, second)};
    if (is("polarstereographic")) return Meridians{false, central, std::copysign(1.0, origin == 0 ? first : origin)};
    return {};
}

} // namespace

std::optional<Meridians> meridiansOf(std::string_view crs) {
    constexpr std::string_view kEpsg = "EPSG:";
    if (crs.starts_with(kEpsg)) {
        int code = 0;
        std::from_chars(crs.data() + kEpsg.size(), crs.data() + crs.size(), code);
        return meridiansOfEpsg(code);
    }
    const auto system = projectedSystem(crs);
    if (!system || !countsDegrees(*system)) return {};
    return meridiansOf(mapOf(*system));
}

double degreesEast(double longitude_deg, double of_deg) { return std::remainder(longitude_deg - of_deg, 360.0); }

double convergenceDeg(const Meridians& meridians, double latitude_deg, double longitude_deg) {
    const double east_deg = degreesEast(longitude_deg, meridians.central_deg);
    if (!meridians.transverse) return meridians.cone * east_deg;
    return std::atan(std::tan(east_deg * kDegree) * std::sin(latitude_deg * kDegree)) / kDegree;
}

} // namespace pointrt
