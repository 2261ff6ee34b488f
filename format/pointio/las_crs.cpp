// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_crs.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "format/crs/projected_crs.h"
#include "format/crs/wkt.h"
#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

using Kind = LasCrs::Kind;

/// The factor of UNIT["name", factor, ...].
double factorOf(std::string_view unit) {
    const std::size_t quote = unit.rfind('"', unit.find(',')); // not a comma within the name
    std::size_t at = unit.find(',', quote == std::string_view::npos ? 0 : quote);
    if (at == std::string_view::npos) return 0;
    while (at + 1 < unit.size() && (unit[at] == ',' || unit[at] == ' ')) ++at;
    double factor = 0;
    std::from_chars(unit.data() + at, unit.data() + unit.size(), factor);
    return std::isfinite(factor) && factor > 0 ? factor : 0;
}

/// The unit of a projected or geocentric system, or of its first axis.
double unitOf(std::string_view system) {
    if (const auto unit = wktChild(system, {"UNIT", "LENGTHUNIT"})) return factorOf(*unit);
    if (const auto axis = wktChild(system, {"AXIS"}))
        if (const auto unit = wktChild(*axis, {"UNIT", "LENGTHUNIT"})) return factorOf(*unit);
    return 0;
}

/// Nesting of systems: a bound system in a compound one, and the other way round.
constexpr int kDeepestNesting = 4;

/// Reads the system of this keyword into crs. False if it is not a horizontal one.
bool takeSystem(std::string_view keyword, std::string_view content, LasCrs& crs, int depth = 0) {
    if (isOneOf(keyword, {"COMPD_CS", "COMPOUNDCRS", "BOUNDCRS", "SOURCECRS"}) && depth < kDeepestNesting) {
        forWktChildren(content, [&](std::string_view inner, std::string_view its) {
            return takeSystem(inner, its, crs, depth + 1);
        });
        return crs.kind != Kind::kUnknown;
    }
    if (isOneOf(keyword, {"PROJCS", "PROJCRS", "PROJECTEDCRS", "LOCAL_CS", "ENGCRS", "ENGINEERINGCRS"})) {
        crs.kind = Kind::kProjected;
        crs.metres_per_unit = unitOf(content);
    } else if (isOneOf(keyword, {"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS"})) {
        crs.kind = Kind::kGeographic;
    } else if (isOneOf(keyword, {"GEOCCS", "GEODCRS", "GEODETICCRS"})) {
        // GEODCRS is geographic or geocentric
        crs.metres_per_unit = keyword == "GEOCCS" || content.find("Cartesian") != content.npos ? 1 : 0;
        crs.kind = crs.metres_per_unit > 0 ? Kind::kGeocentric : Kind::kGeographic;
    }
    return crs.kind != Kind::kUnknown;
}

// ---- GeoTIFF keys: four integers each, "OGC GeoTIFF Standard 1.1" ----

enum GeoKey : std::uint16_t {
    kModelType = 1024,
    kGeodeticCrs = 2048,
    kProjectedCrs = 3072,
    kLinearUnits = 3076,
    kLinearUnitSize = 3077
};
constexpr std::uint16_t kUserDefined = 32767;

struct GeoKeys {
    std::string_view directory, doubles;

    /// The value of a key with an integer; 0 if absent.
    std::uint16_t number(GeoKey key) const {
        for (std::size_t at = 8; at + 8 <= directory.size(); at += 8)
            if (loadAt<std::uint16_t>(directory, at) == key && loadAt<std::uint16_t>(directory, at + 2) == 0)
                return loadAt<std::uint16_t>(directory, at + 6);
        return 0;
    }
    /// The value of a key with a double; 0 if absent.
    double real(GeoKey key) const {
        for (std::size_t at = 8; at + 8 <= directory.size(); at += 8) {
            const std::size_t place = 8 * std::size_t{loadAt<std::uint16_t>(directory, at + 6)};
            if (loadAt<std::uint16_t>(directory, at) == key &&
                loadAt<std::uint16_t>(directory, at + 2) == kGeoDoublesRecord && liesIn(place, 8, doubles.size()))
                return loadAt<double>(doubles, place);
        }
        return 0;
    }
};

/// EPSG codes of units of length.
double metresOfUnit(std::uint16_t code) {
    switch (code) {
    case 9001:
        return 1;
    case 9002: // international foot
        return 0.3048;
    case 9003: // US survey foot
        return 1200.0 / 3937.0;
    default:
        return 0;
    }
}

/// Common systems in metres, which read the same with and without PROJ.
bool isMetricCrs(std::uint16_t code) {
    const auto within = [code](int first, int last) { return code >= first && code <= last; };
    return within(32601, 32760)    // UTM, WGS 84
           || within(26901, 26923) // UTM, NAD83
           || within(26701, 26722) // UTM, NAD27
           || within(25828, 25838) // UTM, ETRS89
           || within(28348, 28358) // MGA, GDA94
           || code == 3857;        // Web Mercator
}

/// The unit of a projected system, for files whose keys name none; 0 if unknown.
double metresOfEpsgCrs(std::uint16_t code) {
    if (isMetricCrs(code)) return 1;
    if (code == 0 || code == kUserDefined || !isProjInstalled()) return 0;
    const auto crs = projectedCrs(fmt::format("EPSG:{}", code));
    return crs ? crs->metres_per_unit : 0;
}

LasCrs crsOfKeys(const GeoKeys& keys) {
    LasCrs crs;
    const std::uint16_t projected = keys.number(kProjectedCrs), geodetic = keys.number(kGeodeticCrs);
    const auto known = [](std::uint16_t code) { return code > 0 && code != kUserDefined; };
    switch (keys.number(kModelType)) {
    case 1:
        crs.kind = Kind::kProjected;
        break;
    case 2:
        crs.kind = Kind::kGeographic;
        break;
    case 3:
        crs.kind = Kind::kGeocentric;
        break;
    default:
        crs.kind = projected > 0 ? Kind::kProjected : geodetic > 0 ? Kind::kGeographic : Kind::kUnknown;
    }
    const std::uint16_t code = crs.kind == Kind::kProjected ? projected : geodetic;
    if (known(code)) crs.name = fmt::format("EPSG:{}", code);
    if (crs.kind == Kind::kGeocentric) crs.metres_per_unit = 1;
    if (crs.kind != Kind::kProjected) return crs;
    const std::uint16_t unit = keys.number(kLinearUnits);
    const double size = keys.real(kLinearUnitSize);
    if (unit == kUserDefined && std::isfinite(size) && size > 0)
        crs.metres_per_unit = size;
    else
        crs.metres_per_unit = unit == 0 ? metresOfEpsgCrs(projected) : metresOfUnit(unit);
    return crs;
}

} // namespace

LasCrs crsOfWkt(std::string_view wkt) {
    LasCrs crs;
    forWktChildren(
        wkt, [&](std::string_view keyword, std::string_view content) { return takeSystem(keyword, content, crs); });
    if (crs.kind != Kind::kUnknown) crs.name = wkt;
    return crs;
}

LasCrs lasCrs(const LasFile& file) {
    constexpr std::size_t kLongest = 65535; // the most that a VLR before the points holds
    const LasVlr* const wkt = findVlr(file, kLasCrsUser, kWktRecord);
    if (wkt && wkt->data.size() <= kLongest) {
        LasCrs crs = crsOfWkt(fieldText(wkt->data));
        if (crs.kind != Kind::kUnknown) return crs;
    }
    const LasVlr* const directory = findVlr(file, kLasCrsUser, kGeoKeysRecord);
    if (!directory) return {};
    const LasVlr* const doubles = findVlr(file, kLasCrsUser, kGeoDoublesRecord);
    return crsOfGeoKeys(directory->data, doubles ? doubles->data : std::string_view{});
}

LasCrs crsOfGeoKeys(std::string_view directory, std::string_view doubles) { return crsOfKeys({directory, doubles}); }

} // namespace pointrt
