// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/given_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "runtime/cast/ray_interval.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

constexpr std::size_t kNumbers = 6, kTexelBytes = 16;

constexpr gpu::GivenHit kMiss{kInfinity, NO_INDEX, 0};

gpu::GivenPush pushOf(const RayFrame& frame, const RayLimits& limits, std::size_t rays) {
    const double scale = frame.space.scale;
    const Vec3 middle = worldPoint(frame.space, {0.5, 0.5, 0.5});
    gpu::GivenPush push{};
    push.origin_x = middle.x;
    push.origin_y = middle.y;
    push.origin_z = middle.z;
    push.scale = scale;
    push.t_min = limits.t_min;
    push.t_max = limits.t_max;
    push.units = static_cast<float>(1 / scale);
    push.radius = static_cast<float>(0.5001 * std::sqrt(3.0) * scale); // half the diagonal, rounded up
    push.rays = static_cast<std::uint32_t>(rays);
    return push;
}

/// Initialises the results: programs write only hits.
void putMisses(CastSlot& slot, std::size_t count, bool any_hit) {
    if (any_hit)
        std::fill_n(static_cast<std::uint32_t*>(slot.occluded.mapped), count, 0u);
    else
        std::fill_n(static_cast<gpu::GivenHit*>(slot.hits.mapped), count, kMiss);
    flushBuffer(slot.device, any_hit ? slot.occluded : slot.hits);
}

} // namespace

bool takesGiven(const Device& device, const ResidentInstance& instance) {
    // given rays start at the sphere around the cube, and Gaussians may lie in front of it
    const bool is_in_sphere = !instance.scan->reaches_out;
    return device.doubles && instance.in_cube && is_in_sphere && !isPaged(instance.traits.pages);
}

GivenRays::GivenRays(Device& device, const RayRows& rays) : device_(device), rays_(rays) {
    if (device.unified_memory && device.external_memory_host && rays.count > 0) import();
}

std::size_t GivenRays::bytesOf(std::size_t rays) const {
    return rays * kNumbers * (rays_.doubles ? sizeof(double) : sizeof(float));
}

/// Imports whole pages as whole texels; they may include bytes before and after the rays.
void GivenRays::import() {
    const auto address = reinterpret_cast<std::uintptr_t>(bytes());
    offset_ = address % device_.host_import_alignment;
    const std::size_t texels = (offset_ + bytesOf(rays_.count) + kTexelBytes - 1) / kTexelBytes;
    if (offset_ % kTexelBytes != 0 || texels > device_.limits.maxTexelBufferElements) return;
    imported_ =
        importHostBuffer(device_, bytes() - offset_, texels * kTexelBytes, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    if (imported_.handle) createTexelView(device_, "caller's rays", imported_, VK_FORMAT_R32G32B32A32_UINT);
}

void GivenRays::trace(CastSlot& slot, CastPrograms& programs, const ResidentInstance& instance, const RayLimits& limits,
                      std::size_t first, std::size_t count, bool any_hit) const {
    gpu::GivenPush push = pushOf(instance.frame, limits, count);
    if (imported_.handle)
        push.first_texel = static_cast<std::uint32_t>((offset_ + bytesOf(first)) / kTexelBytes);
    else
        std::copy_n(bytes() + bytesOf(first), bytesOf(count), slot.givenBytes().data());
    putMisses(slot, count, any_hit);
    traceRows(slot, programs, instance, imported_.handle ? imported_ : slot.rays,
              rays_.doubles ? RayForm::kDoubles : RayForm::kFloats, push, any_hit);
}

bool putGiven(const CastSlot& slot, const InstanceList& list, const RayRows& rays, std::size_t first, std::size_t count,
              const HitArrays& arrays) {
    const std::span<const gpu::GivenHit> found = slot.givenHits(count);
    const CastInstance& instance = list.instances[0];
    const bool vectors = !arrays.normals.empty() || !arrays.positions.empty();
    bool odd = false;
    for (std::size_t i = 0; i < count; ++i) {
        const gpu::GivenHit hit = found[i];
        const bool is_hit = hit.splat != NO_INDEX;
        odd |= hit.splat == CAST_ODD;
        if (!arrays.t_hit.empty()) arrays.t_hit[first + i] = hit.t;
        if (!arrays.splat_ids.empty()) arrays.splat_ids[first + i] = hit.splat;
        if (!arrays.instance_ids.empty()) arrays.instance_ids[first + i] = is_hit ? instance.scene_instance : kNoHit;
        if (!arrays.tile_ids.empty()) arrays.tile_ids[first + i] = is_hit ? instance.tile : kNoHit;
        if (vectors) putVectors(list, rays, first + i, {hit.t, is_hit ? 0 : kNothing, hit.splat, hit.normal}, arrays);
    }
    return !odd;
}

bool putOccluded(const CastSlot& slot, std::span<std::uint8_t> occluded) {
    const std::span<const std::uint32_t> found = slot.occludedRows(occluded.size());
    bool odd = false;
    for (std::size_t i = 0; i < occluded.size(); ++i) {
        const std::uint32_t each = found[i];
        odd |= each == CAST_ODD;
        occluded[i] = each != 0;
    }
    return !odd;
}

} // namespace pointrt
