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
    Buffer traced; ///< photons in flight; of minimal size if there are none
    gpu::CausticFrame frame{};
};

CausticMap uploadCaustics(Device& device, PhotonMap map);
/// A map without photons.
CausticMap emptyCaustics(Device& device);
void destroyCaustics(Device& device, CausticMap& map);

/// Bindings as in shaders/lib/bindings.glsl.
std::vector<BufferBinding> causticBindings(const CausticMap& map);
std::uint64_t deviceBytes(const CausticMap& map);

} // namespace pointrt
