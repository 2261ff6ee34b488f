// SPDX-License-Identifier: Apache-2.0
// Loading scenes, tiles, the picture, and saving it.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "format/base/error.h"
#include "format/os/process_time.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/film_signature.h"
#include "runtime/scene/legend_picture.h"
#include "runtime/scene/measure_picture.h"
#include "runtime/session/report.h"
#include "runtime/session/settings.h"
#include "runtime/util/clock.h"
#include "runtime/util/parse.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/edit/free_name.h"
#include "runtime/window/edit/pick_details.h"
#include "runtime/window/edit/required_update.h"
#include "runtime/window/edit/save_job.h"
#include "runtime/window/edit/shown_scene.h"
#include "runtime/window/edit/still_job.h"
#include "runtime/window/edit/tile_job.h"
#include "runtime/window/edit/turntable_job.h"
#include "runtime/window/ui/panel_ui.h"

namespace pointrt {
namespace {

/// Interval of redrawing the interface while there is no input.
constexpr double kRedraw_s = 0.1;
constexpr std::size_t kPicks = 2;
/// Limit of picks in a path, since each is drawn in every frame: more than anyone clicks.
constexpr std::size_t kPathPicks = 1000;
/// Share of the tile memory for the current cut; the rest is for tiles that load while it is displayed.
constexpr double kCutShare = 0.8;
/// Interval of tile selection while the camera moves.
constexpr double kTilesEvery_s = 0.2;

OpenedScene openedScene(const LoadedScene& loaded) {
    return {loaded.described, loaded.scene.description, loaded.settings,         loaded.camera,  loaded.staged_for,
            loaded.shown.lo,  loaded.shown.hi,          loaded.sample,           loaded.subject, loaded.pivot,
            loaded.aside,     loaded.free_share,        loaded.scene.space.scale};
}

/// Share of the window's width beside the panel.
double freeShare(Host& host) {
    const double width = std::max(1.0, double(host.size().width));
    return 1 - double(panelWidth(float(width), host.textScale())) / width;
}

ImageRequest imageRequest(const Workspace& work, PixelSize pixels) {
    ImageRequest request{{work.settings, cameraOf(work.camera), work.look, work.denoise}};
    request.view.look.compresses_highlights = toneMapping(work.scene, work.look.exposure).compresses_highlights;
    request.view.settings.width = pixels.width;
    request.view.settings.height = pixels.height;
    request.view.settings.spp = work.target_samples;
    request.look_changed = work.requests.look_changed;
    request.paused = work.paused;
    return request;
}

/// Copies the picture's changed rows to the canvas.
void recordUploads(VkCommandBuffer commands, Host& host, const Buffer& pixels,
                   const std::vector<PictureUpdate>& updates) {
    const PixelSize canvas{host.pixels().width, host.pixels().height};
    std::optional<PixelSize> scaled;
    for (const PictureUpdate& update : updates)
        if (update.size == canvas)
            recordUploadRows(commands, host.presenter(), pixels, update.first_row, update.rows);
        else
            scaled = update.size;
    if (scaled) recordUploadPreview(host.device(), commands, host.presenter(), pixels, scaled->width, scaled->height);
}

/// Records the copy of the picture's changed rows to the canvas; empty if nothing has changed.
std::function<void(VkCommandBuffer)> takeUploads(Host& host, ImageController& image) {
    ViewportRenderer& live = *image.live();
    std::vector<PictureUpdate> updates = live.updates();
    live.clearUpdates();
    const PixelSize canvas{host.pixels().width, host.pixels().height};
    // after the window's size has changed, a picture of that size follows in the next frame
    if (updates.empty() || canvas != image.size()) return {};
    return [&host, &pixels = live.pixels(), updates = std::move(updates)](VkCommandBuffer commands) {
        recordUploads(commands, host, pixels, updates);
    };
}

/// The legend and the measurements.
PictureOverlay savedOverlay(const Workspace& work, const Viewport& view, PixelSize size) {
    PictureOverlay overlay;
    if (view.settings.legend.value_or(false) && work.legend) overlay.boxes.push_back(drawLegend(*work.legend, size));
    addMeasures(work.scene.measures, work.measure_units, view.camera, size, overlay);
    return overlay;
}

} // namespace

StartedJob Window::startLoad(const SceneSource& scene, bool first) {
    Options options = options_;
    options.scene = scene.path;
    options.source = scene.source;
    options.added = scene.added;
    if (loaded_ && !scene.follows_quick) { // these options apply only to the scene of the command line
        options.sun.reset();
        options.camera = {};
        options.up_axis.reset();
        options.view.clear();
        options.fov_deg.reset();
    }
    options.choices.size = host_.pixels();
    host_.setTitle(std::filesystem::path(scene.name()).filename().string() + " - pointrt");
    // for the command line's file, a failure ends the program; after a dropped file the window stays open
    return startedJob<LoadJob>(
        std::make_unique<LoadJob>(host_.device(), options, freeShare(host_)),
        [this, scene](LoadJob& load) { showLoaded(load.take(), scene); },
        first ? throwIfFailed : std::function<void(const Job&)>());
}

void Window::showLoaded(std::unique_ptr<LoadedScene> loaded, const SceneSource& scene) {
    image_.close();
    loaded_ = std::move(loaded);
    complete_for_.reset();
    warned_coarse_ = false;
    shows_quick_bake_ = scene.is_quick;
    const bool says_samples = options_.choices.spp || loaded_->scene.description.render.spp;
    const std::uint32_t samples = says_samples ? loaded_->settings.spp : kCleanSamplesOfLight;
    view_.home = scene.follows_quick ? editor_.refine(openedScene(*loaded_), samples, view_.home)
                                     : editor_.open(openedScene(*loaded_), samples);
    if (const auto kept = std::exchange(kept_view_, std::nullopt); kept && kept->scene == scene.name()) {
        work_.camera = kept->camera;
        view_.home = kept->home;
    }
    work_.measure_units = measureUnits(*loaded_);
    showColors();
    work_.earth_place.reset();
    work_.place_sought = work_.place_taken = false;
    work_.histograms.clear();
    work_.scan_centres.clear();
    for (const DeviceScan* scan : representativeScans(loaded_->scene)) {
        const Bounds bounds = placedBounds({}, scan->info);
        work_.scan_centres.push_back(0.5 * (bounds.lo + bounds.hi));
    }
    view_.stop();
    image_.open(host_.device(), loaded_->tracer);
    offerAutosave(scene);
}

void Window::showColors() {
    work_.color_words = colorWords(placedScans(loaded_->scene, loaded_->scene.description));
    work_.legend = loaded_->scene.paint.legend;
}

/// Computes the histograms that filters need. Those of heights are valid for one up direction.
void Window::updateHistograms() {
    if (changesScene(jobs_)) return;
    const Vec3 up = sceneUp(work_.scene, work_.settings);
    if (histograms_up_ != up) work_.histograms.clear();
    histograms_up_ = up;
    for (const FilterDescription& filter : work_.scene.filters) {
        const std::string& word = filter.shown.attribute;
        if (!work_.histograms.contains(word))
            work_.histograms[word] = histogramOf(placedScans(loaded_->scene, loaded_->scene.description), word, up);
    }
}

/// Updates the scene on the device after edits. in_progress: more edits of the same kind follow.
void Window::editScene(bool dragging, bool in_progress) {
    editor_.updateSurroundings();
    if (!in_progress) editor_.noteEdits();
    RequiredUpdate update;
    if (editor_.hasPendingEdits())
        update = requiredUpdate(loaded_->scene, loaded_->program_kinds.integrator, work_.scene, work_.settings);
    if (nextUpdateStep(update.kind, dragging, loaded_->lacks_photons) == UpdateStep::kUpload) {
        const bool moves = update.kind == UpdateKind::kPlacements;
        updateSceneTables(host_.device(), *loaded_, work_.scene, work_.settings, std::move(update));
        editor_.clearPendingEdits();
        // while a lamp is dragged, the last picture with its outdated light is better than none
        image_.restart(!dragging ? ViewChange::kAll : moves ? ViewChange::kPlacements : ViewChange::kScene);
        update.kind = UpdateKind::kNothing;
    }
    if (nextUpdateStep(update.kind, dragging, loaded_->lacks_photons) != UpdateStep::kSceneUpdate) return;
    editor_.clearPendingEdits();
    jobs_.start(JobKind::kSceneUpdate, [&] {
        return startedJob<SceneUpdateJob>(
            std::make_unique<SceneUpdateJob>(host_.device(), *loaded_, work_.scene, work_.settings), {},
            [this](const Job&) {
                showColors();
                image_.restart(ViewChange::kAll);
            });
    });
}

bool Window::needsTiles() const { return loaded_ && !loaded_->scene.sets.empty() && complete_for_ != tileView(); }

/// Clips and hidden scans as they are on the device.
TileView Window::tileView() const {
    const SceneDescription& scene = loaded_->scene.description;
    TileView view{cameraOf(work_.camera), host_.pixels(), scene.clips, {}, {}};
    for (const InstanceDescription& each : scene.instances) {
        view.visible.push_back(each.visible && !each.deleted);
        view.placements.push_back(each.placement);
    }
    return view;
}

/// Starts loading the next tiles for the camera once no other job uses the scene.
void Window::requestTiles() {
    if (!needsTiles() || session_.now() - last_tile_request_s_ < kTilesEvery_s) return;
    const TileView view = tileView();
    TileRequest request;
    request.cameras = {view.camera};
    request.size = view.size;
    request.detail = loaded_->settings.detail;
    request.memory = static_cast<std::uint64_t>(kCutShare * static_cast<double>(loaded_->scene.tile_cache_bytes));
    request.painted = paintsScans(loaded_->scene.description, loaded_->settings);
    jobs_.start(JobKind::kTiles, [&] {
        last_tile_request_s_ = session_.now();
        return startedJob<TileJob>(
            std::make_unique<TileJob>(host_.device(), makeTileLoadRequest(loaded_->scene, request)),
            [this, view](TileJob& job) { showTiles(job, view); },
            [this, view](const Job& job) {
                if (job.state() == JobState::kFailed) complete_for_ = view; // do not retry
            });
    });
}

/// Replaces the tiles on the device.
void Window::showTiles(TileJob& job, const TileView& view) {
    DeviceScene& scene = loaded_->scene;
    work_.hud.target_tiles = job.targetTiles();
    LoadedTiles tiles = job.take();
    for (const std::string& reason : tiles.missing) notify(reason + "; showing a coarser tile instead", true);
    if (job.isFinalStep()) complete_for_ = view;
    const auto fits = [](const OpenedSet& set) { return set.cut.fits; };
    if (job.isFinalStep() && !std::all_of(tiles.sets.begin(), tiles.sets.end(), fits) &&
        !std::exchange(warned_coarse_, true))
        notify("showing coarser tiles than --detail " + plainText(loaded_->settings.detail) +
                   " requests; raise --memory",
               false);
    const auto before = static_cast<double>(scene.instances.size());
    if (!applyTiles(host_.device(), scene, std::move(tiles))) return;
    uploadSceneTables(host_.device(), scene, loaded_->settings);
    addPrograms(host_.device(), scene, loaded_->settings, loaded_->tracer.programs);
    rebind(host_.device(), loaded_->tracer);
    image_.restart(ViewChange::kScene);
    // the cost grows with the tiles, since every ray tests every tile
    image_.scaleCost(static_cast<double>(scene.instances.size()) / before);
}

void Window::updatePicture() {
    if (!loaded_ || jobs_.has(JobKind::kSceneUpdate)) return image_.skipFrame();
    ImageRequest request = imageRequest(work_, host_.pixels());
    if (!session_.isReplaying()) request.display_hz = host_.displayRate();
    if (const auto found = image_.update(request)) {
        if (found->centre) {
            flyTo(centredOn(work_.camera, found->pick.position));
        } else {
            work_.picks.push_back(describePick(loaded_->scene, found->pick));
            if (work_.picks.size() > (work_.pin_measurement ? kPathPicks : kPicks))
                work_.picks.erase(work_.picks.begin());
        }
    }
    work_.requests.look_changed = false;
    if (image_.work()) refineWithoutRedraw();
    uploads_ = takeUploads(host_, image_);
    if (uploads_ && meter_.report.first_picture_s < 0) meter_.report.first_picture_s = secondsSinceStart();
    if (image_.isFilmReady() && !jobs_.has(JobKind::kSave)) tryOrNotify("", [&] { saveFilm(); });
}

/// While there is no input, refines the picture without redrawing the interface, so that the picture gets all the time.
/// Input is polled as often as before.
void Window::refineWithoutRedraw() {
    const ViewportRenderer& live = *image_.live();
    while (!image_.moved() && !input_.any && !ui_.isDragging() && !view_.isInFlight() && !work_.job &&
           !live.mustShow()) {
        const Clock::time_point now = Clock::now();
        const double undrawn_s = std::chrono::duration<double>(now - meter_.frameBegin()).count();
        if (undrawn_s > kRedraw_s || live.isBetweenSamples()) return;
        meter_.refine(now);
        input_.pending = host_.poll(0);
        if (!input_.pending.empty() || !image_.work()) return;
    }
}

/// Saves the displayed picture as PNG and EXR.
void Window::saveFilm() {
    const Viewport view = image_.live()->view();
    const std::uint32_t samples = image_.live()->progress().samples;
    SavedFilm saved{image_.takeFilm(), samples, work_.settings.seed,
                    filmSignature(loaded_->scene, view.settings, view.camera, loaded_->tracer.programs.form)};
    const std::string name = freeName(work_.scene.path, {".png", ".exr"});
    SaveOptions look{
        toneMapping(work_.scene, work_.look.exposure), work_.denoise && samples < kCleanSamplesOfLight, {}};
    look.overlay = savedOverlay(work_, view, {saved.film.width, saved.film.height});
    jobs_.start(JobKind::kSave, [&] {
        return startedJob<SaveJob>(
            std::make_unique<SaveJob>(host_.device(), name, std::move(saved), look),
            [this](SaveJob& save) { notify(save.summary(), false); },
            [this](const Job& job) {
                if (quit_) throwIfFailed(job); // the window closes, so nobody would see a notice
            });
    });
}

void Window::addStill() {
    const std::string name = freeStillName(work_.scene.path, work_.stills);
    work_.stills.push_back({sceneAsShown(work_, work_.still_size), work_.still_size, name});
    notify(name + " will be rendered in the background", false);
}

/// Starts the next still once no other picture is rendered in the background.
void Window::startStill() {
    if (work_.stills.empty() || jobs_.has(JobKind::kTurntable)) return;
    const Still still = work_.stills.front();
    work_.stills.erase(work_.stills.begin());
    jobs_.start(JobKind::kTurntable, [&] {
        return startedJob<StillJob>(std::make_unique<StillJob>(still, options_.device),
                                    [this, path = still.path](StillJob&) { notify("rendered " + path, false); });
    });
}

void Window::renderTurntable(std::uint32_t pictures, bool follows_views) {
    const PixelSize size{host_.pixels().width, host_.pixels().height};
    jobs_.start(JobKind::kTurntable, [&] {
        return startedJob<TurntableJob>(std::make_unique<TurntableJob>(sceneAsShown(work_, size), work_.turntable_path,
                                                                       pictures, follows_views, options_.device),
                                        [this](TurntableJob&) { notify("rendered " + work_.turntable_path, false); });
    });
}

} // namespace pointrt
