// SPDX-License-Identifier: Apache-2.0
// Cameras as text, as pasted by Ctrl+V. The text written for a camera must parse to the same camera.
#include <optional>

#include "runtime/window/input/camera_text.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(camera_text) {
    std::optional<ViewCamera> view;
    fuzz::expectReadOrRefused("camera text",
                              [&] { view = withCameraText(ViewCamera{}, std::string(fuzz::textOf(input))); });
    if (view) withCameraText(*view, cameraText(*view));
}
