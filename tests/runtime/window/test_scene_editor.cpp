// SPDX-License-Identifier: Apache-2.0
// Edits of a scene and the updates they require, without a device.
#include "runtime/window/edit/scene_editor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "runtime/device_scene/scene_rows.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/window/edit/autosave.h"
#include "runtime/window/edit/measure_edit.h"
#include "runtime/window/edit/required_update.h"
#include "runtime/window/edit/shown_scene.h"
#include "tests/runtime/window/random_edits.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

OpenedScene opened(const SceneDescription& file_scene, const RenderSettings& settings = {}) {
    OpenedScene scene;
    scene.file_scene = file_scene;
    scene.file_scene.path = "scans/statue.pro";
    scene.settings = settings;
    scene.bounds_min = {-1, -1, -1};
    scene.bounds_max = {1, 1, 1};
    scene.camera = frameCamera({}, scene.bounds_min, scene.bounds_max, 1);
    scene.resolved_for_eye = scene.camera.eye;
    scene.resolved = scene.file_scene;
    addSurroundings(scene.resolved, settings, scene.camera, scene.bounds_min, scene.bounds_max);
    return scene;
}

PointLight lampAt(double x) { return {{x, 3, 0}, {9, 9, 9}}; }

class SceneEditorTest : public testing::Test {
protected:
    /// Does what a room button in the panel does.
    void goTo(std::optional<Room> room, std::optional<std::uint32_t> lamps = std::nullopt) {
        work.settings.room = room;
        work.settings.lights = lamps;
        editor.updateSurroundings();
    }

    Workspace work;
    SceneEditor editor{work};
};

TEST_F(SceneEditorTest, OpensAScene) {
    work.picks.emplace_back();
    EXPECT_FALSE(editor.isOpen());
    editor.open(opened({}), 17);
    EXPECT_TRUE(editor.isOpen());
    EXPECT_EQ(work.title, "statue.pro");
    EXPECT_EQ(work.target_samples, 17u);
    EXPECT_EQ(work.scene.lights.size(), 3u) << "the studio's";
    EXPECT_TRUE(work.picks.empty());
    EXPECT_EQ(work.scene_up, (Vec3{0, 1, 0}));
    EXPECT_EQ(work.look.shown, SHOWN_BEAUTY);
    EXPECT_FALSE(editor.hasPendingEdits());
    editor.updateSurroundings();
    EXPECT_EQ(work.scene.lights.size(), 3u) << "nothing to do";
}

TEST_F(SceneEditorTest, TracksPendingEdits) {
    editor.open(opened({}), 4);
    Requests requests;
    requests.look_changed = true;
    editor.noteRequests(requests);
    EXPECT_FALSE(editor.hasPendingEdits()) << "the light is the same";
    requests.scene_changed = true;
    editor.noteRequests(requests);
    editor.noteRequests({});
    EXPECT_TRUE(editor.hasPendingEdits());
    editor.clearPendingEdits();
    EXPECT_FALSE(editor.hasPendingEdits());
    requests = {};
    requests.settings_changed = true;
    editor.noteRequests(requests);
    EXPECT_TRUE(editor.hasPendingEdits());
    editor.open(opened({}), 4);
    EXPECT_FALSE(editor.hasPendingEdits());
}

TEST_F(SceneEditorTest, BuildsTheRequestedRoom) {
    editor.open(opened({}), 4);
    const SceneDescription studio = work.scene;
    goTo(Room::kMatte, 5);
    EXPECT_EQ(work.scene.lights.size(), 5u);
    EXPECT_NE(work.scene.shapes, studio.shapes);
    EXPECT_FALSE(work.scene.materials.empty());
    goTo(Room::kNone);
    EXPECT_TRUE(work.scene.shapes.empty());
    EXPECT_TRUE(work.scene.materials.empty()) << "those of the removed room";
    goTo(std::nullopt);
    EXPECT_EQ(work.scene.lights, studio.lights);
    EXPECT_EQ(work.scene.shapes, studio.shapes);
}

TEST_F(SceneEditorTest, RestoresTheLightsOfARoom) {
    editor.open(opened({}), 4);
    goTo(Room::kMatte);
    const auto ring = work.scene.lights;
    work.scene.lights = {lampAt(1)};
    goTo(Room::kMirror);
    EXPECT_EQ(work.scene.lights.size(), 3u) << "its own";
    goTo(Room::kMatte);
    EXPECT_EQ(work.scene.lights, (std::vector<LightDescription>{lampAt(1)}));
    goTo(Room::kMatte, 2);
    EXPECT_EQ(work.scene.lights.size(), 2u) << "another number of them is requested";
    goTo(Room::kMatte);
    EXPECT_EQ(work.scene.lights, ring);
}

TEST_F(SceneEditorTest, SceneFileLightsAreInEveryRoom) {
    SceneDescription scene;
    scene.lights = {lampAt(2)};
    editor.open(opened(scene), 4);
    work.scene.lights = {lampAt(4)};
    goTo(Room::kMatte);
    EXPECT_EQ(work.scene.lights, (std::vector<LightDescription>{lampAt(4)}));
}

TEST_F(SceneEditorTest, KeepsMaterialsAndViewsFromRoomToRoom) {
    SceneDescription scene;
    scene.materials.resize(2);
    scene.instances.resize(1);
    editor.open(opened(scene), 4);
    work.scene.materials[1].color = {1, 0, 0};
    work.scene.instances[0].material = 1;
    work.scene.views.push_back({"mine", {}});
    goTo(Room::kMatte);
    goTo(Room::kNone);
    ASSERT_EQ(work.scene.materials.size(), 2u);
    EXPECT_EQ(work.scene.materials[1].color, (Color{1, 0, 0}));
    EXPECT_EQ(work.scene.instances[0].material, 1u);
    EXPECT_EQ(work.scene.views.size(), 1u);
}

TEST_F(SceneEditorTest, DenoisesAutomaticallyUnlessTheUserChooses) {
    RenderSettings settings;
    settings.integrator = Integrator::kWhitted;
    editor.open(opened({}, settings), 4);
    EXPECT_TRUE(work.denoise) << "the studio's lamps are soft";
    goTo(Room::kMirror);
    EXPECT_FALSE(work.denoise) << "the ring's are not";
    work.denoise = true;
    goTo(Room::kMatte);
    EXPECT_TRUE(work.denoise);
}

TEST_F(SceneEditorTest, SavesTheDefaultBackgroundOfGaussianCaptures) {
    OpenedScene scene = opened({});
    scene.subject.only_gaussians = true;
    scene.resolved = scene.file_scene;
    addSurroundings(scene.resolved, scene.settings, scene.camera, scene.bounds_min, scene.bounds_max, scene.subject);
    editor.open(scene, 16);
    EXPECT_EQ(sceneAsShown(work, {64, 48}).render.background, Background{});
    goTo(Room::kMatte);
    EXPECT_FALSE(sceneAsShown(work, {64, 48}).render.background);
    goTo(std::nullopt);
    EXPECT_EQ(pictureBackground(work.scene), Background{}) << "as it was";
    work.scene.sky->zenith = {0, 0, 1};
    EXPECT_FALSE(sceneAsShown(work, {64, 48}).render.background) << "the sky was edited";
}

class SavedRoom : public SceneEditorTest {
protected:
    /// The displayed scene, saved and read again, as pointrt-view opens it.
    OpenedScene reopened() {
        const test::TemporaryFolder folder;
        folder.write("statue.pro", "");
        SceneDescription shown = sceneAsShown(work, {64, 48});
        shown.instances = {{folder.file("statue.pro"), {}, {}, {}}};
        writeSceneFile(folder.file("statue.toml"), shown);
        OpenedScene scene = opened({});
        scene.file_scene = scene.resolved = readSceneFile(folder.file("statue.toml"));
        applyChoices(scene.file_scene.render, scene.settings);
        addSurroundings(scene.resolved, scene.settings, scene.camera, scene.bounds_min, scene.bounds_max);
        return scene;
    }
};

TEST_F(SavedRoom, IsChosenWhenItIsReopened) {
    editor.open(opened({}), 4);
    const std::optional<Room> rooms[] = {std::nullopt, Room::kMatte, Room::kMirror, Room::kNone};
    for (const std::optional<Room> room : rooms) {
        goTo(room, room ? std::optional(2u) : std::nullopt);
        work.scene.lights.back() = lampAt(7);
        const SceneDescription saved = work.scene;
        editor.open(reopened(), 4);
        EXPECT_EQ(work.settings.room, room);
        EXPECT_EQ(work.settings.lights, room ? std::optional(2u) : std::nullopt);
        EXPECT_EQ(work.scene.shapes, saved.shapes);
        EXPECT_EQ(work.scene.lights, saved.lights);
        EXPECT_EQ(work.scene.sky, saved.sky);
    }
}

TEST_F(SavedRoom, IsReplacedByAnotherOne) {
    editor.open(opened({}), 4);
    const SceneDescription studio = work.scene;
    editor.open(reopened(), 4);
    goTo(Room::kNone);
    EXPECT_TRUE(work.scene.shapes.empty()) << "no studio floor";
    EXPECT_TRUE(work.scene.materials.empty());
    goTo(std::nullopt);
    EXPECT_EQ(work.scene.lights, studio.lights);
    EXPECT_EQ(work.scene.shapes, studio.shapes);
}

TEST_F(SavedRoom, LeavesTheScenesOwnLights) {
    SceneDescription scene;
    scene.lights = {lampAt(2)};
    editor.open(opened(scene), 4);
    goTo(Room::kMatte);
    editor.open(reopened(), 4);
    EXPECT_EQ(work.settings.room, Room::kMatte);
    goTo(Room::kNone);
    EXPECT_TRUE(work.scene.shapes.empty());
    EXPECT_EQ(work.scene.lights, (std::vector<LightDescription>{lampAt(2)}));
}

TEST_F(SceneEditorTest, ChangesTheUpAxis) {
    editor.open(opened({}), 4);
    goTo(Room::kMatte);
    work.scene.lights = {lampAt(1)};
    ViewCamera home = work.camera;
    editor.setUp({0, 0, 1}, home, 1);
    EXPECT_EQ(work.scene_up, (Vec3{0, 0, 1}));
    EXPECT_EQ(sceneUp(work.scene, work.settings), (Vec3{0, 0, 1}));
    EXPECT_EQ(home.up, (Vec3{0, 0, 1}));
    EXPECT_LT(home.eye.y, -1) << "in front of it, where Z is up";
    EXPECT_EQ(work.scene.lights.size(), 3u) << "lamps begin anew";
    EXPECT_TRUE(editor.hasPendingEdits());
}

TEST_F(SceneEditorTest, SavesViewsByName) {
    editor.open(opened({}), 4);
    saveView(work);
    saveView(work);
    work.view_name = "front";
    saveView(work);
    EXPECT_EQ(work.view_name, "");
    work.view_name = "view 1";
    work.camera.fov_deg = 33;
    saveView(work);
    ASSERT_EQ(work.scene.views.size(), 3u);
    EXPECT_EQ(work.scene.views[0].name, "view 2");
    EXPECT_EQ(work.scene.views[1].name, "front");
    EXPECT_EQ(work.scene.views[2].name, "view 1");
    EXPECT_EQ(work.scene.views[2].camera.fov_deg, 33);
}

TEST_F(SceneEditorTest, SavesTheDisplayedScene) {
    editor.open(opened({}), 40);
    work.look.exposure = 1.5f;
    work.denoise = true;
    const SceneDescription saved = sceneAsShown(work, {64, 48});
    EXPECT_EQ(saved.render.size, (PixelSize{64, 48}));
    EXPECT_EQ(saved.render.spp, 40u);
    EXPECT_EQ(saved.render.exposure, 1.5f);
    EXPECT_EQ(saved.render.denoise, DenoiseChoice::kAuto) << "soft lamps are denoised by default";
    EXPECT_EQ(saved.lights, work.scene.lights) << "the studio's are its own now";
    EXPECT_EQ(saved.render.room, Room::kNone);
    work.target_samples = 256;
    EXPECT_EQ(sceneAsShown(work, {64, 48}).render.denoise, DenoiseChoice::kAuto) << "reopened, the box is ticked again";
    work.denoise = false;
    EXPECT_EQ(sceneAsShown(work, {64, 48}).render.denoise, DenoiseChoice::kOff);
    work.denoise = true;
    work.scene.lights = {lampAt(1)};
    EXPECT_EQ(sceneAsShown(work, {64, 48}).render.denoise, DenoiseChoice::kOn) << "hard light is not, by default";
}

/// The update between two descriptions.
class RequiredUpdateTest : public testing::Test {
protected:
    RequiredUpdateTest() {
        before.shapes.emplace_back();
        before.materials.emplace_back();
        before.lights = {lampAt(1)};
        scene.description = before;
        SceneRows rows = makeSceneRows(scene, before, settings);
        scene.features = rows.features;
        scene.shape_rows = std::move(rows.shapes);
    }
    UpdateKind to(const SceneDescription& after) {
        return requiredUpdate(scene, Integrator::kWhitted, after, settings).kind;
    }

    SceneDescription before;
    RenderSettings settings = [] {
        RenderSettings whitted;
        whitted.integrator = Integrator::kWhitted;
        return whitted;
    }();
    DeviceScene scene;
};

TEST_F(RequiredUpdateTest, ValuesNeedTables) {
    SceneDescription after = before;
    after.lights = {lampAt(2), lampAt(3)};
    after.materials[0].color = {1, 0, 0};
    after.shapes[0].center = {0, -1, 0};
    EXPECT_EQ(to(after), UpdateKind::kTables);
}

TEST_F(RequiredUpdateTest, OtherKindsNeedPrograms) {
    SceneDescription after = before;
    after.lights.emplace_back(SphereLight{{0, 3, 0}, 0.5, {1, 1, 1}, true});
    EXPECT_EQ(to(after), UpdateKind::kPrograms);
    after = before;
    after.sky = SkyDescription{};
    after.sky->image = "sky.hdr";
    EXPECT_EQ(to(after), UpdateKind::kPrograms);
    settings.integrator = Integrator::kPath;
    EXPECT_EQ(to(before), UpdateKind::kPrograms);
}

TEST_F(RequiredUpdateTest, MovedScansNeedTables_UnlessTheyArePainted) {
    before.instances.resize(1);
    scene.description = before;
    SceneDescription after = before;
    after.instances[0].placement.translation = {1, 2, 3};
    EXPECT_EQ(to(after), UpdateKind::kPlacements);
    after.lights.emplace_back(SphereLight{{0, 3, 0}, 0.5, {1, 1, 1}, true});
    EXPECT_EQ(to(after), UpdateKind::kPrograms) << "a kind of light that is new";
    after.lights = before.lights;
    settings.color_by = "height";
    EXPECT_EQ(to(after), UpdateKind::kPrograms);
}

TEST_F(RequiredUpdateTest, OtherScansNeedAReload) {
    SceneDescription after = before;
    after.instances.resize(1);
    EXPECT_EQ(to(after), UpdateKind::kReload);
}

TEST_F(RequiredUpdateTest, DragsNeverWaitForAJob) {
    constexpr bool drags = true, lacks_photons = true;
    EXPECT_EQ(nextUpdateStep(UpdateKind::kNothing, !drags, !lacks_photons), UpdateStep::kNothing);
    for (const bool lacks : {false, true}) {
        EXPECT_EQ(nextUpdateStep(UpdateKind::kTables, drags, lacks), UpdateStep::kUpload);
        EXPECT_EQ(nextUpdateStep(UpdateKind::kTables, !drags, lacks), UpdateStep::kUpload);
        EXPECT_EQ(nextUpdateStep(UpdateKind::kPlacements, drags, lacks), UpdateStep::kUpload);
        EXPECT_EQ(nextUpdateStep(UpdateKind::kPrograms, drags, lacks), UpdateStep::kNothing);
        EXPECT_EQ(nextUpdateStep(UpdateKind::kPrograms, !drags, lacks), UpdateStep::kSceneUpdate);
        EXPECT_EQ(nextUpdateStep(UpdateKind::kReload, !drags, lacks), UpdateStep::kSceneUpdate);
    }
    EXPECT_EQ(nextUpdateStep(UpdateKind::kNothing, drags, lacks_photons), UpdateStep::kNothing);
    EXPECT_EQ(nextUpdateStep(UpdateKind::kNothing, !drags, lacks_photons), UpdateStep::kSceneUpdate);
}

TEST_F(SceneEditorTest, UndoesAndRedoesAnyEditsToTheByte) {
    SceneDescription scene;
    scene.instances.push_back({"nave.pro", {}, {}, {}});
    scene.instances.push_back({"tower.pro", {}, {}, {}});
    editor.open(opened(scene), 4);
    editor.noteEdits();
    const ViewCamera camera = work.camera;
    const auto text = [&] {
        work.camera = camera; // which is no edit
        return sceneText(sceneAsShown(work, {64, 48}), "");
    };
    RandomEdits random(work, editor);
    std::vector<std::string> steps{text()};
    constexpr std::size_t kEdits = 200;
    while (steps.size() <= kEdits) {
        random.makeOne();
        const std::uint64_t before = editor.revision();
        editor.noteEdits();
        if (editor.revision() != before) steps.push_back(text());
    }
    for (const char* part : {"[[clip]]", "[[measure]]", "[[view]]", "[[light]]", "name = \"layer", "visible = false",
                             "locked = true", "[material.", "color_by", "[surroundings]"})
        EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [&](const std::string& step) {
            return step.find(part) != std::string::npos;
        })) << part;
    for (std::size_t at = kEdits; at-- > 0;) {
        ASSERT_TRUE(editor.undo());
        ASSERT_EQ(text(), steps[at]) << "step " << at;
    }
    EXPECT_FALSE(editor.undo());
    EXPECT_FALSE(editor.isModified());
    for (std::size_t at = 1; at <= kEdits; ++at) {
        ASSERT_TRUE(editor.redo());
        ASSERT_EQ(text(), steps[at]) << "step " << at;
    }
    EXPECT_FALSE(editor.redo());
}

TEST_F(SceneEditorTest, KeepsPicksAsAMeasurement) {
    editor.open(opened({}), 4);
    work.picks.resize(1);
    EXPECT_FALSE(keepMeasurement(work)) << "a point has no length";
    EXPECT_EQ(work.picks.size(), 1u);
    work.picks.resize(2);
    work.picks[1].position = {3, 4, 12};
    EXPECT_TRUE(keepMeasurement(work));
    EXPECT_TRUE(work.picks.empty());
    ASSERT_EQ(work.scene.measures.size(), 1u);
    EXPECT_EQ(measuredText(work.scene.measures[0], {"m", 1000}), "13.000 m");
    goTo(Room::kMatte);
    EXPECT_EQ(work.scene.measures.size(), 1u) << "it stays in every room";
}

TEST_F(SceneEditorTest, EditsGoOnFromAnUndoneState) {
    RenderSettings settings;
    settings.integrator = Integrator::kWhitted;
    editor.open(opened({}, settings), 4);
    goTo(Room::kMatte);
    editor.noteEdits();
    const auto ring = work.scene.lights;
    work.scene.lights = {lampAt(1)};
    editor.noteEdits();
    goTo(Room::kMirror);
    editor.noteEdits();
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(editor.undo());
    goTo(Room::kMirror);
    goTo(Room::kMatte);
    EXPECT_EQ(work.scene.lights, ring) << "the undone lamp is not remembered";
    editor.noteEdits();
    while (editor.undo()) continue;
    ASSERT_TRUE(work.denoise) << "the studio's lamps are soft";
    goTo(Room::kMirror);
    EXPECT_FALSE(work.denoise) << "still the automatic choice";
}

TEST_F(SceneEditorTest, TracksUnsavedEdits) {
    EXPECT_FALSE(editor.isModified()) << "nothing is open";
    editor.open(opened({}), 4);
    EXPECT_FALSE(editor.isModified());
    work.camera.eye.x += 1;
    work.look.shown = SHOWN_NORMAL;
    EXPECT_FALSE(editor.isModified()) << "looking around is no edit";
    work.look.exposure = 1;
    EXPECT_TRUE(editor.isModified()) << "before it is a step, too";
    editor.markSaved();
    EXPECT_FALSE(editor.isModified());
    EXPECT_TRUE(editor.undo());
    EXPECT_TRUE(editor.isModified()) << "the file has the later state";
    EXPECT_TRUE(editor.redo());
    EXPECT_FALSE(editor.isModified());
    editor.open(opened({}), 4);
    editor.markUnsaved();
    EXPECT_TRUE(editor.isModified());
}

TEST_F(SceneEditorTest, UndoneEditsNeedAnUpdate) {
    editor.open(opened({}), 4);
    work.scene.lights.clear();
    editor.noteEdits();
    editor.clearPendingEdits();
    work.requests = {};
    ASSERT_TRUE(editor.undo());
    EXPECT_EQ(work.scene.lights.size(), 3u);
    EXPECT_TRUE(editor.hasPendingEdits() && work.requests.look_changed);
    ViewCamera home = work.camera;
    editor.setUp({0, 0, 1}, home, 1);
    editor.noteEdits();
    work.camera = home;
    ASSERT_TRUE(editor.undo());
    EXPECT_EQ(work.scene_up, (Vec3{0, 1, 0}));
    EXPECT_EQ(work.camera.up, (Vec3{0, 1, 0})) << "the view is upright again";
}

TEST_F(SceneEditorTest, KnowsWhetherScansAreInView) {
    OpenedScene scene = opened({});
    for (int i = 0; i < 1000; ++i) { // a spiral on a sphere of radius 1
        const double z = 1 - (2 * i + 1) / 1000.0, r = std::sqrt(1 - z * z);
        scene.sample.splats.push_back({{r * std::cos(2.4 * i), r * std::sin(2.4 * i), z}, {}, 0.01, {}});
    }
    editor.open(scene, 4);
    const ViewSize size{160, 120};
    ViewCamera view = work.camera;
    EXPECT_TRUE(editor.seesScans(view, size));
    view.eye = {0, 0, 1.01};
    view.pivot = {0, 0, 1};
    EXPECT_TRUE(editor.seesScans(view, size)) << "one patch fills the picture";
    view.pivot = {0, 0, 2};
    view.eye = {0, 0, 1.5};
    EXPECT_FALSE(editor.seesScans(view, size)) << "it is behind the eye";
    view.eye = {5, 0, 5};
    view.pivot = {5, 0, 0};
    EXPECT_FALSE(editor.seesScans(view, size)) << "it is beside the picture";
    view.ortho_height = 2;
    EXPECT_FALSE(editor.seesScans(view, size));
    view.ortho_height = 20;
    EXPECT_TRUE(editor.seesScans(view, size));
}

TEST(Autosave, SurvivesACrashAndIsOfferedOnce) {
    const test::TemporaryFolder folder;
    SceneDescription scene;
    scene.lights = {lampAt(1)};
    scene.shapes.resize(1);
    scene.materials.resize(1);
    {
        Autosave crashed(folder.file("state"), "a.laz");
        EXPECT_EQ(crashed.left(), "");
        crashed.write(scene);
    }
    Autosave next(folder.file("state"), "a.laz");
    ASSERT_NE(next.left(), "");
    EXPECT_EQ(readSceneFile(next.left()).lights, scene.lights);
    EXPECT_EQ(Autosave(folder.file("state"), "a.laz").left(), "") << "another program has it";
    EXPECT_EQ(Autosave(folder.file("state"), "b.laz").left(), "");
    next.discard();
    EXPECT_EQ(next.left(), "");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("state")), {}), 1) << "its lock";
    Autosave nowhere("", "a.laz");
    nowhere.write(scene);
}

} // namespace
} // namespace pointrt
