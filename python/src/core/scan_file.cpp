// SPDX-License-Identifier: Apache-2.0
// A memory-mapped .pro file. Arrays are views of the file, which stays mapped while one of them exists.
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>

#include "module.h"
#include "pointrt/pro.hpp"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

using Array = nb::ndarray<nb::numpy, nb::ro>;

nb::dlpack::dtype dtypeOf(std::uint32_t type) {
    switch (type) {
    case PRO_TYPE_U8:
        return nb::dtype<std::uint8_t>();
    case PRO_TYPE_I8:
        return nb::dtype<std::int8_t>();
    case PRO_TYPE_U16:
        return nb::dtype<std::uint16_t>();
    case PRO_TYPE_I16:
        return nb::dtype<std::int16_t>();
    case PRO_TYPE_U32:
        return nb::dtype<std::uint32_t>();
    case PRO_TYPE_I32:
        return nb::dtype<std::int32_t>();
    case PRO_TYPE_I64:
        return nb::dtype<std::int64_t>();
    case PRO_TYPE_U64:
        return nb::dtype<std::uint64_t>();
    case PRO_TYPE_F32:
        return nb::dtype<float>();
    default:
        return nb::dtype<double>();
    }
}

Array viewOf(nb::handle file, const void* data, std::size_t rows, std::size_t columns, nb::dlpack::dtype type) {
    const std::size_t shape[] = {rows, columns};
    return {const_cast<void*>(data), columns == 1 ? std::size_t{1} : std::size_t{2}, shape, file, nullptr, type};
}

Array splatWords(nb::handle self) {
    const auto& file = nb::cast<const ProFile&>(self);
    return viewOf(self, file.view().splats, file.info().splat_count, PRO_SPLAT_WORDS, nb::dtype<std::uint32_t>());
}

nb::dict attributesOf(nb::handle self) {
    const auto& file = nb::cast<const ProFile&>(self);
    nb::dict attributes;
    for (const pro_attribute& each : file.attributes())
        attributes[each.name] = viewOf(self, each.values, file.info().splat_count, each.components, dtypeOf(each.type));
    return attributes;
}

template <typename Number>
nb::ndarray<nb::numpy, Number> owned(std::unique_ptr<Number[]> numbers, std::size_t rows, std::size_t columns) {
    Number* const at = numbers.release();
    nb::capsule owner(at, [](void* memory) noexcept { delete[] static_cast<Number*>(memory); });
    const std::size_t shape[] = {rows, columns};
    return nb::ndarray<nb::numpy, Number>(at, columns == 1 ? 1 : 2, shape, owner);
}

/// positions float64 [N,3], normals float32 [N,3], radii float32 [N], colors uint8 [N,3].
nb::dict decoded(const ProFile& file) {
    const std::size_t count = file.info().splat_count;
    auto positions = std::make_unique_for_overwrite<double[]>(3 * count);
    auto normals = std::make_unique_for_overwrite<float[]>(3 * count);
    auto radii = std::make_unique_for_overwrite<float[]>(count);
    auto colors = std::make_unique_for_overwrite<std::uint8_t[]>(3 * count);
    {
        const nb::gil_scoped_release others_go_on;
        for (std::size_t i = 0; i < count; ++i) {
            const pro_splat splat = file.splat(i);
            const std::array<double, 3> position = file.position(splat);
            std::copy(position.begin(), position.end(), &positions[3 * i]);
            std::copy(std::begin(splat.normal), std::end(splat.normal), &normals[3 * i]);
            std::copy(std::begin(splat.color), std::end(splat.color), &colors[3 * i]);
            radii[i] = static_cast<float>(file.radius(splat));
        }
    }
    nb::dict splats;
    splats["positions"] = owned(std::move(positions), count, 3);
    splats["normals"] = owned(std::move(normals), count, 3);
    splats["radii"] = owned(std::move(radii), count, 1);
    splats["colors"] = owned(std::move(colors), count, 3);
    return splats;
}

std::array<std::array<double, 3>, 2> boundsOf(const ProFile& file) {
    const pro_info& info = file.info();
    return {std::to_array(info.bounds_min), std::to_array(info.bounds_max)};
}

} // namespace

void bindScanFile(nb::module_& module) {
    nb::class_<ProFile>(module, "ScanFile",
                        "A memory-mapped and validated .pro file. Arrays are views of it unless stated otherwise.")
        .def(nb::init<const std::string&>(), nb::arg("path"), nb::call_guard<nb::gil_scoped_release>())
        .def("__len__", [](const ProFile& file) { return file.info().splat_count; })
        .def_prop_ro("splat_words", &splatWords, "uint32 [N,4], read-only: the splats as format/SPEC.md lays them out.")
        .def_prop_ro("attributes", &attributesOf,
                     "Read-only arrays [N] or [N,components] by name, with the types of the scan.")
        .def("decode", &decoded,
             "A copy of the splats as numbers: positions float64 [N,3] and radii float32 [N] in the scan's unit, "
             "normals "
             "float32 [N,3] of unit length, colors uint8 [N,3] sRGB.")
        .def_prop_ro("bounds", &boundsOf, "Lowest and highest corner, in the scan's unit.");
}

} // namespace pointrt::python
