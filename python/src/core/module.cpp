// SPDX-License-Identifier: Apache-2.0
#include "module.h"

#include "pointrt/pro.hpp"
#include "pointrt/trace.hpp"

namespace nb = nanobind;

namespace {

/// Bad usage becomes ValueError, everything else pointrt.Error.
void translateErrors(nb::module_& module) {
    static nb::object error = module.attr("Error");
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const pointrt::RayError& failure) {
            PyErr_SetString(PyExc_ValueError, failure.what());
        } catch (const pointrt::TraceError& failure) {
            const bool is_usage = failure.kind == pointrt::TraceError::Kind::kBadUsage;
            PyErr_SetString(is_usage ? PyExc_ValueError : error.ptr(), failure.what());
        } catch (const pointrt::ProError& failure) {
            PyErr_SetString(error.ptr(), failure.what());
        }
    });
}

} // namespace

NB_MODULE(_core, module) {
    module.doc() = "The native part of the package pointrt.";
    module.attr("Error") = nb::steal(PyErr_NewExceptionWithDoc(
        "pointrt.Error",
        "A file cannot be read, or the operation is not supported on this machine. The message is one line.",
        PyExc_RuntimeError, nullptr));
    translateErrors(module);
    pointrt::python::bindScene(module);
    pointrt::python::bindLidar(module);
    pointrt::python::bindRenderer(module);
    pointrt::python::bindStudies(module);
    pointrt::python::bindMeasures(module);
    pointrt::python::bindScanFile(module);
}
