// SPDX-License-Identifier: Apache-2.0
// Renders a scene that is loaded once from a series of cameras, at any sizes.
#pragma once

#include <cstdint>

#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"

namespace pointrt {

/// A picture of a series and the parts of its film.
struct SeriesShot {
    Camera camera;
    PixelSize size;
    bool first_hits = true, light_parts = true; ///< as in RenderSettings
};

class CameraSeries {
public:
    /// loaded must outlive it, and have a tracer with room for its settings' size. device: for the calling thread.
    /// memory: bytes for the tiles of its sets.
    CameraSeries(Device& device, LoadedScene& loaded, std::uint64_t memory);
    CameraSeries(const CameraSeries&) = delete;
    CameraSeries& operator=(const CameraSeries&) = delete;

    /// Renders the shot with the settings of the loaded scene and job. Bit-identical to loading the scene for this
    /// shot, except that surroundings stay in place. state() shows whether job.interrupted ended it. Throws Error
    /// kCannotRun if memory is insufficient, and otherwise as loadScene does.
    Film render(const SeriesShot& shot, const FrameJob& job);

    /// State of the last film.
    const FrameState& state() const { return state_; }
    /// Rays of the films since the last call.
    RayCounts takeRays() { return renderer_.takeRays(); }

private:
    void aim(const SeriesShot& shot);
    void makeRoom();

    Device& device_;
    LoadedScene& loaded_;
    LoadRequest request_; ///< for the selection of tiles
    TracerSize room_;     ///< capacity of the tracer
    ProgressiveRenderer renderer_;
    FrameState state_;
};

} // namespace pointrt
