// SPDX-License-Identifier: Apache-2.0
// What the window keeps from frame to frame. Its parts: window.cpp (a frame), window_input.cpp (what the user does),
// window_scene.cpp (loading and editing), window_picture.cpp (tracing and showing), window_output.cpp (files).
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/session/options.h"
#include "runtime/window/app/host.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/commands.h"
#include "runtime/window/input/recording.h"
#include "runtime/window/input/replay.h"
#include "runtime/window/jobs/bake_job.h"
#include "runtime/window/jobs/load_job.h"
#include "runtime/window/jobs/save_job.h"
#include "runtime/window/jobs/turntable_job.h"
#include "runtime/window/live/frame_times.h"
#include "runtime/window/live/viewport_renderer.h"
#include "runtime/window/view/view_flight.h"
#include "runtime/window/widgets/ui_input.h"

struct ImGuiContext;

namespace pointrt {

class Window {
public:
    explicit Window(const Options& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Until it is closed.
    void run();

private:
    using Clock = std::chrono::steady_clock;

    /// Dear ImGui's state, for as long as this lives.
    struct Ui {
        Ui();
        ~Ui();
        Ui(const Ui&) = delete;
        Ui& operator=(const Ui&) = delete;
        ImGuiContext* context;
    };

    // window.cpp
    bool frame();
    std::vector<InputEvent> gatherInput();
    void drawInterface(double seconds);
    void present();
    void noteTimes(Clock::time_point start);
    double patience() const;
    PictureState pictureState() const;
    std::uint32_t recordedFrame() const;
    double now() const;
    void fitText();
    void tell(const std::string& text, bool error = false);

    // window_input.cpp
    void handle(const InputEvent& event);
    void obey(const Command& command);
    void obey(Action action);
    void moveCamera(double seconds);
    void flyTo(const ViewCamera& view);
    void stepFile(int step);
    void goToView(const NamedView& view);
    ViewSize viewSize() const;

    // window_scene.cpp
    void open(const std::string& path);
    void startLoad(const std::string& path);
    void drop(const std::vector<std::string>& paths);
    void pollJobs();
    void showLoaded(std::unique_ptr<LoadedScene> loaded);
    void applyRequests();
    void editScene();
    void setUp(Vec3 up);
    void cancelJob();
    void restage();
    void keepLamps(const std::optional<Room>& room);
    void refurnishLater();
    bool busy() const;

    // window_picture.cpp
    void beginPicture();
    void updatePicture();
    bool mayWork() const;
    void refineUndrawn();
    void uploadPicture();
    void fillHud();
    void resolvePicks();

    // window_output.cpp
    void takeScreenshot();
    void takeFrame(const std::string& name);
    void saveScene();
    void saveView();
    void startTurntable(std::uint32_t pictures);
    SceneDescription sceneAsShown() const;

    Options options_;
    std::optional<Replay> replay_;
    std::optional<RecordingWriter> recorder_;
    Host host_;
    Ui ui_;
    UiInput ui_input_;
    ControlState controls_;
    Workspace work_;
    Clock::time_point start_ = Clock::now(), last_frame_ = start_;
    std::uint32_t frame_ = 0;
    std::vector<std::string> frame_shots_; ///< to be taken of this frame
    std::vector<InputEvent> early_input_;  ///< seen before its frame
    Clock::time_point looked_ = start_;    ///< for input, last
    bool quit_ = false, any_input_ = true;

    ViewCamera home_;
    std::optional<ViewFlight> flight_;
    Vec3 flying_;
    struct PickRequest {
        double x, y;
        bool centre;
    };
    std::optional<PickRequest> pick_;

    std::unique_ptr<LoadedScene> loaded_;
    std::optional<std::string> next_path_; ///< to be loaded as soon as that can begin
    std::unique_ptr<LoadJob> load_;
    std::unique_ptr<RefurnishJob> refurnish_;
    std::unique_ptr<BakeJob> bake_;
    std::unique_ptr<TurntableJob> turntable_;
    std::unique_ptr<SaveJob> save_;
    bool first_has_loaded_ = false;
    bool edits_wait_ = false; ///< what the panels say is not yet on the device
    /// What the user made of each room's lamps, to find it again.
    struct Lamps {
        std::optional<Room> room;
        std::vector<LightDescription> lights;
        std::optional<SkyDescription> sky;
    };
    std::vector<Lamps> lamps_;
    SceneDescription staged_; ///< the scene when its surroundings were put up
    std::optional<Room> staged_room_;
    std::optional<std::uint32_t> staged_lights_;
    std::optional<ViewportRenderer> live_;
    std::optional<Camera> shown_camera_;
    PixelSize shown_pixels_;
    bool restart_ = false;
    bool screenshot_wanted_ = false;
    Clock::time_point moved_ = start_;

    WindowReport report_;
    bool frame_moved_ = false;
    double mean_frame_ms_ = 0, text_scale_ = 1;
};

} // namespace pointrt
