// SPDX-License-Identifier: Apache-2.0
// What a film is of, as text: films with the same signature can be added up.
#pragma once

#include <string>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/form_of_passes.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// "name=value; ..." with all that decides what a sample with a given number is: the renderer's version, the camera,
/// the settings whose row in render_setting_table.h says so, and one XXH3-64 of the scene file's bytes, the header
/// checksums of the .pro files (which cover those of their sections) and the sky image. Not the number of samples,
/// but whether one is taken at the pixel's centre. And the form of the passes, where that is not the queued one. Throws
/// Error kBadInput where a file cannot be read.
std::string filmSignature(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                          PassForm form);

/// The form of the passes of the film with that signature.
PassForm formOf(const std::string& signature);

/// "NAME was VALUE and is VALUE" of the first entry that differs; "" where all agree.
std::string signatureDifference(const std::string& before, const std::string& now);

} // namespace pointrt
