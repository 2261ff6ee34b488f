// SPDX-License-Identifier: Apache-2.0
#include "pointrt/studies.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "module.h"
#include "owned_array.h"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

template <typename Number>
using Rows = nb::ndarray<const Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <typename Number>
using Triples = nb::ndarray<const Number, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
template <typename Number>
using Results = nb::ndarray<Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Vector = std::array<double, 3>;

template <typename Array>
auto numbersOf(const std::optional<Array>& array) {
    return array ? std::span(array->data(), array->size()) : std::span<typename Array::Scalar>();
}

nb::tuple lightsTuple(Lights lights) {
    return nb::make_tuple(owned(std::move(lights.directions), 3), owned(std::move(lights.weights), 1));
}

using Date = std::tuple<int, unsigned, unsigned>;

CalendarDate dateOf(const Date& date) { return {std::get<0>(date), std::get<1>(date), std::get<2>(date)}; }

nb::tuple sunLightsTuple(double latitude_deg, double longitude_deg, const Date& first, const Date& last,
                         double every_min, std::optional<double> utc_offset_h, const Vector& up, const Vector& north) {
    return lightsTuple(sunLights({{latitude_deg, longitude_deg}, dateOf(first), dateOf(last), every_min, utc_offset_h},
                                 {up, north, {}}));
}

/// Returns None at the end.
std::optional<nb::dict> nextPoints(ScenePointReader& reader, std::size_t most) {
    ScenePoints points;
    {
        const nb::gil_scoped_release others_go_on;
        if (!reader.next(points, most)) return std::nullopt;
    }
    nb::dict dict;
    dict["positions"] = owned(std::move(points.positions), 3);
    dict["normals"] = owned(std::move(points.normals), 3);
    dict["radii"] = owned(std::move(points.radii), 1);
    if (!points.noise.empty()) dict["noise"] = owned(std::move(points.noise), 1);
    dict["splat_ids"] = owned(std::move(points.splat_ids), 1);
    dict["instance_ids"] = owned(std::move(points.instance_ids), 1);
    dict["tile_ids"] = owned(std::move(points.tile_ids), 1);
    return dict;
}

/// Points and rules from Python.
struct GivenPoints {
    StudyPoints points;
    StudyRules rules;
};

GivenPoints givenPoints(const Triples<double>& positions, const std::optional<Triples<float>>& normals,
                        const std::optional<Rows<float>>& radii, const std::optional<Rows<float>>& noise,
                        bool both_sides, const Vector& up, double radius) {
    return {{{positions.data(), positions.size()}, numbersOf(normals), numbersOf(radii), numbersOf(noise)},
            {both_sides ? Sides::kBoth : Sides::kFront, up, radius}};
}

void addLights(const TraceScene& scene, const Triples<double>& positions, const std::optional<Triples<float>>& normals,
               const std::optional<Rows<float>>& radii, const std::optional<Rows<float>>& noise, bool both_sides,
               const Vector& up, double radius, const Triples<double>& directions, const Rows<double>& weights,
               const Results<double>& sums) {
    const GivenPoints given = givenPoints(positions, normals, radii, noise, both_sides, up, radius);
    const Lights lights{{directions.data(), directions.data() + directions.size()},
                        {weights.data(), weights.data() + weights.size()}};
    const nb::gil_scoped_release others_go_on;
    sumLights(scene, given.points, lights, given.rules, {sums.data(), sums.size()});
}

void findVisible(const TraceScene& scene, const Triples<double>& positions,
                 const std::optional<Triples<float>>& normals, const std::optional<Rows<float>>& radii,
                 const std::optional<Rows<float>>& noise, bool both_sides, const Vector& up, double radius,
                 const Vector& eye, double reach, const Results<std::uint8_t>& visible) {
    const GivenPoints given = givenPoints(positions, normals, radii, noise, both_sides, up, radius);
    const nb::gil_scoped_release others_go_on;
    testSight(scene, given.points, {eye, reach}, given.rules, {visible.data(), visible.size()});
}

} // namespace

void bindStudies(nb::module_& module) {
    module.def("sun_lights", &sunLightsTuple, nb::arg("latitude_deg"), nb::arg("longitude_deg"), nb::arg("first"),
               nb::arg("last"), nb::arg("every_min"), nb::arg("utc_offset_h").none(), nb::arg("up"), nb::arg("north"),
               "(directions float64 [N,3], weights float64 [N]: hours)");
    module.def(
        "sky_lights",
        [](std::size_t count, const Vector& up, const Vector& north) {
            return lightsTuple(skyLights(count, {up, north, {}}));
        },
        nb::arg("count"), nb::arg("up"), nb::arg("north"), "(directions float64 [N,3], weights float64 [N]: sum 1)");
    module.def(
        "study_frame",
        [](const std::string& path, double latitude_deg, double longitude_deg, std::optional<Vector> up,
           std::optional<Vector> north) {
            const StudyFrame frame = studyFrame(path, {latitude_deg, longitude_deg}, up, north);
            return std::tuple(frame.up, frame.north, frame.note);
        },
        nb::arg("path"), nb::arg("latitude_deg"), nb::arg("longitude_deg"), nb::arg("up").none(),
        nb::arg("north").none(), "(up, north, how north was found)");
    module.def("scan_up", &scanUp, nb::arg("path"));
    module.def(
        "are_oriented", [](const std::vector<std::string>& paths) { return sidesOf(paths) == Sides::kFront; },
        nb::arg("paths"));
    module.def("median_radius", &medianRadius, nb::arg("paths"), nb::call_guard<nb::gil_scoped_release>());
    nb::class_<ScenePointReader>(module, "ScenePointReader", "The points of a scene, block by block.")
        .def(nb::init<const std::vector<std::string>&>(), nb::arg("paths"), nb::call_guard<nb::gil_scoped_release>())
        .def("next", &nextPoints, nb::arg("most"),
             "A dict of positions float64 [N,3], normals float32 [N,3], radii float32 [N], noise float32 [N] where "
             "some have noise, splat_ids, instance_ids and tile_ids uint32 [N]; None after the last.");
    module.def("add_lights", &addLights, nb::arg("scene"), nb::arg("positions"), nb::arg("normals").none(),
               nb::arg("radii").none(), nb::arg("noise").none(), nb::arg("both_sides"), nb::arg("up"),
               nb::arg("radius"), nb::arg("directions"), nb::arg("weights"), nb::arg("sums"));
    module.def("find_visible", &findVisible, nb::arg("scene"), nb::arg("positions"), nb::arg("normals").none(),
               nb::arg("radii").none(), nb::arg("noise").none(), nb::arg("both_sides"), nb::arg("up"),
               nb::arg("radius"), nb::arg("eye"), nb::arg("reach"), nb::arg("visible"));
}

} // namespace pointrt::python
