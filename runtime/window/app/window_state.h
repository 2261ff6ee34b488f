// SPDX-License-Identifier: Apache-2.0
// The window: what its parts say to each other. Frames and what the user does: window.cpp; scene and picture:
// window_picture.cpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/session/options.h"
#include "runtime/window/app/host.h"
#include "runtime/window/app/user_interface.h"
#include "runtime/window/edit/file_opener.h"
#include "runtime/window/edit/job_queue.h"
#include "runtime/window/edit/load_job.h"
#include "runtime/window/edit/scene_editor.h"
#include "runtime/window/edit/tile_job.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/tape.h"
#include "runtime/window/input/view_driver.h"
#include "runtime/window/live/frame_times.h"
#include "runtime/window/live/image_controller.h"

namespace pointrt {

/// What tiles are chosen for.
struct TileView {
    Camera camera;
    PixelSize size;
    bool operator==(const TileView&) const = default;
};

class Window {
public:
    explicit Window(const Options& options);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Until it is closed.
    void run();

private:
    // window.cpp
    bool frame();
    std::vector<InputEvent> gatherInput();
    double patience() const;
    PictureState pictureState() const;
    void execute(const Command& command);
    void execute(Action action);
    void flyTo(const ViewCamera& view) { view_.flyTo(work_.camera, view, tape_.now()); }
    void doRequests();
    void attempt(const std::string& subject, const std::function<void()>& body);
    void tell(const std::string& text, bool error);

    // window_picture.cpp
    StartedJob startLoad(const std::string& path, bool first);
    void showLoaded(std::unique_ptr<LoadedScene> loaded);
    void showColors();
    void editScene(bool dragging);
    bool wantsTiles() const;
    void streamTiles();
    void showTiles(TileJob& job, const TileView& view);
    void updatePicture();
    void refineUndrawn();
    void saveFilm();
    void renderTurntable(std::uint32_t pictures);

    /// Of this frame, and of those to come.
    struct Input {
        std::vector<InputEvent> early;  ///< seen before its frame
        std::vector<std::string> shots; ///< files that the next frame on the screen goes to
        bool any = true;                ///< something was done in this frame
    };

    Options options_;
    Tape tape_;
    Host host_;
    UserInterface ui_;
    Workspace work_;
    Input input_;
    ViewDriver view_;
    FrameMeter meter_;
    SceneEditor editor_;
    std::unique_ptr<LoadedScene> loaded_;
    std::optional<TileView> tiles_for_; ///< that the tiles on the device are all there for
    double tiles_asked_s_ = 0;          ///< when tiles were asked for last, on the window's clock
    bool told_coarse_ = false;
    ImageController image_;
    JobQueue jobs_; ///< after what they work on: they end first
    FileOpener opener_;
    bool quit_ = false;
};

} // namespace pointrt
