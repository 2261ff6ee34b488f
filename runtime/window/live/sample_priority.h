// SPDX-License-Identifier: Apache-2.0
// Which pixels of a carried picture are traced in a frame: what is new, wrong or old comes first, and what the eye
// rests on (Dayal, Woolley, Watson, Luebke, Adaptive Frameless Rendering, 2005).
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/window/live/render_cache.h"

namespace pointrt {

/// What a frame's choice hangs on besides the points.
struct SelectionParams {
    PlaneVector focus;         ///< where the eye rests, pixels
    std::uint32_t frame = 0;   ///< number
    bool camera_moves = false; ///< the camera: mirrors age faster
    std::uint32_t count = 0;   ///< pixels, on average
};

/// Where traced colours were not those that were shown, by tiles.
class ErrorMap {
public:
    explicit ErrorMap(PixelSize size);
    /// A pixel was off by so many of 255 steps.
    void record(std::uint32_t x, std::uint32_t y, std::uint32_t steps);
    /// A frame goes by: what was wrong is remembered for a while, in the tiles around too, for edges of shadows move
    /// on.
    void advanceFrame();
    /// 0 to 255.
    float at(std::uint32_t tile) const { return errors_[tile]; }
    void clear();

private:
    std::uint32_t across_, down_;
    std::vector<float> errors_, recorded_;
};

/// Numbers of the pixels to be traced, those near each other one after the other: chances are in proportion to how
/// urgent they are. The same for the same picture and attention.
std::vector<std::uint32_t> selectPixels(const RenderCache& cache, const ErrorMap& errors,
                                        const SelectionParams& params);

} // namespace pointrt
