// SPDX-License-Identifier: Apache-2.0
#include "format/crs/projected_crs.h"

#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>

#include "format/base/error.h"
#include "format/crs/proj_library.h"

namespace pointrt {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr std::string_view kEpsg = "EPSG:";

const ProjLibrary& proj() {
    if (const ProjLibrary* library = projLibrary()) return *library;
    throw Error{ExitCode::kCannotRun, "coordinate systems need PROJ (libproj.so.25): "
                                      "install it (Debian, Ubuntu: libproj25)"};
}

struct DestroyContext {
    void operator()(PJ_CONTEXT* context) const { proj().proj_context_destroy(context); }
};
struct DestroyObject {
    void operator()(PJ* object) const { proj().proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, DestroyContext>;
using Object = std::unique_ptr<PJ, DestroyObject>;

Context createContext() {
    Context context(proj().proj_context_create());
    proj().proj_log_level(context.get(), PJ_LOG_NONE);
    proj().proj_context_set_enable_network(context.get(), 0);
    return context;
}

bool hasDatabase(PJ_CONTEXT* context) { return proj().proj_context_get_database_path(context) != nullptr; }

Object createFromEpsg(PJ_CONTEXT* context, const std::string& code) {
    if (!hasDatabase(context))
        throw Error{ExitCode::kCannotRun, "PROJ cannot find its database (proj.db): install it (Debian, Ubuntu: "
                                          "proj-data) or set PROJ_DATA"};
    return Object(proj().proj_create_from_database(context, "EPSG", code.c_str(), PJ_CATEGORY_CRS, 0, nullptr));
}

/// Only EPSG codes and WKT: the text comes from a file, and a PROJ string could name other files to read.
Object createCrs(PJ_CONTEXT* context, std::string_view crs) {
    constexpr std::size_t kLongestWkt = 65535; // bytes of a LAS record
    if (crs.size() > kLongestWkt) return {};
    if (!crs.starts_with(kEpsg))
        return Object(proj().proj_create_from_wkt(context, std::string(crs).c_str(), nullptr, nullptr, nullptr));
    int code = 0;
    const auto [end, failure] = std::from_chars(crs.data() + kEpsg.size(), crs.data() + crs.size(), code);
    if (failure != std::errc() || end != crs.data() + crs.size() || code <= 0) return {};
    return createFromEpsg(context, std::to_string(code));
}

/// The projected system within compound and bound ones.
Object unwrap(PJ_CONTEXT* context, Object crs) {
    constexpr int kDeepest = 4; // a bound system in a compound one, and the other way round
    for (int depth = 0; crs && depth < kDeepest; ++depth) {
        const PJ_TYPE type = proj().proj_get_type(crs.get());
        if (type == PJ_TYPE_PROJECTED_CRS) return crs;
        if (type == PJ_TYPE_COMPOUND_CRS)
            crs.reset(proj().proj_crs_get_sub_crs(context, crs.get(), 0));
        else if (type == PJ_TYPE_BOUND_CRS)
            crs.reset(proj().proj_get_source_crs(context, crs.get()));
        else
            return {};
    }
    return {};
}

Object createProjected(PJ_CONTEXT* context, std::string_view crs) { return unwrap(context, createCrs(context, crs)); }

double metresPerUnit(PJ_CONTEXT* context, const PJ* crs) {
    const Object axes(proj().proj_crs_get_coordinate_system(context, crs));
    double metres = 0;
    if (axes)
        proj().proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, nullptr, &metres, nullptr, nullptr,
                                     nullptr);
    return metres > 0 ? metres : 1;
}

std::optional<AreaOfUse> statedArea(PJ_CONTEXT* context, const PJ* crs) {
    AreaOfUse area{};
    if (!proj().proj_get_area_of_use(context, crs, &area.west_deg, &area.south_deg, &area.east_deg, &area.north_deg,
                                     nullptr))
        return {};
    constexpr double kUnknown = -1000; // PROJ's value for a side that is not known
    for (const double side : {area.west_deg, area.south_deg, area.east_deg, area.north_deg})
        if (side == kUnknown) return {};
    return area;
}

/// WKT rarely states the area of use; its EPSG code leads to it.
std::optional<AreaOfUse> areaOfUse(PJ_CONTEXT* context, const PJ* crs) {
    if (const auto area = statedArea(context, crs)) return area;
    const char* authority = proj().proj_get_id_auth_name(crs, 0);
    const char* code = proj().proj_get_id_code(crs, 0);
    if (!authority || !code || std::string_view(authority) != "EPSG") return {};
    const Object same = createFromEpsg(context, code);
    return same ? statedArea(context, same.get()) : std::nullopt;
}

/// The same projection with easting and northing in metres, in that order: proj_factors of PROJ 9.1 is wrong for other
/// axes (EPSG:2193) and units (EPSG:2225).
Object inMetresEastNorth(PJ_CONTEXT* context, const PJ* crs) {
    const Object base(proj().proj_get_source_crs(context, crs));
    const Object projection(proj().proj_crs_get_coordoperation(context, crs));
    const Object axes(proj().proj_create_cartesian_2D_cs(context, PJ_CART2D_EASTING_NORTHING, "metre", 1));
    if (!base || !projection || !axes) return {};
    return Object(proj().proj_create_projected_crs(context, "", base.get(), projection.get(), axes.get()));
}

/// Longitude of the system's prime meridian from Greenwich, in radians; that of Paris is 2.337 degrees.
double primeMeridianRadians(PJ_CONTEXT* context, const PJ* crs) {
    const Object meridian(proj().proj_get_prime_meridian(context, crs));
    double longitude = 0, radians_per_unit = 0;
    if (meridian)
        proj().proj_prime_meridian_get_parameters(context, meridian.get(), &longitude, &radians_per_unit, nullptr);
    return longitude * radians_per_unit;
}

} // namespace

bool isProjInstalled() { return projLibrary() && hasDatabase(createContext().get()); }

std::optional<ProjectedCrs> projectedCrs(std::string_view crs) {
    const Context context = createContext();
    const Object object = createProjected(context.get(), crs);
    if (!object) return {};
    return ProjectedCrs{proj().proj_get_name(object.get()), metresPerUnit(context.get(), object.get()),
                        areaOfUse(context.get(), object.get())};
}

std::optional<double> meridianConvergenceDeg(std::string_view crs, double latitude_deg, double longitude_deg) {
    const Context context = createContext();
    const Object given = createProjected(context.get(), crs);
    const Object object = given ? inMetresEastNorth(context.get(), given.get()) : Object();
    if (!object) return {};
    PJ_COORD place{};
    // PROJ counts from the system's own prime meridian
    place.lp = {longitude_deg * kRadiansPerDegree - primeMeridianRadians(context.get(), object.get()),
                latitude_deg * kRadiansPerDegree};
    const PJ_FACTORS factors = proj().proj_factors(object.get(), place);
    const bool is_defined = factors.meridional_scale != 0; // all factors are 0 if PROJ fails
    if (!is_defined || !std::isfinite(factors.meridian_convergence)) return {};
    return factors.meridian_convergence / kRadiansPerDegree;
}

std::optional<GeographicPlace> geographicPlace(std::string_view crs, double easting, double northing) {
    const Context context = createContext();
    const Object given = createProjected(context.get(), crs);
    const Object object = given ? inMetresEastNorth(context.get(), given.get()) : Object();
    if (!object) return {};
    const Object wgs84 = createFromEpsg(context.get(), "4326");
    const Object transform(
        proj().proj_create_crs_to_crs_from_pj(context.get(), object.get(), wgs84.get(), nullptr, nullptr));
    if (!transform) return {};
    const double metres = metresPerUnit(context.get(), given.get());
    PJ_COORD place{};
    place.xy = {easting * metres, northing * metres};
    place = proj().proj_trans(transform.get(), PJ_FWD, place);                         // latitude first, in degrees
    const bool is_defined = std::abs(place.xy.x) <= 90 && std::abs(place.xy.y) <= 180; // otherwise infinite
    if (!is_defined) return {};
    return GeographicPlace{place.xy.x, place.xy.y};
}

} // namespace pointrt
