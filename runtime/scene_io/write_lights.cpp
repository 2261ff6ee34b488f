// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

/// Writes the value of each type of field, as FieldReader reads it.
struct FieldWriter {
    SceneWriting& writing;

    void operator()(const PositionField& field) const { put(writing, field.key, tomlOf(field.value)); }
    void operator()(const AimField& field) const { put(writing, field.key, tomlOf(field.value)); }
    void operator()(const SunwardField& field) const { put(writing, "towards", tomlOf(field.value)); }
    void operator()(const ConeField& field) const {
        put(writing, "outer", tomlOf(field.outer_deg));
        put(writing, "inner", tomlOf(field.inner_deg));
    }
    void operator()(const AngularRadiusField& field) const { put(writing, "angular_radius", tomlOf(field.degrees)); }
    void operator()(const RadiusField& field) const { put(writing, "radius", tomlOf(field.value)); }
    void operator()(const HalfEdgesField& field) const {
        put(writing, "u", tomlOf(field.u));
        put(writing, "v", tomlOf(field.v));
    }
    void operator()(const VisibleField& field) const {
        if (!field.value) put(writing, "seen_by_camera", "false");
    }
    void operator()(const LayerField& field) const {
        putLayer(writing, field.layer);
        if (!field.visible) put(writing, "visible", "false");
    }
    void operator()(const EmissionField& field) const { put(writing, field.key(), tomlOf(field.value)); }
};

} // namespace

void writeLights(SceneWriting& writing) {
    for (LightDescription light : writing.scene.lights) {
        begin(writing, "[[light]]");
        put(writing, "type", tomlOf(std::string(namesOf(light.index()).type)));
        std::visit([&](auto& kind) { kind.eachField(FieldWriter{writing}); }, light);
    }
}

} // namespace pointrt
