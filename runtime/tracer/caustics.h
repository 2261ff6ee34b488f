// SPDX-License-Identifier: Apache-2.0
// Caustics: photons traced from the lights by way of mirrors and glass, kept where they meet what scatters light.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/program.h"
#include "runtime/tracer/programs.h"

namespace pointrt {

/// Photons that set out for a picture: what a core traces in a second or two.
constexpr std::uint32_t kPhotons = 1u << 20;

/// A photon map on the device.
struct CausticMap {
    Buffer photons, buckets;
    Buffer traced; ///< where photons in flight are kept; as small as can be outside of buildCaustics
    gpu::CausticFrame frame{};
};

/// A map without photons.
CausticMap emptyCaustics(Device& device);

/// Traces about count photons, fewer in scenes of many instances. It depends on the scene alone: camera and image do
/// not matter.
CausticMap buildCaustics(Device& device, const DeviceScene& scene, const Programs& programs, std::uint32_t count);

/// At their places in shaders/frame/bindings.glsl.
std::vector<BufferBinding> causticBindings(const CausticMap& map);
void destroyCaustics(Device& device, CausticMap& map);

} // namespace pointrt
