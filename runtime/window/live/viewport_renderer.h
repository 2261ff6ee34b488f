// SPDX-License-Identifier: Apache-2.0
// What a window shows of a progressive renderer: coarse while things move, finer as soon as they rest, and denoised. It
// works in slices of a few milliseconds, so that whoever draws the window is never kept waiting.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/render/band_tracer.h"
#include "runtime/render/pick.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/window/live/display_pipeline.h"
#include "runtime/window/live/reprojection_renderer.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// All that the picture depends on but the scene.
struct Viewport {
    RenderSettings settings; ///< width, height: of the whole picture; spp: samples after which it rests
    Camera camera;
    Look look;
    bool denoise = false;
    double focus_x = 0.5, focus_y = 0.5; ///< where the eye rests, in parts of the picture
};

/// What another view is another of.
enum class ViewChange : std::uint8_t { kCamera, kScene, kAll };

/// Rows of DisplayPipeline::pixels that are new.
struct PictureUpdate {
    PixelSize size; ///< of the picture they are rows of; smaller than the window's while things move
    std::uint32_t first_row = 0, rows = 0;
};

struct ViewportProgress {
    PixelSize size;            ///< that is traced now
    std::uint32_t samples = 0; ///< of every pixel of the whole picture
    double share = 0;          ///< of the next sample
    bool resting = false;      ///< nothing is left to do
    bool denoising = false;    ///< the picture of these samples is being filtered
    double mrays_per_second = 0;
    std::uint64_t traced = 0; ///< pixels of the moving picture, the others were carried along; 0: all of size
};

/// Of the tracers that it works with: what a fast device does in a frame, for 130 MB of states.
constexpr std::uint32_t kSliceLanes = 1u << 18;

class ViewportRenderer {
public:
    /// tracer, whose scene is furnished and which takes kSliceLanes, must outlive it. A picture of something that moves
    /// is made as fine as that budget allows.
    ViewportRenderer(Device& device, BandTracer& tracer, double preview_budget_s);
    ~ViewportRenderer();
    ViewportRenderer(const ViewportRenderer&) = delete;
    ViewportRenderer& operator=(const ViewportRenderer&) = delete;

    /// Starts over. moving: more views are to come soon, so that the next picture is to be there at once. change: what
    /// of the last picture may not be carried along; kScene where the scene has changed but for its scans.
    void setView(const Viewport& view, bool moving, ViewChange change = ViewChange::kCamera);
    /// Another look at the same light: nothing is traced again unless it must be.
    void setLook(const Look& look, bool denoise);
    /// Starts over: the scene has changed, and the tracer with it.
    void restart(bool moving);
    /// A pixel of the scene is to take so many times as long, now that that is another one.
    void scaleCost(double times) {
        preview_speed_.scaleCost(times);
        refine_speed_.scaleCost(times);
    }
    /// How many samples it goes on to.
    void setSamples(std::uint32_t spp);

    /// Works for about so many seconds, less where nothing is left to do. False where there was nothing, for now.
    bool work(double seconds);
    /// What has become new since clearUpdates.
    const std::vector<PictureUpdate>& updates() const { return updates_; }
    void clearUpdates() { updates_.clear(); }
    /// True where what is new must be shown before the work goes on: what follows has another size.
    bool mustShow() const;
    const Buffer& pixels() const { return display_.pixels; }

    ViewportProgress progress() const;
    /// The splat under a pixel of the whole picture, none where there is none. Between slices only: see canPick.
    std::optional<Pick> pick(std::uint32_t x, std::uint32_t y);
    bool isBetweenSlices() const { return !renderer_.strip().has_value(); }
    /// True where every pixel of the whole picture has the same number of samples, at least one.
    bool isBetweenSamples() const;
    /// The whole picture as headless runs have it, with first hits where they were asked for; isBetweenSamples.
    Film readFilm();
    std::uint64_t deviceBytes() const;
    const Viewport& view() const { return view_; }

private:
    enum class Stage { kInteractive, kReprojection, kCoarse, kRefine, kFillCache, kDenoising, kIdle };
    using Clock = std::chrono::steady_clock;

    void fitFilm();
    bool workReprojection(double seconds);
    void fillCache();
    bool needsCacheFill();
    void createReprojector();
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
    void finishSlice(const Strip& strip);
    void finishSample();
    void continueDenoising();
    bool isFullSize() const;
    bool showsDenoised() const;
    void showFilm();
    void showRows(std::uint32_t first_row, std::uint32_t rows, std::uint32_t samples);
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
    std::optional<ReprojectionRenderer> reprojector_; ///< once one was asked for, of full_
    std::uint32_t reprojected_pixels_ = 0;            ///< traced of the last one
    bool reprojection_current_ = false;               ///< it is of this view, and look
    bool mostly_reused_ = false;                      ///< little of it is new
    bool shows_full_frame_ = false; ///< what is on the screen is the light of last_camera_, in the picture's size
    Camera last_camera_;
    std::uint64_t film_pixels_ = 0;
    Stage stage_ = Stage::kIdle;
    Clock::time_point moved_{};
    PixelSize full_, size_, preview_size_;
    TraceSpeed preview_speed_, refine_speed_;
    std::uint32_t denoised_samples_ = 0; ///< of the denoiser's result, 0: none of this view
    bool denoise_due_ = false;           ///< after the next sample, whatever its number
    std::uint32_t denoise_step_ = 0;
    double slice_seconds_ = 0, denoise_step_seconds_ = 0;
    std::uint64_t rays_ = 0;
    double traced_seconds_ = 0;
    std::vector<PictureUpdate> updates_;
};

} // namespace pointrt
