// SPDX-License-Identifier: Apache-2.0
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <span>

#include "module.h"
#include "pointrt/trace.hpp"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

template <typename Number>
using Rays = nb::ndarray<const Number, nb::shape<-1, 6>, nb::c_contig, nb::device::cpu>;

template <typename Number>
RayRows rowsOf(const Rays<Number>& rays) {
    return std::span<const Number>(rays.data(), rays.size());
}

template <typename Number>
using Column = std::optional<nb::ndarray<Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>>;
template <typename Number>
using Triples = std::optional<nb::ndarray<Number, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>>;

/// The numbers of an array; an empty range for None.
template <typename Array>
auto numbersOf(const std::optional<Array>& array) {
    return array ? std::span(array->data(), array->size()) : std::span<typename Array::Scalar>();
}

/// Renumbers the ray of an error from its slice to the caller's rays.
template <typename Work>
void numbered(std::uint64_t first_ray, const Work& work) {
    const nb::gil_scoped_release others_go_on;
    try {
        work();
    } catch (const RayError& failure) {
        throw RayError(first_ray + failure.ray, failure.reason);
    }
}

template <typename Number>
void castRays(const TraceScene& scene, const Rays<Number>& rays, double t_min, double t_max, std::uint64_t first_ray,
              const Column<double>& t_hit, const Column<std::uint32_t>& splat_ids,
              const Column<std::uint32_t>& instance_ids, const Triples<float>& normals,
              const Triples<double>& positions, const Column<std::uint32_t>& tile_ids) {
    const HitArrays hits{numbersOf(t_hit),   numbersOf(splat_ids), numbersOf(instance_ids),
                         numbersOf(normals), numbersOf(positions), numbersOf(tile_ids)};
    numbered(first_ray, [&] { scene.castRays(rowsOf(rays), {t_min, t_max}, hits); });
}

template <typename Number>
void testOcclusions(const TraceScene& scene, const Rays<Number>& rays, double t_min, double t_max,
                    std::uint64_t first_ray, const Column<std::uint8_t>& occluded) {
    numbered(first_ray, [&] { scene.testOcclusions(rowsOf(rays), {t_min, t_max}, numbersOf(occluded)); });
}

using Numbers = nb::ndarray<const std::uint32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// @param values attribute.bytes for each hit
void readAttribute(const TraceScene& scene, const std::string& name, const Numbers& splats, const Numbers& instances,
                   const std::optional<Numbers>& tiles,
                   const nb::ndarray<std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>& values) {
    const nb::gil_scoped_release others_go_on;
    scene.readAttribute(name, {splats.data(), splats.size()}, {instances.data(), instances.size()}, numbersOf(tiles),
                        std::as_writable_bytes(std::span(values.data(), values.size())));
}

nb::list attributesOf(const TraceScene& scene) {
    nb::list rows;
    for (const SceneAttribute& each : scene.attributes())
        rows.append(nb::make_tuple(each.name, each.type, each.components, each.bytes));
    return rows;
}

/// Binds overloads for float32 and float64 rays.
template <typename Number>
void bindRays(nb::class_<TraceScene>& scene) {
    scene
        .def("cast_rays", &castRays<Number>, nb::arg("rays"), nb::arg("t_min"), nb::arg("t_max"), nb::arg("first_ray"),
             nb::arg("t_hit").none(), nb::arg("splat_ids").none(), nb::arg("instance_ids").none(),
             nb::arg("normals").none(), nb::arg("positions").none(), nb::arg("tile_ids").none())
        .def("test_occlusions", &testOcclusions<Number>, nb::arg("rays"), nb::arg("t_min"), nb::arg("t_max"),
             nb::arg("first_ray"), nb::arg("occluded"));
}

} // namespace

void bindScene(nb::module_& module) {
    module.attr("NO_HIT") = kNoHit;
    module.attr("DEFAULT_MEMORY") = SceneOptions{}.memory;
    nb::class_<TraceDevice>(
        module, "Device", "A Vulkan device: the best one, or the one that selector names, as in pointrt-view --device.")
        .def(nb::init<const std::string&>(), nb::arg("selector") = "", nb::call_guard<nb::gil_scoped_release>())
        .def_prop_ro("name", &TraceDevice::name);
    nb::class_<TraceScene> scene(module, "Scene", "The native part of pointrt.Scene; callers allocate arrays.");
    scene
        .def(
            "__init__",
            [](TraceScene* place, const TraceDevice& device, const std::vector<std::string>& paths,
               std::uint64_t memory, const std::vector<std::array<double, 6>>& clips,
               const std::vector<std::string>& filters) {
                new (place) TraceScene(device, paths, {memory, clips, filters});
            },
            nb::arg("device"), nb::arg("paths"), nb::arg("memory"), nb::arg("clips"), nb::arg("filters"),
            nb::call_guard<nb::gil_scoped_release>())
        .def("read_attribute", &readAttribute, nb::arg("name"), nb::arg("splat_ids"), nb::arg("instance_ids"),
             nb::arg("tile_ids").none(), nb::arg("values"))
        .def("attributes", &attributesOf, "(name, PRO_TYPE_*, components, bytes of a splat's) of each.")
        .def_prop_ro("splat_count", &TraceScene::splatCount)
        .def_prop_ro("instance_count", &TraceScene::instanceCount)
        .def_prop_ro("has_tiles", &TraceScene::hasTiles)
        .def_prop_ro("tile_loads", &TraceScene::tileLoads)
        .def_prop_ro("device_bytes", &TraceScene::deviceBytes);
    bindRays<double>(scene);
    bindRays<float>(scene);
}

} // namespace pointrt::python
