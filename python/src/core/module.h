// SPDX-License-Identifier: Apache-2.0
// The parts of the module pointrt._core.
#pragma once

#include <nanobind/nanobind.h>

namespace pointrt::python {

/// Device and Scene.
void bindScene(nanobind::module_& module);
/// Simulated laser scanners. Call it after bindScene.
void bindLidar(nanobind::module_& module);
/// Renderer.
void bindRenderer(nanobind::module_& module);
/// Studies: lights, occlusion and visibility.
void bindStudies(nanobind::module_& module);
/// Measures of paths, fits, volumes, profiles and distances. Call it after bindScene.
void bindMeasures(nanobind::module_& module);
/// ScanFile.
void bindScanFile(nanobind::module_& module);

} // namespace pointrt::python
