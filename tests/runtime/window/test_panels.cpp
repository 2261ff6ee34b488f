// SPDX-License-Identifier: Apache-2.0
// The panels, used with a mouse, and drawn with extreme values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "panel_driver.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/sun.h"
#include "runtime/window/edit/light_edit.h"

namespace pointrt {
namespace {

/// A scan on a floor under a sun and a lamp.
Workspace litScan() {
    Workspace w;
    w.scene.instances.push_back({"scans/bust.pro", {}, {}, {}});
    w.scene.materials.push_back({});
    w.scene.materials.back().name = "floor";
    w.scene.shapes.push_back({});
    w.scene.lights.push_back(SunLight{Vec3{0, 1, 0}, 0.3, {3, 3, 3}});
    w.scene.lights.push_back(SphereLight{Vec3{1, 2, 3}, 0.5, {8, 6, 4}, true});
    w.scene_min = {-1, 0, -1};
    w.scene_max = {1, 2, 1};
    w.camera = framedView({}, w.scene_min, w.scene_max, {0, 1, 0}, 1.5);
    return w;
}

PickedPoint pick(Vec3 position) {
    PickedPoint point;
    point.splat = 7;
    point.source = "scans/bust.pro";
    point.position = position;
    point.normal = {0, 0, 1};
    point.radius = 0.01;
    point.color = {{200, 100, 50}};
    return point;
}

/// Everything that can be displayed, at once.
Workspace busyScan() {
    Workspace w = litScan();
    w.picks = {pick({0, 1, 0}), pick({0.5, 1, 0})};
    w.pin_measurement = w.show_cheat_sheet = true;
    w.job = JobStatus{"Baking bust.ply", "normals", 0.3, 75.0, true};
    w.notices = {{"saved", false, 10}, {"broken", true, 0.1}, {"gone", false, -5}};
    w.scene.views = {{"front", {}}, {"front", {}}, {"", {}}};
    w.color_words = {"rgb", "height", "classification"};
    w.settings.color_by = "height";
    w.legend = barLegend("height", ColorMap::kViridis, {0, 10});
    return w;
}

bool asksNothing(const Requests& r) {
    return !(r.scene_changed || r.settings_changed || r.look_changed || r.dragging || r.save_scene || r.screenshot ||
             r.save_view || r.home || r.quit || r.cancel_job || r.go_to_view || r.delete_view || r.turntable_pictures);
}

void showAll(Workspace w, float width = 1280, float height = 720) {
    PanelDriver driver(width, height);
    const SceneDescription before = w.scene;
    driver.openAll(w);
    for (int f = 0; f < 5; ++f) EXPECT_TRUE(asksNothing(driver.frame(w)));
    const bool comparable = before == before; // false for NaN
    EXPECT_TRUE(!comparable || w.scene == before);
}

TEST(Panels, DrawingChangesNothing) {
    showAll({});
    showAll(busyScan());
    Workspace many = busyScan();
    for (std::size_t i = 0; i < 300; ++i)
        many.scene.lights.push_back(newLight(i % kLightKinds, {{}, {0, 1, 0}, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    many.scene.instances.resize(254, many.scene.instances.front());
    many.scene.materials.resize(256);
    showAll(many);
}

TEST(Panels, LayersHideAndDelete) {
    Workspace w = litScan();
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Lights", 1, "##visible"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    EXPECT_FALSE(isVisible(w.scene.lights[1]));
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Lights", 1, "light 2##name"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Delete"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    EXPECT_EQ(w.scene.lights.size(), 1u);
}

/// Drags a handle of the selected layer to the right.
Requests dragHandle(PanelDriver& driver, Workspace& w, const char* id) {
    EXPECT_TRUE(driver.find(w, id, {"handle"})) << id;
    driver.press(w);
    const Requests requests = driver.move(w, 30);
    driver.release(w);
    return requests;
}

TEST(Panels, HandlesMoveAndTurnTheSelectedLayer) {
    Workspace w = litScan();
    w.scan_centres = {{0, 1, 0}};
    PanelDriver driver(1280, 720);
    driver.frame(w);
    PanelDriver::open("Light", false);
    PanelDriver::open("Layers");
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Scans", 0, "bust.pro##name"}));
    driver.click(w);
    EXPECT_TRUE(dragHandle(driver, w, "##move x").scene_changed);
    const Placement moved = w.scene.instances[0].placement;
    EXPECT_GT(std::abs(moved.translation.x), 0.01);
    EXPECT_EQ(moved.translation.y, 0);
    EXPECT_EQ(moved.translation.z, 0);
    EXPECT_TRUE(dragHandle(driver, w, "##turn z").scene_changed);
    const Placement turned_after = w.scene.instances[0].placement;
    EXPECT_LT(turned_after.rotation[0].x, 0.999);
    EXPECT_NEAR(turned_after.rotation[2].z, 1, 1e-9) << "about z";
    EXPECT_LT(length(placed(turned_after, w.scan_centres[0]) - placed(moved, w.scan_centres[0])), 1e-9);
    w.scene.instances[0].layer.locked = true;
    EXPECT_FALSE(driver.find(w, "##move x", {"handle"})) << "locked";
}

TEST(Panels, ShapesAreAddedAtThePickedPoint) {
    Workspace w = litScan();
    w.picks = {pick({0, 2, 0})};
    w.picks[0].normal = {0, -1, 0}; // the normal of a surface seen from behind: the shape is put on the side of the eye
    w.camera.eye = {0, 5, 5};
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Add a shape"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, PanelDriver::childOf("##Popup").c_str(), {"Ball"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_EQ(w.scene.shapes.size(), 2u);
    const ShapeDescription& ball = w.scene.shapes.back();
    EXPECT_EQ(ball.layer.name, "Ball");
    EXPECT_NEAR(length(ball.center - Vec3{0, 2 + length(ball.u), 0}), 0, 1e-9) << "it rests on the point";
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Kind", "##value"})) << "its values are shown";
}

TEST(Panels, ScansAreComparedWithOthers) {
    Workspace w = litScan();
    w.scene.instances.push_back({"scans/before.pro", {}, {}, {}});
    w.scan_centres = {{}, {}};
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Scans", 0, "bust.pro##name"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Layers", "Compare with", "##value"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, PanelDriver::childOf("##Combo").c_str(), {"before.pro##1"}));
    const Requests requests = driver.click(w);
    ASSERT_TRUE(requests.compare);
    EXPECT_EQ(requests.compare->reference, 1u);
    EXPECT_EQ(requests.compare->compared, 0u);
}

TEST(Panels, LockedLayersStay) {
    Workspace w = litScan();
    w.scene.lights[0] = SunLight{Vec3{0, 1, 0}, 0.3, {3, 3, 3}};
    std::get<SunLight>(w.scene.lights[0]).layer.locked = true;
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", "Copy"}));
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", "Delete"}));
    EXPECT_FALSE(driver.click(w).scene_changed);
    EXPECT_EQ(w.scene.lights.size(), 2u);
}

TEST(Panels, PaletteRunsCommands) {
    Workspace w = litScan();
    w.show_palette = true;
    PanelDriver driver(1280, 720);
    for (int f = 0; f < 3; ++f) driver.frame(w);
    ImGui::GetIO().AddInputCharactersUTF8("picture EXR");
    driver.frame(w);
    EXPECT_TRUE(w.show_palette);
    EXPECT_EQ(driver.hit(w, Key::kEnter).action, Action::kScreenshot);
    EXPECT_FALSE(w.show_palette);
}

TEST(Panels, ToolbarButtonsRunTheirActions) {
    Workspace w = litScan();
    PanelDriver driver(800, 600);
    ASSERT_TRUE(driver.find(w, "Toolbar", {"Open"}));
    EXPECT_EQ(driver.click(w).action, Action::kOpen);
    ASSERT_TRUE(driver.find(w, "Toolbar", {"Undo"}));
    EXPECT_FALSE(driver.click(w).action) << "nothing to undo";
    ASSERT_TRUE(driver.find(w, "Toolbar", {"Commands"}));
}

/// The toolbar, the statistics and the panel share the window without overlapping.
TEST(Panels, DoNotOverlapFrom800x600On) {
    for (const float width : {800.0f, 1280.0f}) {
        Workspace w = busyScan();
        w.show_cheat_sheet = false;
        w.hud.picture_width = 500;
        PanelDriver driver(width, 600);
        for (int f = 0; f < 3; ++f) driver.frame(w);
        const ImRect toolbar = ImGui::FindWindowByName("Toolbar")->Rect();
        const ImRect statistics = ImGui::FindWindowByName("Statistics")->Rect();
        const ImRect panel = ImGui::FindWindowByName("Panel")->Rect();
        EXPECT_LE(toolbar.Max.y, statistics.Min.y);
        EXPECT_LE(toolbar.Max.x, panel.Min.x);
    }
}

TEST(Panels, BrowserOpensFilesAndFolders) {
    Workspace w;
    w.browser = FileBrowser{"/scans", {{"site", true}, {"nave.laz"}, {"tower.laz"}}, ""};
    PanelDriver driver(1280, 720);
    driver.frame(w);
    const std::string list = PanelDriver::childOf("Open/entries");
    ASSERT_TRUE(driver.find(w, list.c_str(), {0, "site/"}));
    EXPECT_EQ(driver.click(w).browse, "/scans/site");
    ASSERT_TRUE(driver.find(w, list.c_str(), {1, "nave.laz"}));
    driver.click(w);
    EXPECT_TRUE(w.browser->entries[1].chosen);
    ASSERT_TRUE(driver.find(w, list.c_str(), {2, "tower.laz"}));
    driver.hold(Key::kControl, true);
    driver.click(w);
    driver.hold(Key::kControl, false);
    ASSERT_TRUE(driver.find(w, "Open", {"Open"}));
    EXPECT_EQ(driver.click(w).open_files, (std::vector<std::string>{"/scans/nave.laz", "/scans/tower.laz"}));
}

/// Folders open with a single click. A double click on one must not open what is under the cursor afterwards.
TEST(Panels, BrowserOpensNoFileByADoubleClickOnAFolder) {
    Workspace w;
    w.browser = FileBrowser{"/scans", {{"site", true}}, ""};
    PanelDriver driver(1280, 720);
    driver.frame(w);
    ASSERT_TRUE(driver.find(w, PanelDriver::childOf("Open/entries").c_str(), {0, "site/"}));
    EXPECT_EQ(driver.click(w).browse, "/scans/site");
    w.browser = FileBrowser{"/scans/site", {{"tower.laz"}}, ""};
    EXPECT_TRUE(driver.click(w).open_files.empty());
    EXPECT_TRUE(w.browser->entries[0].chosen);
}

/// In small windows, headers of lower sections are at the bottom.
TEST(Panels, SectionsAreInSightOnceTheyAreOpened) {
    constexpr float kLess = 20, kMore = 900; // smaller than a header's height, and larger than all open sections
    for (float height = 500; height < kMore; height += kLess) {
        Workspace w = litScan();
        PanelDriver driver(1280, height);
        if (!driver.find(w, "Panel", {"Clip"})) continue;
        driver.click(w);
        EXPECT_TRUE(driver.find(w, "Panel", {"Clip", "Plane"})) << height;
        return;
    }
    FAIL() << "no window shows the header";
}

TEST(Panels, FitAnyWindow) {
    for (const float side : {1.0f, 20.0f, 150.0f, 8000.0f}) showAll(busyScan(), side, side);
    showAll(busyScan(), 1, 2000);
    showAll(busyScan(), 2000, 1);
}

TEST(Panels, ShowAbsurdNumbers) {
    for (const double absurd :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e30, 0.0}) {
        const float number = static_cast<float>(std::clamp(absurd, -1e30, 1e30));
        const Vec3 point{absurd, absurd, absurd};
        const Color color{number, number, number};
        Workspace w = busyScan();
        w.scene.lights = {PointLight{point, color},
                          SpotLight{point, point, absurd, absurd, color},
                          SunLight{point, absurd, color},
                          SphereLight{point, absurd, color, true},
                          QuadLight{point, point, point, color, true},
                          DiscLight{point, point, absurd, color, true}};
        w.scene.clips = {{ClipBox{point, point}}, {ClipPlane{point, point}}};
        w.scene.up = w.scene_max = w.camera.eye = w.picks[0].position = point;
        w.scene.sky = SkyDescription{color, color, color, "", absurd, number, number};
        w.scene.instances[0].material = 0;
        w.scene.materials[0] = {
            "", MaterialKind::kGlass, color, true, number, number, number, number, number, false, color, color};
        w.hud.frame_ms = w.hud.sample_share = w.time_s = w.look.depth_black = absurd;
        w.look.exposure = number;
        w.look.shown = 77;
        w.job->progress = w.job->seconds_left = absurd;
        for (int selected = 0; selected < 5; ++selected) {
            showAll(w);
            std::rotate(w.scene.lights.begin(), w.scene.lights.begin() + 1, w.scene.lights.end());
        }
    }
}

TEST(Panels, RepeatTheRequestWhenADragEnds) {
    Workspace w = litScan();
    PanelDriver driver;
    ASSERT_TRUE(driver.find(w, "Panel", {"Picture", "Exposure", "##value"}));
    EXPECT_TRUE(asksNothing(driver.frame(w)));
    driver.press(w);
    const Requests moved = driver.move(w, 15);
    EXPECT_TRUE(moved.look_changed && moved.dragging);
    EXPECT_FALSE(moved.scene_changed || moved.settings_changed);
    const Requests held = driver.frame(w);
    EXPECT_TRUE(held.dragging);
    EXPECT_FALSE(held.look_changed);
    const Requests released = driver.release(w);
    EXPECT_TRUE(released.look_changed);
    EXPECT_FALSE(released.dragging);
    EXPECT_NE(w.look.exposure, 0);
    EXPECT_TRUE(asksNothing(driver.frame(w)));
}

TEST(Panels, ChangeTheScansMaterial) {
    Workspace w = litScan();
    PanelDriver driver;
    driver.frame(w);
    driver.open("Materials");
    ASSERT_TRUE(driver.find(w, "Panel", {"Materials", "Material", "##value"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, "##Combo_00", {"Glass"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_TRUE(w.scene.instances[0].material.has_value());
    ASSERT_LT(*w.scene.instances[0].material, w.scene.materials.size());
    EXPECT_EQ(w.scene.materials[*w.scene.instances[0].material].kind, MaterialKind::kGlass);
    EXPECT_EQ(w.scene.materials[w.scene.shapes[0].material].kind, MaterialKind::kMatte);
}

TEST(Panels, DeleteTheSelectedLight) {
    Workspace w = litScan();
    PanelDriver driver;
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", "Delete"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_EQ(w.scene.lights.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<SphereLight>(w.scene.lights[0]));
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", "Delete"})); // the list is shorter now
    driver.click(w);
    EXPECT_TRUE(w.scene.lights.empty());
    driver.find(w, "Panel", {"Light", "Delete"});
    EXPECT_TRUE(asksNothing(driver.click(w)));
}

TEST(Panels, AddALightAndSelectIt) {
    Workspace w = litScan();
    PanelDriver driver;
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", "Add"}));
    driver.click(w);
    const ImGuiWindow* menu = GImGui->OpenPopupStack.back().Window;
    ASSERT_TRUE(menu);
    ASSERT_TRUE(driver.find(w, menu->Name, {"Softbox"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_EQ(w.scene.lights.size(), 3u);
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", 2, "Width", "##value"}));
    driver.press(w);
    EXPECT_TRUE(driver.move(w, -20).scene_changed);
    EXPECT_LT(length(std::get<QuadLight>(w.scene.lights[2]).u), length(std::get<QuadLight>(w.scene.lights[2]).v));
}

TEST(Panels, AddMoveDisableAndDeleteClips) {
    Workspace w = litScan();
    PanelDriver driver;
    driver.frame(w);
    driver.open("Clip");
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", "Box"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_EQ(w.scene.clips.size(), 1u);
    EXPECT_EQ(std::get<ClipBox>(w.scene.clips[0].form).high, w.scene_max);
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", 0, "Y to", "##value"}));
    driver.press(w);
    const Requests moved = driver.move(w, -30);
    EXPECT_TRUE(moved.scene_changed && moved.dragging);
    driver.release(w);
    EXPECT_LT(std::get<ClipBox>(w.scene.clips[0].form).high.y, w.scene_max.y);
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", "Plane"}));
    driver.click(w);
    ASSERT_EQ(w.scene.clips.size(), 2u);
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", 1, "Flip"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    EXPECT_EQ(std::get<ClipPlane>(w.scene.clips[1].form).normal, (Vec3{0, 1, 0})); // it was level
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", 1, "##enabled"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    EXPECT_FALSE(w.scene.clips[1].enabled);
    ASSERT_TRUE(driver.find(w, "Panel", {"Clip", "Delete"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    ASSERT_EQ(w.scene.clips.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<ClipBox>(w.scene.clips[0].form));
}

TEST(Panels, RespectTheLimitOfClips) {
    Workspace w = litScan();
    w.scene.clips.resize(5, {ClipBox{{0, 0, 0}, {1, 1, 1}}});
    PanelDriver driver;
    driver.frame(w);
    driver.open("Clip");
    driver.find(w, "Panel", {"Clip", "Box"});
    EXPECT_TRUE(asksNothing(driver.click(w)));
    EXPECT_EQ(w.scene.clips.size(), 5u);
}

TEST(Panels, RespectTheLightLimit) {
    Workspace w = litScan();
    w.scene.lights.resize(32, w.scene.lights[0]);
    PanelDriver driver;
    driver.find(w, "Panel", {"Light", "Copy"});
    driver.click(w);
    EXPECT_EQ(w.scene.lights.size(), 32u);
}

TEST(Panels, RequestARoom) {
    Workspace w = litScan();
    PanelDriver driver;
    ASSERT_TRUE(driver.find(w, "Panel", {"Room", "Mirror"}));
    EXPECT_TRUE(driver.click(w).settings_changed);
    EXPECT_EQ(w.settings.room, Room::kMirror);
    w.settings.lights = 5;
    ASSERT_TRUE(driver.find(w, "Panel", {"Room", "Studio"}));
    EXPECT_TRUE(driver.click(w).settings_changed);
    EXPECT_FALSE(w.settings.room || w.settings.lights);
}

TEST(Panels, SetTheSunByDate) {
    Workspace w = litScan();
    PanelDriver driver;
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", 0, "Place and date"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Light", 0, "Place and date", "Set the sun"}));
    EXPECT_TRUE(driver.click(w).scene_changed);
    // the panel's initial date: Greenwich, 2025-06-21 15:00 UTC; north is -Z
    SunPosition sun = sunPosition(1750518000, 51.48, 0);
    sun.elevation_deg += refraction(sun.elevation_deg);
    const Vec3 expected = sunDirection(sun, {0, 1, 0}, {0, 0, -1});
    EXPECT_LT(length(std::get<SunLight>(w.scene.lights[0]).towards - expected), 1e-6);
}

TEST(Panels, OfferAvailableAttributes) {
    Workspace w = litScan();
    w.color_words = {"rgb", "height", "classification"};
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Colours", "Colour by", "##value"}));
    driver.click(w);
    ASSERT_TRUE(driver.find(w, "##Combo_00", {"classification"}));
    EXPECT_TRUE(driver.click(w).settings_changed);
    EXPECT_EQ(w.settings.color_by, "classification");
    EXPECT_FALSE(driver.find(w, "Panel", {"Colours", "From", "##value"})) << "classes have no range";
}

TEST(Panels, DragTheRangeOfColours) {
    Workspace w = busyScan();
    w.show_cheat_sheet = false;
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Colours", "To", "##value"}));
    driver.press(w);
    const Requests moved = driver.move(w, 20);
    EXPECT_TRUE(moved.settings_changed && moved.dragging);
    ASSERT_TRUE(w.settings.color_range);
    EXPECT_EQ(w.settings.color_range->low, 0);
    EXPECT_GT(w.settings.color_range->high, 10);
    EXPECT_TRUE(driver.release(w).settings_changed);
    ASSERT_TRUE(driver.find(w, "Panel", {"Colours", "Reset range"}));
    driver.click(w);
    EXPECT_FALSE(w.settings.color_range);
}

TEST(Panels, ShowALegendOfTheColours) {
    Workspace w = litScan();
    w.legend = listLegend("classification", ColorMap::kClasses, std::vector<double>{2, 6});
    PanelDriver driver(1280, 720);
    const auto shown = [&] {
        driver.frame(w);
        const ImGuiWindow* box = ImGui::FindWindowByName("Legend");
        return box && box->Active;
    };
    EXPECT_FALSE(shown()) << "their own colours";
    w.settings.color_by = "classification";
    EXPECT_TRUE(shown());
    w.settings.legend = false;
    EXPECT_FALSE(shown());
}

TEST(Panels, CancelTheJob) {
    Workspace w = busyScan();
    w.show_cheat_sheet = false;
    PanelDriver driver(1280, 720);
    ASSERT_TRUE(driver.find(w, "Job", {"Cancel"}));
    EXPECT_TRUE(driver.click(w).cancel_job);
    w.job->can_cancel = false;
    EXPECT_FALSE(driver.find(w, "Job", {"Cancel"}));
}

TEST(Panels, RequestTheTurntable) {
    Workspace w = litScan();
    PanelDriver driver;
    driver.openAll(w);
    ASSERT_TRUE(driver.find(w, "Panel", {"Output", "Turntable"}));
    EXPECT_EQ(driver.click(w).turntable_pictures, 36u);
    w.job = JobStatus{};
    EXPECT_FALSE(driver.click(w).turntable_pictures.has_value());
}

TEST(Panels, LeaveTheCentreFree) {
    Workspace w = litScan();
    PanelDriver driver(1280, 720);
    driver.frame(w);
    ImGui::GetIO().MousePos = {490, 360};
    driver.frame(w);
    driver.frame(w);
    EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse);
    ImGui::GetIO().MousePos = {1200, 360};
    driver.frame(w);
    driver.frame(w);
    EXPECT_TRUE(ImGui::GetIO().WantCaptureMouse);
}

TEST(Panels, MarkPicksOnThePicture) {
    Workspace w = litScan();
    w.show_hud = w.show_panel = false;
    PanelDriver driver(1280, 720);
    driver.frame(w);
    EXPECT_EQ(ImGui::GetDrawData()->TotalVtxCount, 0);
    w.picks = {pick(w.camera.pivot)};
    driver.frame(w);
    const ImDrawData* data = ImGui::GetDrawData();
    ASSERT_GT(data->TotalVtxCount, 0);
    double x = 0, y = 0;
    for (const ImDrawVert& vertex : data->CmdLists[0]->VtxBuffer) x += vertex.pos.x, y += vertex.pos.y;
    EXPECT_NEAR(x / data->TotalVtxCount, 640, 0.6); // ImGui draws lines through pixel centres
    EXPECT_NEAR(y / data->TotalVtxCount, 360, 0.6);
}

TEST(UiStyle, FollowsTheScreen) {
    PanelDriver driver;
    const auto scaleAt = [](float content, float pixels) {
        setUpUiStyle(content, pixels);
        // builds the font as the window does; Build() would undo the line height of the built-in one
        unsigned char* texels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
        ImGui::NewFrame();
        const float scale = uiScale();
        ImGui::Render();
        return scale;
    };
    EXPECT_FLOAT_EQ(scaleAt(1, 1), 1);
    EXPECT_FLOAT_EQ(scaleAt(2, 1), 2);
    EXPECT_FLOAT_EQ(scaleAt(2, 2), 1);
    EXPECT_FLOAT_EQ(scaleAt(std::numeric_limits<float>::quiet_NaN(), 1), scaleAt(0.5f, 1));
}

} // namespace
} // namespace pointrt
