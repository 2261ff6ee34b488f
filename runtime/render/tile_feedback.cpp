// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/tile_feedback.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// The approximate number of pixels of the low-resolution pictures, which take little time; and the inverse of the
/// share of rays that must hit a tile for it to count.
constexpr double kPixels = 1 << 15;
constexpr std::uint64_t kHitShare = 100;

RenderSettings smallPicture(RenderSettings settings) {
    const double width = settings.width, height = settings.height;
    const double share = std::min(1.0, std::sqrt(kPixels / (width * height)));
    settings.width = static_cast<std::uint32_t>(std::max(1.0, share * width));
    settings.height = static_cast<std::uint32_t>(std::max(1.0, share * height));
    return settings;
}

class HitCounter {
public:
    HitCounter(Device& device, BandTracer& tracer)
        : device_(device), tracer_(tracer), counts_(tracer.scene->instances.size()) {
        hits_ = createBuffer(device, "tile hit counts", counts_.size() * sizeof counts_[0],
                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        tracer_.hit_counts = &hits_;
    }
    HitCounter(const HitCounter&) = delete;
    HitCounter& operator=(const HitCounter&) = delete;
    ~HitCounter() {
        tracer_.hit_counts = nullptr;
        destroyBuffer(device_, hits_);
    }

    /// Renders a picture and adds to sums the secondary rays that hit each of the tracer's instances.
    void addPicture(const RenderSettings& settings, const Camera& camera, std::vector<std::uint64_t>& sums) {
        BandSample sample =
            openBand(tracer_, settings, camera, {0, settings.height}, {settings.width * settings.height, 0});
        sample.at_centers = true;
        RayCounts rays;
        tracePasses(device_, tracer_, sample, 0, rays);
        while (!sample.done) {
            tracePasses(device_, tracer_, sample, 1, rays);
            downloadBuffer(device_, hits_, counts_.data(), hits_.bytes);
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += counts_[i];
        }
    }

private:
    Device& device_;
    BandTracer& tracer_;
    std::vector<std::uint32_t> counts_;
    Buffer hits_;
};

} // namespace

bool markTilesHit(Device& device, BandTracer& tracer, DeviceScene& scene, const RenderSettings& settings,
                  const std::vector<Camera>& cameras) {
    if (!tracer.programs.has_secondary_rays || tracer.instances.each.empty()) return false;
    const RenderSettings small = smallPicture(settings);
    std::vector<std::uint64_t> hits(scene.instances.size());
    HitCounter counter(device, tracer);
    for (const Camera& camera : cameras) counter.addPicture(small, camera, hits);
    const std::uint64_t pixels = std::uint64_t{small.width} * small.height * cameras.size();
    bool others = false;
    for (const Instance& instance : scene.instances) {
        if (!instance.tile || hits[instance.place] * kHitShare < pixels) continue;
        OpenedSet& set = std::find_if(scene.sets.begin(), scene.sets.end(), [&](const SceneSet& each) {
                             return each.number == instance.number;
                         })->opened;
        others |= !set.hit_unseen[*instance.tile] && !set.children[*instance.tile].empty();
        set.hit_unseen[*instance.tile] = true;
    }
    return others;
}

} // namespace pointrt
