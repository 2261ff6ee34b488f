// SPDX-License-Identifier: Apache-2.0
// The window's state. window.cpp: frames and input; window_picture.cpp: scene and picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/session/options.h"
#include "runtime/window/app/host.h"
#include "runtime/window/app/user_interface.h"
#include "runtime/window/edit/autosave.h"
#include "runtime/window/edit/file_dialog.h"
#include "runtime/window/edit/file_opener.h"
#include "runtime/window/edit/job_queue.h"
#include "runtime/window/edit/load_job.h"
#include "runtime/window/edit/scene_editor.h"
#include "runtime/window/edit/tile_job.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/record_replay.h"
#include "runtime/window/input/view_animator.h"
#include "runtime/window/live/frame_times.h"
#include "runtime/window/live/image_controller.h"

namespace pointrt {

/// The view and scene that tiles are selected for.
struct TileView {
    Camera camera;
    PixelSize size;
    std::vector<ClipDescription> clips;
    std::vector<bool> visible; ///< instances
    std::vector<Placement> placements;
    bool operator==(const TileView&) const = default;
};

/// The view of a scene that is being reopened: scene files cannot store a pivot beside the line of sight.
struct KeptView {
    std::string scene; ///< the scene's name
    ViewCamera camera, home;
};

/// The state that a window that lost its device hands over to the next window.
struct ReopenedWindow {
    RecordReplay session;
    std::optional<SceneSource> scene; ///< none: the next window opens what the options name
    std::optional<KeptView> view;     ///< of that scene
    bool lacks_pictures = false;      ///< a picture or a turntable was being rendered to a file
};

/// True if the scene on the device is being replaced or updated.
inline bool changesScene(const JobQueue& jobs) { return jobs.has(JobKind::kLoad) || jobs.has(JobKind::kSceneUpdate); }

class Window {
public:
    /// reopened: the state of the window that this one replaces, if any.
    explicit Window(const Options& options, std::optional<ReopenedWindow> reopened = {});
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Runs until the window is closed. Throws DeviceLost; then only handOver and the destructor may follow.
    void run();
    /// Keeps the scene with its edits and view in its autosave.
    ReopenedWindow handOver();

private:
    // window.cpp
    bool frame();
    std::vector<InputEvent> collectInput();
    double inputTimeout() const;
    PictureState pictureState() const;
    void execute(const Command& command);
    void execute(Action action);
    void flyTo(const ViewCamera& view) { view_.flyTo(work_.camera, view, session_.now()); }
    void handleRequests();
    void tryOrNotify(const std::string& subject, const std::function<void()>& body);
    void notify(const std::string& text, bool error);

    // window_edits.cpp
    void ask(Question question, std::function<void(std::size_t)> answered);
    void afterSaving(std::function<void()> next);
    void quitAfterPictures();
    void handleEdits(const Requests& requests);
    bool saveScene();
    void saveMeasurement();
    void openFiles(const std::vector<std::string>& paths);
    void chooseFiles();
    void handleChoice(const Requests& requests);
    void autosave();
    void offerAutosave(const SceneSource& scene);

    // window_picture.cpp
    StartedJob startLoad(const SceneSource& scene, bool first);
    void showLoaded(std::unique_ptr<LoadedScene> loaded, const SceneSource& scene);
    void showColors();
    void updateHistograms();
    void editScene(bool dragging, bool in_progress);
    bool needsTiles() const;
    TileView tileView() const;
    void requestTiles();
    void showTiles(TileJob& job, const TileView& view);
    void updatePicture();
    void refineWithoutRedraw();
    void saveFilm();
    void saveOutline(std::size_t clip);
    void compareScans(const Comparison& comparison);
    void showComparison(const std::string& with_distances, const Comparison& comparison);
    void addStill();
    void startStill();
    void renderTurntable(std::uint32_t pictures, bool follows_views);

    /// Events of this frame, and those kept for later ones.
    struct Input {
        std::vector<InputEvent> pending;      ///< polled in an earlier frame
        std::vector<std::string> screenshots; ///< names of PNGs to write of the next frame
        bool any = true;                      ///< this frame had events
    };

    Options options_;
    RecordReplay session_;
    Host host_;
    UserInterface ui_;
    Workspace work_;
    Input input_;
    ViewAnimator view_;
    FrameMeter meter_;
    SceneEditor editor_;
    std::unique_ptr<LoadedScene> loaded_;
    std::optional<KeptView> kept_view_;    ///< of the scene that is being opened again
    std::optional<TileView> complete_for_; ///< the view for which all tiles are on the device
    double last_tile_request_s_ = 0;       ///< on the window's clock
    bool warned_coarse_ = false;
    Vec3 histograms_up_; ///< of work_.histograms
    bool shows_quick_bake_ = false;
    std::unique_ptr<Autosave> autosave_;
    std::uint64_t autosaved_revision_ = 0;
    double autosaved_s_ = 0;                     ///< on the window's clock
    std::function<void(std::size_t)> on_answer_; ///< of work_.question
    ImageController image_;
    std::function<void(VkCommandBuffer)> uploads_; ///< records the update of the canvas; empty: it is up to date
    JobQueue jobs_;                                ///< declared after the members that jobs use, so that jobs end first
    FileOpener opener_;
    std::unique_ptr<FileDialog> dialog_; ///< while the desktop's dialog is open
    bool quit_ = false;
};

} // namespace pointrt
