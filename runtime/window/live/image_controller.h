// SPDX-License-Identifier: Apache-2.0
// Decides when the window's picture starts over, and provides picks and films of the picture.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/window/live/preview_budget.h"
#include "runtime/window/live/viewport_renderer.h"

namespace pointrt {

/// The picture to show.
struct ImageRequest {
    Viewport view;             ///< without first_hits, which the window always enables; with size and spp
    bool look_changed = false; ///< look or denoise: show the same light another way
    bool paused = false;
    std::optional<double> display_hz; ///< see PreviewBudget
};

/// What a request changes about the current picture.
enum class ImageChange : std::uint8_t { kNone, kLook, kStartOver };

/// shown: the view of the current picture. restart: the scene has changed.
ImageChange changeOf(const std::optional<Viewport>& shown, const ImageRequest& request, bool restart);

/// A position on the picture to pick, and why.
struct PickRequest {
    double x = 0, y = 0; ///< 0 to 1 across the picture
    bool centre = false; ///< centre the view there; otherwise measure
};

/// A pick that hit something.
struct PickResult {
    Pick pick;
    bool centre = false;
};

class ImageController {
public:
    /// Renders tracer's scene from the next update on; see ViewportRenderer.
    void open(Device& device, BandTracer& tracer);
    /// Frees everything that uses the tracer.
    void close();

    /// The scene changed, and the tracer with it. change: see ViewportRenderer::setView.
    void restart(ViewChange change) {
        if (pending_restart_ != ViewChange::kAll) pending_restart_ = change;
    }
    /// See ViewportRenderer::scaleCost.
    void scaleCost(double times) {
        if (live_) live_->scaleCost(times);
    }
    /// Starts or restyles the picture as request says, then resolves a pending pick if possible. After open, and only
    /// while nothing else uses the tracer.
    std::optional<PickResult> update(const ImageRequest& request);
    /// Replaces update in frames in which the tracer is in use elsewhere.
    void skipFrame() { moved_ = false; }
    /// Whether the last update started the picture over.
    bool moved() const { return moved_; }
    /// Works for a frame's time. Returns false if there is nothing to do or the picture is paused. When paused, still
    /// completes what the user waits for: the first picture, a picture to save, or a slice before a pick.
    bool work();
    bool mayWork() const;

    void pick(const PickRequest& request) { pick_ = request; }
    void requestFilm() { film_requested_ = true; }
    bool isFilmRequested() const { return film_requested_; }
    /// Whether takeFilm can return a film: all pixels have the same number of samples.
    bool isFilmReady() const { return film_requested_ && live_->isBetweenSamples(); }
    /// Returns the requested film and completes the request.
    Film takeFilm();
    /// Whether a requested film or pick is still outstanding.
    bool hasPendingRequest() const { return film_requested_ || pick_; }

    /// None before the first update.
    ViewportRenderer* live() { return live_ ? &*live_ : nullptr; }
    const ViewportRenderer* live() const { return live_ ? &*live_ : nullptr; }
    /// Size of the displayed picture.
    PixelSize size() const;

private:
    std::optional<PickResult> findPick();
    void setBudget(std::optional<double> display_hz);

    Device* device_ = nullptr;
    BandTracer* tracer_ = nullptr;
    std::optional<ViewportRenderer> live_;
    std::optional<Viewport> shown_;
    std::optional<PickRequest> pick_;
    std::optional<ViewChange> pending_restart_;
    PreviewBudget budget_;
    double preview_budget_s_ = 0;
    bool film_requested_ = false, paused_ = false, moved_ = false;
};

} // namespace pointrt
