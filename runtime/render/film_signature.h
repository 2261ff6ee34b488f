// SPDX-License-Identifier: Apache-2.0
// The signature of a film: a text with everything that determines its samples. Films with the same signature can be
// added.
#pragma once

#include <string>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/kernel_form.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// "name=value; ..." for everything that determines sample number n: the version of the renderer, the camera, the
/// settings whose row in render_setting_table.h says so, one XXH3-64 of the scene file's bytes, the header checksums of
/// the .pro files (which cover those of their sections) and the sky image, and the kernel form unless it is wavefront.
/// Not the number of samples, but whether a single one is taken at the pixel centre. Throws Error kBadInput if a file
/// cannot be read.
std::string filmSignature(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                          KernelForm form);

/// The kernel form of the film with that signature.
KernelForm formOf(const std::string& signature);

/// "NAME was VALUE and is VALUE" of the first entry that differs; "" if all agree.
std::string signatureDifference(const std::string& before, const std::string& now);

} // namespace pointrt
