// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/material_fields.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace pointrt {
namespace {

using M = MaterialDescription;
constexpr double kLargest = 1e12; ///< squares and products of a few such numbers still fit in float

// In the order of written scene files.
constexpr MaterialField kFields[] = {
    {"mirror_share", &M::mirror_share, 0, 1, "Mirror", "share of light reflected as by a mirror", "%.2f", false},
    {"specular", &M::specular, 0, 1, "Highlight", "for direct light and mirrors", "%.2f", false},
    {"shininess", &M::shininess, 1, 1000, "Sharpness", "of the highlight", "%.0f", true, nullptr, &M::specular},
    {"index", &M::index, 1, 4, "Index", "refractive index: water 1.33, glass and varnish 1.5, diamond 2.42", "%.2f",
     false},
    {"roughness", &M::roughness, 0, 1, "Roughness", "0: polished, 1: dull", "%.2f", false},
    {"thin", &M::thin, 0, 1, "Pane", "a thin pane, not a solid: light goes straight through", "", false},
    {"absorption", &M::absorption, 0, kLargest, "Tint",
     "colour of white light after passing through a tenth of the scene", "", false, &M::thin},
};

constexpr const MaterialField* field(std::string_view key) {
    for (const MaterialField& each : kFields)
        if (key == each.key) return &each;
    throw "no such field"; // not a constant expression: a wrong key fails to compile
}

template <std::size_t kCount>
using Fields = std::array<const MaterialField*, kCount>;

// One list per kind in MATERIALS, in the panel's order.
constexpr Fields<3> kMatteFields{field("mirror_share"), field("specular"), field("shininess")};
constexpr Fields<1> kMetalFields{field("roughness")};
constexpr Fields<2> kPlasticFields{field("roughness"), field("index")};
constexpr Fields<0> kMirrorFields{};
constexpr Fields<3> kGlassFields{field("index"), field("thin"), field("absorption")};

} // namespace

std::span<const MaterialField* const> fieldsOf(MaterialKind kind) {
    switch (kind) {
#define POINTRT_FIELDS(number, NAME, Name, word, label, lobes, traits)                                                 \
    case MaterialKind::k##Name:                                                                                        \
        return k##Name##Fields;
        MATERIALS(POINTRT_FIELDS)
#undef POINTRT_FIELDS
    }
    return {};
}

std::vector<const MaterialField*> writtenFieldsOf(MaterialKind kind) {
    const auto has = fieldsOf(kind);
    std::vector<const MaterialField*> written(has.begin(), has.end());
    std::sort(written.begin(), written.end());
    return written;
}

} // namespace pointrt
