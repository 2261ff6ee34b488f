// SPDX-License-Identifier: Apache-2.0
// Which picture the window shows: its size and look, when it starts over, and what is taken out of it.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/window/live/viewport_renderer.h"

namespace pointrt {

/// What is to be on the screen.
struct ImageRequest {
    Viewport view;             ///< settings but for first hits, which the window always wants; size and spp count
    bool look_changed = false; ///< or denoise: the same light is to be shown another way
    bool paused = false;
};

/// What becomes of the picture there is.
enum class ImageChange : std::uint8_t { kNone, kLook, kStartOver };

/// shown: what the picture there is was begun for. restart: what it shows has changed.
ImageChange changeOf(const std::optional<Viewport>& shown, const ImageRequest& request, bool restart);

/// A place on the picture, in parts of its width and height, and what it is for.
struct PickRequest {
    double x = 0, y = 0; ///< 0 to 1 within the picture
    bool centre = false; ///< to turn about, else to measure
};

/// A pick that has hit something.
struct PickResult {
    Pick pick;
    bool centre = false;
};

class ImageController {
public:
    /// From the next update on pictures are of tracer's scene; see ViewportRenderer.
    void open(Device& device, BandTracer& tracer);
    /// Frees what it has of the tracer.
    void close();

    /// The scene has changed, and the tracer with it. change: as for ViewportRenderer::setView.
    void restart(ViewChange change) {
        if (pending_restart_ != ViewChange::kAll) pending_restart_ = change;
    }
    /// ViewportRenderer::expect.
    void scaleCost(double times) {
        if (live_) live_->scaleCost(times);
    }
    /// Makes the picture one of request; its look counts as taken note of. After open, and while nobody else uses the
    /// tracer. Then finds what was picked, where that can be done by now.
    std::optional<PickResult> update(const ImageRequest& request);
    /// In place of update, while the tracer is somebody else's.
    void skipFrame() { moved_ = false; }
    /// True where the last update was of something that moves.
    bool moved() const { return moved_; }
    /// Works for a frame's time. False where there was nothing to do, or pause lets it rest: paused, only what the user
    /// waits for goes on: a first picture, one to be saved, and a slice that a pick waits for.
    bool work();
    bool mayWork() const;

    void pick(const PickRequest& request) { pick_ = request; }
    void requestFilm() { film_requested_ = true; }
    bool isFilmRequested() const { return film_requested_; }
    /// True where takeFilm has one to give: every pixel has the same number of samples.
    bool isFilmReady() const { return film_requested_ && live_->isBetweenSamples(); }
    /// The film that was wanted, and is no longer.
    Film takeFilm();
    /// Something that was asked for is still to come.
    bool hasPendingRequest() const { return film_requested_ || pick_; }

    /// None before the first update.
    ViewportRenderer* live() { return live_ ? &*live_ : nullptr; }
    const ViewportRenderer* live() const { return live_ ? &*live_ : nullptr; }
    /// The picture's, on the screen.
    PixelSize size() const;

private:
    std::optional<PickResult> findPick();

    Device* device_ = nullptr;
    BandTracer* tracer_ = nullptr;
    std::optional<ViewportRenderer> live_;
    std::optional<Viewport> shown_;
    std::optional<PickRequest> pick_;
    std::optional<ViewChange> pending_restart_;
    bool film_requested_ = false, paused_ = false, moved_ = false;
};

} // namespace pointrt
