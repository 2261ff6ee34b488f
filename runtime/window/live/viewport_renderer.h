// SPDX-License-Identifier: Apache-2.0
// The window's renderer: a preview while the view moves, progressive refinement when it rests, then denoising. It works
// in slices of a few milliseconds, so that the window stays responsive.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/render/band_tracer.h"
#include "runtime/render/pick.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/window/live/display_pipeline.h"
#include "runtime/window/live/reprojector.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// Everything the picture depends on, except the scene.
struct Viewport {
    RenderSettings settings; ///< width, height: full frame; spp: target samples
    Camera camera;
    Look look;
    bool denoise = false;
    double focus_x = 0.5, focus_y = 0.5; ///< attention point, as fractions of the picture
};

/// What changed since the last view: the camera; lights, materials or shapes (kScene); the places of scans; or
/// everything.
enum class ViewChange : std::uint8_t { kCamera, kScene, kPlacements, kAll };

/// Changed rows of DisplayPipeline::pixels.
struct PictureUpdate {
    PixelSize size; ///< of the picture; a preview is smaller than the window
    std::uint32_t first_row = 0, rows = 0;
};

struct ViewportProgress {
    PixelSize size;            ///< being traced
    std::uint32_t samples = 0; ///< per pixel of the full frame
    double share = 0;          ///< progress of the next sample, 0 to 1
    bool resting = false;      ///< all done
    bool denoising = false;    ///< the denoiser is running
    double mrays_per_second = 0;
    std::uint64_t traced = 0; ///< pixels traced of a reprojected frame; 0: the frame is not reprojected
};

/// Number of path states of the tracer: as many as a fast device traces in a frame; 130 MB.
constexpr std::uint32_t kSliceLanes = 1u << 18;

class ViewportRenderer {
public:
    /// tracer must outlive it; its scene is uploaded and it has kSliceLanes path states. preview_budget_s: time for a
    /// frame while the view moves.
    ViewportRenderer(Device& device, BandTracer& tracer, double preview_budget_s);
    ~ViewportRenderer();
    ViewportRenderer(const ViewportRenderer&) = delete;
    ViewportRenderer& operator=(const ViewportRenderer&) = delete;

    /// Starts over. moving: more changes are expected soon, so shows a preview first. change: what has changed, which
    /// limits what can be reprojected.
    void setView(const Viewport& view, bool moving, ViewChange change = ViewChange::kCamera);
    /// Shows the same light in another way. Traces again only if the film lacks a needed layer.
    void setLook(const Look& look, bool denoise);
    /// Starts over because the scene, and the tracer with it, have changed.
    void restart(bool moving);
    /// The cost of a pixel has changed by this factor.
    void scaleCost(double times) {
        preview_speed_.scaleCost(times);
        refine_speed_.scaleCost(times);
    }
    /// Sets the time for a frame while the view moves, from the next setView on.
    void setPreviewBudget(double seconds) { preview_budget_s_ = seconds; }
    /// Predicted time to trace all of the picture once while the view moves.
    double previewSeconds() const { return preview_speed_.secondsFor(std::uint64_t{full_.width} * full_.height); }
    /// Sets the target samples.
    void setSamples(std::uint32_t spp);

    /// Works for about this many seconds. Returns false if there is nothing to do for now.
    bool work(double seconds);
    /// Changed rows since clearUpdates.
    const std::vector<PictureUpdate>& updates() const { return updates_; }
    void clearUpdates() { updates_.clear(); }
    /// True if the updates must be shown before work continues, because the next ones have another size.
    bool mustShow() const;
    const Buffer& pixels() const { return display_.pixels; }

    ViewportProgress progress() const;
    /// The splat under a pixel of the full frame, if any. Only if isBetweenSlices.
    std::optional<Pick> pick(std::uint32_t x, std::uint32_t y);
    bool isBetweenSlices() const { return !renderer_.strip().has_value(); }
    /// True if all pixels of the full frame have the same number of samples, at least one.
    bool isBetweenSamples() const;
    /// The full frame as headless runs write it, with first hits if requested. Only if isBetweenSamples.
    Film readFilm();
    std::uint64_t deviceBytes() const;
    const Viewport& view() const { return view_; }

private:
    enum class Stage { kInteractive, kReprojection, kCoarse, kRefine, kFillCache, kDenoising, kIdle };
    using Clock = std::chrono::steady_clock;

    bool fitFilm();
    bool workReprojection(double seconds);
    void fillCache();
    bool needsCacheFill();
    void makeReprojector();
    bool shouldReproject() const;
    bool previewIsTiny() const;
    bool canReproject() const;
    ReprojectionView reprojectionView() const;
    float shareShown(std::uint32_t samples) const;
    void begin(Stage stage);
    void beginFilm();
    void next();
    void traceSlice(double seconds_left);
    std::uint32_t sliceRows(double seconds_left) const;
    std::uint32_t bounces() const;
    bool showsAfter(const Strip& strip) const;
    void finishSlice(const Strip& strip, bool is_drawn);
    void addTimes();
    void finishSample();
    void continueDenoising();
    bool isFullSize() const;
    bool showsDenoised() const;
    void showFilm();
    void showRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples);
    void recordRows(VkCommandBuffer commands, std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) const;
    void reportRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples);
    void showDenoised();
    bool needsHits() const;
    bool denoisesNow() const;
    TraceSpeed& speed() { return stage_ == Stage::kRefine ? refine_speed_ : preview_speed_; }
    const TraceSpeed& speed() const { return stage_ == Stage::kRefine ? refine_speed_ : preview_speed_; }
    FilmRange rangeOf(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples) const;

    Device& device_;
    BandTracer& tracer_;
    ProgressiveRenderer renderer_;
    double preview_budget_s_;
    DisplayPipeline display_;
    Viewport view_;
    std::unique_ptr<Reprojector> reprojector_; ///< of size full_, created on demand
    std::uint32_t reprojected_pixels_ = 0;     ///< pixels traced in its last frame
    bool reprojection_current_ = false;        ///< the reprojected picture shows the current view and look
    bool mostly_reused_ = false;               ///< little of the reprojected picture is disoccluded
    bool shows_full_frame_ = false;            ///< the screen shows last_camera_'s light at full resolution
    Camera last_camera_;
    std::uint64_t film_pixels_ = 0;
    Stage stage_ = Stage::kIdle;
    Clock::time_point moved_{};
    PixelSize full_, size_, preview_size_;
    TraceSpeed preview_speed_, refine_speed_;
    std::uint32_t denoised_samples_ = 0; ///< in the denoised picture; 0: none for this view
    bool denoise_due_ = false;           ///< denoise after the next sample, regardless of its number
    std::uint32_t denoise_step_ = 0;
    double planned_s_ = 0; ///< predicted time of the slices that this call of work has submitted to the device
    std::uint64_t rays_ = 0;
    double traced_seconds_ = 0;
    std::vector<PictureUpdate> updates_;
};

} // namespace pointrt
