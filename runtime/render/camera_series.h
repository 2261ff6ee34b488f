// SPDX-License-Identifier: Apache-2.0
// A scene that is loaded once and rendered from one camera after another, at any sizes.
#pragma once

#include <cstdint>

#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"

namespace pointrt {

/// A picture of a series, and what its film is to have.
struct SeriesShot {
    Camera camera;
    PixelSize size;
    bool first_hits = true, light_parts = true; ///< as RenderSettings has them
};

class CameraSeries {
public:
    /// loaded, whose tracer has room for its settings' size, must outlive it. device: for the calling thread.
    /// memory: bytes for the tiles of its sets
    CameraSeries(Device& device, LoadedScene& loaded, std::uint64_t memory);
    CameraSeries(const CameraSeries&) = delete;
    CameraSeries& operator=(const CameraSeries&) = delete;

    /// The shot's film as loaded's settings and job say, the same to the bit as that of a scene that was loaded for
    /// this shot, but for surroundings, which stay where they are. Where job.interrupted has ended it, state() tells.
    /// Throws Error kCannotRun where there is not the memory for it, else as loadScene does.
    Film render(const SeriesShot& shot, const FrameJob& job);

    /// Of the last film.
    const FrameState& state() const { return state_; }
    /// Of the films since the last call.
    RayCounts takeRays() { return renderer_.takeRays(); }

private:
    void aim(const SeriesShot& shot);
    void makeRoom();

    Device& device_;
    LoadedScene& loaded_;
    LoadRequest request_; ///< for tiles
    TracerSize room_;     ///< of loaded's tracer
    ProgressiveRenderer renderer_;
    FrameState state_;
};

} // namespace pointrt
