// SPDX-License-Identifier: Apache-2.0
// Caustics: photons traced from the lights by way of mirrors and glass, kept where they meet what scatters light. A
// picture's samples show one map of them after another (runtime/render/map_schedule.h), which are traced as they come
// to be needed, in steps.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/caustic_map.h"
#include "runtime/render/programs.h"

namespace pointrt {

/// Photons that set out for a map: what two cores trace in half a second to a second.
constexpr std::uint32_t kPhotons = 1u << 20;

/// Which map is to be traced.
struct CausticOrder {
    std::uint32_t count = kPhotons; ///< of photons, about; scenes of many instances get fewer
    std::uint32_t map = 0, seed = 0;
    double finest = 0; ///< PhotonDiscs::finest
};

/// A map under way. It depends on the scene and the order alone: camera and image do not matter.
class CausticJob {
public:
    /// device, scene and programs must outlive it, and not change.
    CausticJob(Device& device, const DeviceScene& scene, const Programs& programs, const CausticOrder& order);
    ~CausticJob();
    CausticJob(const CausticJob&) = delete;
    CausticJob& operator=(const CausticJob&) = delete;

    std::uint32_t map() const;
    /// Some 10 ms of work; false where the map is there.
    bool step();
    /// The map, once: after the last step.
    CausticMap take(double& finest);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The maps of a scene.
struct CausticMaps {
    CausticMap first;               ///< that every picture begins with
    CausticMap later;               ///< one of those that follow
    std::uint32_t later_number = 0; ///< 0: there is none
    bool shows_later = false;
    std::uint32_t seed = 0;          ///< of first, and so of all
    double finest = 0;               ///< likewise, CausticOrder::finest
    std::unique_ptr<CausticJob> job; ///< a later one, where one is under way
};

const CausticMap& shownMap(const CausticMaps& maps);
std::uint64_t deviceBytes(const CausticMaps& maps);
void destroyCaustics(Device& device, CausticMaps& maps);

} // namespace pointrt
