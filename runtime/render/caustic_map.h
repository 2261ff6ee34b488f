// SPDX-License-Identifier: Apache-2.0
// A photon map on the device.
#pragma once

#include <vector>

#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/render/photon_map.h"
#include "shaders/shared/photon_layout.h"

namespace pointrt {

struct CausticMap {
    Buffer photons, buckets;
    Buffer traced; ///< where photons in flight are kept; as small as can be where none are
    gpu::CausticFrame frame{};
};

CausticMap uploadCaustics(Device& device, PhotonMap map);
/// A map without photons.
CausticMap emptyCaustics(Device& device);
void destroyCaustics(Device& device, CausticMap& map);

/// At their places in shaders/lib/bindings.glsl.
std::vector<BufferBinding> causticBindings(const CausticMap& map);
std::uint64_t deviceBytes(const CausticMap& map);

} // namespace pointrt
