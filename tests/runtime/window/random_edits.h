// SPDX-License-Identifier: Apache-2.0
// Random edits of a scene, as the panels make them.
#pragma once

#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "runtime/scene/layers.h"
#include "runtime/window/edit/clip_edit.h"
#include "runtime/window/edit/light_edit.h"
#include "runtime/window/edit/measure_edit.h"
#include "runtime/window/edit/scene_editor.h"

namespace pointrt {

/// Edits of every kind, in the same order in each run.
class RandomEdits {
public:
    RandomEdits(Workspace& work, SceneEditor& editor) : work_(work), editor_(editor), home_(work.camera) {}

    void makeOne() {
        const std::function<void()> edits[] = {[&] { editLights(); },    [&] { editSurroundings(); },
                                               [&] { editSettings(); },  [&] { editLook(); },
                                               [&] { editViews(); },     [&] { editClips(); },
                                               [&] { editMeasures(); },  [&] { editLayers(); },
                                               [&] { editMaterials(); }, [&] { editUp(); }};
        edits[below(std::size(edits))]();
        editor_.updateSurroundings();
    }

private:
    unsigned below(std::size_t n) { return static_cast<unsigned>(random_() % n); }
    bool chance() { return below(2) == 0; }

    void editLights() {
        std::vector<LightDescription>& lights = work_.scene.lights;
        if (lights.empty() || chance())
            lights.push_back(newLight(below(kLightKinds), {{}, {0, 1, 0}, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
        else if (chance())
            lights.erase(lights.begin());
        else
            setBrightness(lights.back(), 1 + below(9), 1);
    }
    void editSurroundings() {
        constexpr std::array<std::optional<Room>, 4> kRooms{std::nullopt, Room::kMatte, Room::kMirror, Room::kNone};
        work_.settings.room = kRooms[below(kRooms.size())];
        work_.settings.lights = chance() ? std::nullopt : std::optional(1 + below(5));
    }
    void editSettings() {
        if (chance()) work_.settings.bounces = below(64);
        if (chance()) work_.settings.integrator = chance() ? Integrator::kPhong : Integrator::kPath;
        if (chance()) work_.settings.color_by = chance() ? kOwnColors : "height";
        if (chance()) work_.settings.color_map = ColorMap::kTurbo;
    }
    void editLook() {
        if (chance()) work_.look.exposure = static_cast<float>(below(32)) / 8;
        if (chance()) work_.denoise = !work_.denoise;
        if (chance()) work_.target_samples = 1 + below(512);
    }
    void editViews() {
        if (work_.scene.views.size() < 2 || chance())
            saveView(work_);
        else
            work_.scene.views.erase(work_.scene.views.begin());
    }
    void editClips() {
        std::vector<ClipDescription>& clips = work_.scene.clips;
        if (clips.size() < 4 && chance())
            clips.push_back(chance() ? newClipBox({-1, -1, -1}, {1, 1, 1}) : ClipDescription{ClipPlane{}});
        else if (!clips.empty() && std::holds_alternative<ClipBox>(clips.back().form))
            setBoxSide(std::get<ClipBox>(clips.back().form), below(3), true, 0.1 * below(9), 0.01);
        else if (!clips.empty())
            std::get<ClipPlane>(clips.back().form).point.z = below(9);
    }
    void editMeasures() {
        std::vector<MeasureDescription>& measures = work_.scene.measures;
        if (!measures.empty() && chance()) {
            measures.back().closed = !measures.back().closed;
            return;
        }
        work_.picks.resize(3);
        for (PickedPoint& pick : work_.picks) pick.position = {0.1 * below(9), 0.1 * below(9), 0};
        keepMeasurement(work_);
    }
    void editLayers() {
        const std::vector<LayerId> layers = layersOf(work_.scene);
        const LayerId id = layers[below(layers.size())];
        if (chance()) layerAt(work_.scene, id).name = "layer " + std::to_string(below(99));
        if (chance()) layerAt(work_.scene, id).locked = chance();
        if (chance()) setLayerVisible(work_.scene, id, chance());
        if (below(4) == 0 && mayDelete(work_.scene, id)) deleteLayer(work_.scene, id);
    }
    void editMaterials() {
        if (work_.scene.materials.empty()) work_.scene.materials.emplace_back().name = "new";
        MaterialDescription& material = work_.scene.materials.front();
        material.kind = chance() ? MaterialKind::kMatte : MaterialKind::kGlass;
        material.color = {0.1f * static_cast<float>(below(9)), 0.5f, 0.5f};
        work_.scene.instances.front().material = 0;
    }
    void editUp() {
        constexpr std::array<Vec3, 3> kAxes{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        editor_.setUp(kAxes[below(kAxes.size())], home_, 1);
    }

    Workspace& work_;
    SceneEditor& editor_;
    ViewCamera home_;
    std::mt19937 random_{1};
};

} // namespace pointrt
