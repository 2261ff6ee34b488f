// SPDX-License-Identifier: Apache-2.0
// Selects the pixels to trace in a frame by priority: disoccluded, wrong or old ones first, and those near the
// attention point (Dayal, Woolley, Watson, Luebke, Adaptive Frameless Rendering, 2005).
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/window/live/render_cache.h"

namespace pointrt {

/// Parameters of the selection.
struct SelectionParams {
    PlaneVector focus;         ///< attention point, pixels
    std::uint32_t frame = 0;   ///< number
    bool camera_moves = false; ///< view-dependent points age faster
    std::uint32_t count = 0;   ///< pixels to select, on average
};

/// How far traced colours differed from the reprojected ones, by tile.
class ErrorMap {
public:
    explicit ErrorMap(PixelSize size);
    /// Records that the colour of a pixel was off by this many steps of 255.
    void record(std::uint32_t x, std::uint32_t y, std::uint32_t steps);
    /// Decays the errors and spreads them to neighbouring tiles, since shadow edges move.
    void advanceFrame();
    /// The error of a tile, 0 to 255.
    float at(std::uint32_t tile) const { return errors_[tile]; }
    void clear();

private:
    std::uint32_t across_, down_;
    std::vector<float> errors_, recorded_;
};

/// Indices of the pixels to trace, neighbours together. The probability of a pixel is proportional to its priority.
/// Deterministic.
std::vector<std::uint32_t> selectPixels(const RenderCache& cache, const ErrorMap& errors,
                                        const SelectionParams& params);

} // namespace pointrt
