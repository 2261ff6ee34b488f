// SPDX-License-Identifier: Apache-2.0
// The kinds of material, one row each, and a material as the shaders read it. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_MATERIALS_H
#define POINTRT_SHADERS_MATERIALS_H

#ifdef __cplusplus
#include <bit>

#include "shaders/shared/vectors.h"
#define POINTRT_SHARED_FUNCTION inline
#define POINTRT_SHARED_NUMBER inline constexpr int
#else
#define POINTRT_SHARED_FUNCTION
#define POINTRT_SHARED_NUMBER const int
#endif

// Traits.
#define MATERIAL_IS_CLEAR 1u         // only reflects and transmits light: white by default, casts caustics
#define MATERIAL_REFRACTS 2u         // splits a ray into a reflected and a refracted one
#define MATERIAL_IS_ROUGH 4u         // has a GGX lobe
#define MATERIAL_MIRRORS_BY_SHARE 8u // reflects rays and casts caustics in proportion to its mirror share
#define MATERIAL_SHOWS_DIRECTION 16u // its look depends on the direction of light, which photons do not record

// clang-format off
// X(number, NAME, Name, word, label, lobes, traits)
//   number      counts from 0
//   NAME, Name  MATERIAL_NAME here, MaterialKind::kName in C++ (runtime/scene/material_kinds.h)
//   word        name in scene files
//   label       name in the window
//   lobes       function of shaders/shade/material.glsl that sets its scattering lobes
//   traits      MATERIAL_* above
// The fields of each kind: runtime/scene/material_fields.cpp.
#define MATERIALS(X) \
    X(0, MATTE, Matte, "matte", "Matte", setMatte, MATERIAL_MIRRORS_BY_SHARE) \
    X(1, METAL, Metal, "metal", "Metal", setMetal, MATERIAL_IS_ROUGH | MATERIAL_SHOWS_DIRECTION) \
    X(2, PLASTIC, Plastic, "plastic", "Plastic", setPlastic, MATERIAL_IS_ROUGH) \
    X(3, MIRROR, Mirror, "mirror", "Mirror", setMirror, MATERIAL_IS_CLEAR) \
    X(4, GLASS, Glass, "glass", "Glass", setGlass, MATERIAL_IS_CLEAR | MATERIAL_REFRACTS)
// clang-format on

#define MATERIAL_NUMBER(number, NAME, Name, word, label, lobes, traits) POINTRT_SHARED_NUMBER MATERIAL_##NAME = number;
MATERIALS(MATERIAL_NUMBER)
#undef MATERIAL_NUMBER

#ifdef __cplusplus
namespace pointrt::gpu {
#endif

#define MATERIAL_USES_SPLAT_COLOR 1u
#define MATERIAL_THIN 2u // glass: a pane; light passes through it undeviated

// A row of the scene's material table. The functions below name its components.
struct Material {
    vec4 base;       // linear reflectance; w: as bits, MATERIAL_USES_SPLAT_COLOR, MATERIAL_THIN
    vec4 gloss;      // x: MATERIAL_*, y: roughness (GGX alpha is its square), z: index of refraction, w: mirror share
    vec4 phong;      // x: weight of the Phong highlight, y: its exponent
    vec4 emission;   // radiance, on both sides; w: as bits, the light that samples it, or NO_LIGHT
    vec4 absorption; // glass: absorption coefficient inside, per unit length
};
#define MATERIAL_VECTORS 5

#ifdef __cplusplus
static_assert(sizeof(Material) == MATERIAL_VECTORS * sizeof(vec4));
inline uint materialBits(const Material& m) { return std::bit_cast<uint>(m.base.w); }
inline uint materialLight(const Material& m) { return std::bit_cast<uint>(m.emission.w); }
#define POINTRT_SHARED_MATERIAL const Material&
#else
uint materialBits(Material m) { return floatBitsToUint(m.base.w); }
uint materialLight(Material m) { return floatBitsToUint(m.emission.w); }
#define POINTRT_SHARED_MATERIAL Material
#endif

POINTRT_SHARED_FUNCTION int materialKind(POINTRT_SHARED_MATERIAL m) { return int(m.gloss.x); }
POINTRT_SHARED_FUNCTION float roughness(POINTRT_SHARED_MATERIAL m) { return m.gloss.y; }
POINTRT_SHARED_FUNCTION float indexOfRefraction(POINTRT_SHARED_MATERIAL m) { return m.gloss.z; }
POINTRT_SHARED_FUNCTION float mirrorShare(POINTRT_SHARED_MATERIAL m) { return m.gloss.w; }
POINTRT_SHARED_FUNCTION float highlightWeight(POINTRT_SHARED_MATERIAL m) { return m.phong.x; }
POINTRT_SHARED_FUNCTION float highlightExponent(POINTRT_SHARED_MATERIAL m) { return m.phong.y; }
POINTRT_SHARED_FUNCTION bool usesSplatColor(POINTRT_SHARED_MATERIAL m) {
    return (materialBits(m) & MATERIAL_USES_SPLAT_COLOR) != 0u;
}
POINTRT_SHARED_FUNCTION bool isThin(POINTRT_SHARED_MATERIAL m) { return (materialBits(m) & MATERIAL_THIN) != 0u; }

#undef POINTRT_SHARED_MATERIAL
#undef POINTRT_SHARED_FUNCTION
#undef POINTRT_SHARED_NUMBER

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif
