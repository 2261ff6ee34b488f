// SPDX-License-Identifier: Apache-2.0
// Caustics: photons traced from the lights through mirrors and glass, stored where they hit a surface that scatters
// light. The samples of a picture use a sequence of photon maps (runtime/render/map_schedule.h), which are traced on
// demand, in steps.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/caustic_map.h"
#include "runtime/render/programs.h"

namespace pointrt {

/// Photons emitted for a map: two cores trace them in half a second to a second.
constexpr std::uint32_t kPhotons = 1u << 20;

/// Which photon map to trace.
struct CausticOrder {
    std::uint32_t count = kPhotons; ///< approximate number of photons; fewer in scenes of many instances
    std::uint32_t map = 0, seed = 0;
    double finest = 0; ///< PhotonDiscs::finest
};

/// A photon map being traced. It depends on the scene and the CausticOrder, not on camera or image.
class CausticJob {
public:
    /// device, scene and programs must outlive it unchanged.
    CausticJob(Device& device, const DeviceScene& scene, const Programs& programs, const CausticOrder& order);
    ~CausticJob();
    CausticJob(const CausticJob&) = delete;
    CausticJob& operator=(const CausticJob&) = delete;

    std::uint32_t map() const;
    /// Does some 10 ms of work; false once the map is complete.
    bool step();
    /// The map; call once, after the last step.
    CausticMap take(double& finest);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The maps of a scene.
struct CausticMaps {
    CausticMap first;               ///< for the first samples of every picture
    CausticMap later;               ///< one of the later maps
    std::uint32_t later_number = 0; ///< 0: none
    bool shows_later = false;
    std::uint32_t seed = 0;          ///< of all maps
    double finest = 0;               ///< of all maps, CausticOrder::finest
    std::unique_ptr<CausticJob> job; ///< a later map being traced, or null
};

const CausticMap& shownMap(const CausticMaps& maps);
std::uint64_t deviceBytes(const CausticMaps& maps);
void destroyCaustics(Device& device, CausticMaps& maps);

} // namespace pointrt
