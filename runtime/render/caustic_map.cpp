// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/caustic_map.h"

#include <utility>

#include "runtime/util/on_error.h"
#include "shaders/shared/bindings.h"

namespace pointrt {

CausticMap uploadCaustics(Device& device, PhotonMap sorted) {
    CausticMap map;
    const OnError undo([&] { destroyCaustics(device, map); });
    map.frame = sorted.frame;
    map.photons = createTexelRows(device, "photon buffer", std::move(sorted.photons), VK_FORMAT_R32G32B32A32_UINT);
    map.buckets = createTexelRows(device, "photon buckets", std::move(sorted.buckets), VK_FORMAT_R32_UINT);
    map.traced = createBuffer(device, "traced photon buffer", sizeof(gpu::Photon), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    return map;
}

CausticMap emptyCaustics(Device& device) { return uploadCaustics(device, {}); }

void destroyCaustics(Device& device, CausticMap& map) {
    for (Buffer* buffer : {&map.photons, &map.buckets, &map.traced}) destroyBuffer(device, *buffer);
    map = {};
}

std::vector<BufferBinding> causticBindings(const CausticMap& map) {
    return {
        {BINDING_PHOTON_TEXELS, &map.photons}, {BINDING_PHOTON_BUCKETS, &map.buckets}, {BINDING_PHOTONS, &map.traced}};
}

std::uint64_t deviceBytes(const CausticMap& map) { return map.photons.bytes + map.buckets.bytes; }

} // namespace pointrt
