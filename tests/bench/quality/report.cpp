// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/report.h"

#include <fmt/format.h>

namespace pointrt::quality {

namespace {

using Json = nlohmann::ordered_json;

Json json(const Summary& summary) {
    return {{"mean", summary.mean}, {"median", summary.median}, {"p99", summary.p99}, {"max", summary.max}};
}

double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

double perMillion(std::size_t part, std::size_t whole) { return 1e6 * ratio(part, whole); }

Json viewReport(const ViewErrors& views, float median_radius) {
    const double length = static_cast<double>(views.silhouette_pixels) * median_radius / kPixel; // per radius of width
    return {{"silhouette_error_share", ratio(views.excess + views.missing, views.silhouette_pixels)},
            {"silhouette_excess_pixels", ratio(views.excess, views.silhouette_pixels)},
            {"silhouette_excess_radii", length > 0 ? static_cast<double>(views.excess) / length : 0},
            {"silhouette_missing_pixels", ratio(views.missing, views.silhouette_pixels)},
            {"holes_per_million", perMillion(views.holes, views.inside_pixels)},
            {"bridges_per_million", perMillion(views.bridges, views.splat_pixels)},
            {"inside_depth_radii", json(summarize(views.inside_depth))},
            {"surface_distance_radii", json(summarize(views.surface_distance))},
            {"inside_pixels", views.inside_pixels},
            {"silhouette_pixels", views.silhouette_pixels}};
}

} // namespace

Json reportOf(const Discs& discs, const SplatErrors& splats, const ViewErrors& views) {
    return {{"splats", discs.centers.size()},
            {"oriented", discs.oriented},
            {"median_radius_pixels", discs.median_radius / kPixel},
            {"normal_degrees", json(splats.face_normal)},
            {"normal_to_smooth_degrees", json(splats.smooth_normal)},
            {"normal_above_30_degrees_share", splats.wrong_share},
            {"flipped_share", splats.flipped_share},
            {"center_distance_radii", json(splats.center_distance)},
            {"radius_over_median", json(splats.radius)},
            {"views", viewReport(views, discs.median_radius)}};
}

std::string tableOf(const Json& report) {
    std::string table;
    const Json flat = report.flatten();
    for (const auto& [path, value] : flat.items())
        table += fmt::format("{:<45} {}\n", path.substr(1),
                             value.is_number_float() ? fmt::format("{:.5g}", value.get<double>()) : value.dump());
    return table;
}

} // namespace pointrt::quality
