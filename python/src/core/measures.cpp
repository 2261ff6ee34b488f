// SPDX-License-Identifier: Apache-2.0
#include "pointrt/measure.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <vector>

#include "module.h"
#include "owned_array.h"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Normals = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Radii = nb::ndarray<const float, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Distances = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

std::vector<Position> positionsOf(const Points& points) {
    std::vector<Position> positions(points.shape(0));
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) positions[i][axis] = points(i, axis);
    return positions;
}

nb::ndarray<nb::numpy, double> rowsOf(const std::vector<Position>& points) {
    std::vector<double> numbers;
    for (const Position& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
    return owned(std::move(numbers), 3);
}

nb::dict pathDict(const Points& points, const Position& up) {
    const PathMeasures path = measurePath(positionsOf(points), up);
    nb::dict dict;
    dict["length"] = path.length;
    dict["horizontal_length"] = path.horizontal_length;
    dict["last_leg"] = path.last_leg;
    dict["difference"] = path.difference;
    dict["horizontal"] = path.horizontal;
    dict["height"] = path.height;
    dict["slope_deg"] = path.slope_deg;
    dict["angle_deg"] = path.angle_deg;
    dict["area"] = path.area;
    dict["plan_area"] = path.plan_area;
    dict["perimeter"] = path.perimeter;
    return dict;
}

nb::dict planeDict(const FittedPlane& plane) {
    nb::dict dict;
    dict["center"] = plane.center;
    dict["normal"] = plane.normal;
    dict["rms"] = plane.rms;
    return dict;
}

nb::dict circleDict(const Points& points) {
    const FittedCircle circle = fitCircle(positionsOf(points));
    nb::dict dict;
    dict["center"] = circle.center;
    dict["normal"] = circle.normal;
    dict["radius"] = circle.radius;
    dict["rms"] = circle.rms;
    return dict;
}

nb::dict sphereDict(const Points& points) {
    const FittedSphere sphere = fitSphere(positionsOf(points));
    nb::dict dict;
    dict["center"] = sphere.center;
    dict["radius"] = sphere.radius;
    dict["rms"] = sphere.rms;
    return dict;
}

nb::dict volumeDict(const TraceScene& scene, const Points& rim, const Position& up, std::optional<double> base_height,
                    double cell) {
    const std::vector<Position> corners = positionsOf(rim);
    Volume volume;
    {
        const nb::gil_scoped_release others_go_on;
        volume = measureVolume(scene, corners, {up, base_height, cell});
    }
    nb::dict dict;
    dict["cut"] = volume.cut;
    dict["fill"] = volume.fill;
    dict["net"] = volume.net();
    dict["area"] = volume.area;
    dict["covered"] = volume.covered;
    dict["cell"] = volume.cell;
    dict["base"] = planeDict(volume.base);
    return dict;
}

/// The profile as columns.
nb::dict profileDict(const std::vector<ProfilePoint>& points) {
    std::vector<double> stations, positions, heights, lows, highs;
    std::vector<std::uint32_t> layers;
    std::vector<std::uint8_t> hits;
    for (const ProfilePoint& point : points) {
        stations.push_back(point.station);
        positions.insert(positions.end(), point.position.begin(), point.position.end());
        heights.push_back(point.height);
        lows.push_back(point.low);
        highs.push_back(point.high);
        layers.push_back(point.layer);
        hits.push_back(point.hit);
    }
    nb::dict dict;
    dict["stations"] = owned(std::move(stations), 1);
    dict["positions"] = owned(std::move(positions), 3);
    dict["heights"] = owned(std::move(heights), 1);
    dict["lows"] = owned(std::move(lows), 1);
    dict["highs"] = owned(std::move(highs), 1);
    dict["layers"] = owned(std::move(layers), 1);
    dict["hits"] = owned(std::move(hits), 1);
    return dict;
}

nb::dict profileOf(const TraceScene& scene, const Points& line, const Position& up, double step, bool from_below,
                   std::optional<double> start_height, bool all, double apart, double width) {
    const std::vector<Position> corners = positionsOf(line);
    const ProfileRules rules{up,    step, from_below ? ProfileSide::kBelow : ProfileSide::kAbove, start_height, all,
                             apart, width};
    std::vector<ProfilePoint> points;
    {
        const nb::gil_scoped_release others_go_on;
        points = surfaceProfile(scene, corners, rules);
    }
    return profileDict(points);
}

nb::list contoursOf(const TraceScene& scene, const Position& up, double interval, double cell, double shortest) {
    std::vector<Contour> contours;
    {
        const nb::gil_scoped_release others_go_on;
        contours = surfaceContours(scene, {up, interval, cell, shortest});
    }
    nb::list list;
    for (const Contour& each : contours) {
        nb::dict dict;
        dict["height"] = each.height;
        dict["closed"] = each.closed;
        dict["index"] = each.is_index;
        dict["positions"] = rowsOf(each.points);
        list.append(dict);
    }
    return list;
}

nb::list sectionOf(const TraceScene& scene, const SectionPlane& plane, double step, double gap, double tolerance,
                   double shortest) {
    std::vector<SectionLine> lines;
    {
        const nb::gil_scoped_release others_go_on;
        lines = sectionLines(scene, plane, {step, gap, tolerance, shortest});
    }
    nb::list list;
    for (const SectionLine& each : lines) {
        nb::dict dict;
        dict["closed"] = each.closed;
        dict["positions"] = rowsOf(each.points);
        list.append(dict);
    }
    return list;
}

nb::ndarray<nb::numpy, double> snapped(const TraceScene& scene, const Points& points,
                                       const std::optional<Position>& up) {
    const std::vector<Position> given = positionsOf(points);
    std::vector<double> numbers;
    {
        const nb::gil_scoped_release others_go_on;
        for (const Position& point : up ? dropToSurface(scene, given, *up) : snapToSurface(scene, given))
            numbers.insert(numbers.end(), point.begin(), point.end());
    }
    return owned(std::move(numbers), 3);
}

void fillDistances(const TraceScene& scene, const Points& positions, const Normals& normals,
                   const std::optional<Radii>& radii, double most, const Distances& distances) {
    StudyPoints points{{positions.data(), positions.size()}, {normals.data(), normals.size()}};
    if (radii) points.radii = {radii->data(), radii->size()};
    const nb::gil_scoped_release others_go_on;
    surfaceDistances(scene, points, most, {distances.data(), distances.size()});
}

} // namespace

void bindMeasures(nb::module_& module) {
    module.def("measure_path", &pathDict, nb::arg("points"), nb::arg("up"));
    module.def(
        "fit_plane", [](const Points& points) { return planeDict(fitPlane(positionsOf(points))); }, nb::arg("points"));
    module.def("fit_circle", &circleDict, nb::arg("points"));
    module.def("fit_sphere", &sphereDict, nb::arg("points"));
    module.def("measure_volume", &volumeDict, nb::arg("scene"), nb::arg("rim"), nb::arg("up"),
               nb::arg("base_height").none(), nb::arg("cell"));
    module.def("surface_contours", &contoursOf, nb::arg("scene"), nb::arg("up"), nb::arg("interval"), nb::arg("cell"),
               nb::arg("shortest"));
    module.def(
        "section_lines",
        [](const TraceScene& scene, const std::string& plane, const Position& up, double step, double gap,
           double tolerance,
           double shortest) { return sectionOf(scene, sectionPlane(plane, up), step, gap, tolerance, shortest); },
        nb::arg("scene"), nb::arg("plane"), nb::arg("up"), nb::arg("step"), nb::arg("gap"), nb::arg("tolerance"),
        nb::arg("shortest"));
    module.def(
        "level_section_lines",
        [](const TraceScene& scene, double height, const Position& up, double step, double gap, double tolerance,
           double shortest) { return sectionOf(scene, levelPlane(height, up), step, gap, tolerance, shortest); },
        nb::arg("scene"), nb::arg("height"), nb::arg("up"), nb::arg("step"), nb::arg("gap"), nb::arg("tolerance"),
        nb::arg("shortest"));
    module.def("surface_profile", &profileOf, nb::arg("scene"), nb::arg("line"), nb::arg("up"), nb::arg("step"),
               nb::arg("from_below"), nb::arg("start_height").none(), nb::arg("all"), nb::arg("apart"),
               nb::arg("width"));
    module.def("snap_to_surface", &snapped, nb::arg("scene"), nb::arg("points"), nb::arg("up").none());
    module.def("surface_distances", &fillDistances, nb::arg("scene"), nb::arg("positions"), nb::arg("normals"),
               nb::arg("radii").none(), nb::arg("most"), nb::arg("distances"));
}

} // namespace pointrt::python
