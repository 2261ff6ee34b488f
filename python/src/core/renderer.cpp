// SPDX-License-Identifier: Apache-2.0
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <utility>
#include <vector>

#include "module.h"
#include "pointrt/render.hpp"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

/// Hands numbers to Python as [height, width] or, with several channels, [height, width, channels].
template <typename Number>
nb::object arrayOf(std::vector<Number> numbers, const Picture& picture, std::size_t channels) {
    auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
    Number* const at = kept->data();
    nb::capsule owner(kept.release(), [](void* memory) noexcept { delete static_cast<std::vector<Number>*>(memory); });
    const std::size_t shape[] = {picture.height, picture.width, channels};
    return nb::cast(nb::ndarray<nb::numpy, Number>(at, channels == 1 ? 2 : 3, shape, owner));
}

nb::dict dictOf(Picture picture) {
    nb::dict arrays;
    for (PictureLayer& layer : picture.layers) {
        const std::size_t channels = layer.kind.channels.size();
        arrays[layer.kind.name.c_str()] = layer.kind.is_words ? arrayOf(std::move(layer.words), picture, channels)
                                                              : arrayOf(std::move(layer.floats), picture, channels);
    }
    return arrays;
}

/// Whether Ctrl-C was pressed; keeps the exception of Python for the caller.
bool isInterrupted() {
    const nb::gil_scoped_acquire held;
    return PyErr_CheckSignals() != 0;
}

nb::dict render(PictureRenderer& renderer, const PictureCamera& camera, std::uint32_t width, std::uint32_t height,
                const std::vector<std::string>& layers) {
    Picture picture;
    bool interrupted = false;
    try {
        const nb::gil_scoped_release others_go_on;
        picture = renderer.render(camera, width, height, layers,
                                  [&] { return interrupted = interrupted || isInterrupted(); });
    } catch (const TraceError&) {
        if (interrupted) throw nb::python_error();
        throw;
    }
    return dictOf(std::move(picture));
}

using Vector = std::optional<std::array<double, 3>>;

nb::dict renderLookAt(PictureRenderer& renderer, const Vector& eye, const Vector& target, const Vector& up,
                      const std::optional<double>& fov_deg, std::uint32_t width, std::uint32_t height,
                      const std::vector<std::string>& layers) {
    return render(renderer, LookAt{eye, target, up, fov_deg}, width, height, layers);
}

nb::dict renderPinhole(PictureRenderer& renderer, const std::array<double, 4>& lens,
                       const std::array<double, 16>& world_from_camera, std::uint32_t width, std::uint32_t height,
                       const std::vector<std::string>& layers) {
    const PinholeCamera camera{lens[0], lens[1], lens[2], lens[3], world_from_camera};
    return render(renderer, camera, width, height, layers);
}

nb::list layerRows() {
    nb::list rows;
    for (const PictureLayerKind& kind : pictureLayers()) rows.append(nb::make_tuple(kind.name, kind.channels));
    return rows;
}

} // namespace

void bindRenderer(nb::module_& module) {
    module.def("picture_layers", &layerRows, "(name, channels in OpenEXR files) of each layer.");
    nb::class_<PictureRenderer>(module, "Renderer", "The native part of pointrt.Scene.render.")
        .def(nb::init<const TraceDevice&, const std::vector<std::string>&, const PictureSettings&>(), nb::arg("device"),
             nb::arg("paths"), nb::arg("settings"), nb::call_guard<nb::gil_scoped_release>())
        .def("render_look_at", &renderLookAt, nb::arg("eye").none(), nb::arg("target").none(), nb::arg("up").none(),
             nb::arg("fov_deg").none(), nb::arg("width"), nb::arg("height"), nb::arg("layers"))
        .def("render_pinhole", &renderPinhole, nb::arg("lens"), nb::arg("world_from_camera"), nb::arg("width"),
             nb::arg("height"), nb::arg("layers"));
}

} // namespace pointrt::python
