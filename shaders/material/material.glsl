// SPDX-License-Identifier: Apache-2.0
// How surfaces scatter light. Directions point away from the surface and have unit length, the normal n is on the side
// of wo. Rough surfaces are a glossy lobe over one that scatters by cosine: matter below a plastic's coat, or what a
// metal's facets pass on among themselves (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, 2017).
// The lower one gets exactly what the upper one leaves, in both directions, so that white surfaces give back all light.
//
// Kinds differ in coefficients alone: on CPUs all branches of a shader are run anyway.
//
// The program defines loadGgxAlbedo(i), see ggx.glsl.
#ifndef POINTRT_SHADERS_MATERIAL_GLSL
#define POINTRT_SHADERS_MATERIAL_GLSL

#include "shaders/shared/scene_layout.h"

// A program may say which kinds there are.
#ifndef mayHaveMaterial
#define mayHaveMaterial(kind) true
#endif

bool isKind(int kind, int wanted) { return mayHaveMaterial(wanted) && kind == wanted; }
#include "shaders/math/basis.glsl"
#include "shaders/material/fresnel.glsl"
#include "shaders/material/ggx.glsl"

// A material as seen from one direction wo.
struct SurfaceMaterial {
    vec3 albedo;
    vec3 reflect_tint;    // weight of perfectly reflected light where it is chosen by reflect_chance
    float reflect_chance; // shares of perfectly reflected
    float refract_chance; // and refracted light
    float eta;            // glass: the index on the side of wo over the one behind the surface
    bool thin;
    float alpha;          // of the glossy lobe
    float table_row;
    vec3 facing;          // its Fresnel term at normal incidence
    float grazing;        // and at grazing angles: 1, or 0 where there is no such lobe
    vec3 glossy_albedo;   // what it gives back of light from wo
    vec3 matte_albedo;    // and the matte lobe below it
    vec3 coat;            // what the upper lobe leaves is dot(coat, (1 - grazing, lost, 1)) by the table
    float coat_mean;      // its mean over all directions, weighted by cosine
    float glossy_chance;  // of sampleBsdf
    float matte_chance;
    float mirrored;       // share of the glossy lobe that whitted takes for a mirror's
    vec2 phong;           // weight and exponent of the highlight
};

struct Scattering {
    vec3 direction;
    vec3 weight;      // bsdf * |cosine| / pdf; 0 where the path ends
    float pdf;        // over solid angle; 0: the direction was the only one, or the path ends
    bool transmitted;
};

struct SpecularPair {
    vec3 reflected;
    vec3 reflected_weight;
    vec3 refracted;
    vec3 refracted_weight;
};

float coatLeaves(vec3 coat, vec2 table) { return dot(coat, vec3(1.0 - table.y, table.x, 1.0)); }

// What a metal's facets pass on among themselves is coloured at each turn. facing is averaged over Schlick's term.
vec3 metalUnderside(vec3 facing, float lost) {
    vec3 mean = (20.0 * facing + 1.0) / 21.0;
    return mean * mean * (1.0 - lost) / (1.0 - mean * lost);
}

// The lobes of rough kinds, none for others; share is the part of light that is not reflected as by a mirror.
void setRoughLobes(inout SurfaceMaterial s, int kind, float roughness, float index, float share, float cosine) {
    bool metal = isKind(kind, MATERIAL_METAL), plastic = isKind(kind, MATERIAL_PLASTIC);
    float rough = max(roughness, GGX_MIN_ROUGHNESS), dielectric = facingReflectance(index);
    s.alpha = rough * rough;
    s.table_row = ggxRow(rough);
    s.facing = metal ? s.albedo : vec3(plastic ? dielectric : 0.0);
    s.grazing = metal || plastic ? 1.0 : 0.0;
    vec2 seen = ggxAlbedo(s.table_row, cosine), mean = ggxMeanAlbedo(s.table_row);
    s.coat = metal ? vec3(0.0, 1.0, 0.0) : plastic ? vec3(1.0 - dielectric, dielectric, 0.0) : vec3(0.0, 0.0, 1.0);
    s.coat_mean = coatLeaves(s.coat, mean);
    vec3 below = metal ? metalUnderside(s.facing, mean.x) : s.albedo * share;
    s.glossy_albedo = s.facing * (1.0 - seen.x - seen.y) + s.grazing * seen.y;
    s.matte_albedo = below * coatLeaves(s.coat, seen);
    float glossy = largest(s.glossy_albedo), matte = largest(s.matte_albedo);
    s.glossy_chance = share * glossy / max(glossy + matte, 1e-9);
    s.matte_chance = share - s.glossy_chance;
    s.mirrored = s.grazing * (1.0 - rough) * (1.0 - rough);
}

// Glass reflects by Fresnel and lets the rest through, coloured by its albedo; back: wo is inside. Radiance grows with
// the square of the index inside and shrinks by the same on the way out. Camera and lights being outside, both factors
// are left away, for light that ends or starts in glass as well; photons are weighed alike (photon.comp.glsl).
void setGlass(inout SurfaceMaterial s, float index, bool back, float cosine) {
    s.eta = back && !s.thin ? index : 1.0 / index;
    float behind, side = dielectricReflectance(cosine, s.eta, behind);
    s.reflect_chance = s.thin ? paneReflectance(side) : side;
    s.refract_chance = 1.0 - s.reflect_chance;
}

// material as seen in a direction whose cosine with the normal is that, back on the inner side of a closed surface.
// albedo: material.base times the colour of the splat.
SurfaceMaterial surfaceMaterial(Material material, vec3 albedo, bool back, float cosine) {
    int kind = int(material.gloss.x);
    float index = max(material.gloss.z, 1.0), facing = clamp(cosine, 1e-6, 1.0);
    bool mirror = isKind(kind, MATERIAL_MIRROR), glass = isKind(kind, MATERIAL_GLASS), matte = isKind(kind, MATERIAL_MATTE);
    SurfaceMaterial s;
    s.albedo = albedo;
    s.thin = (floatBitsToUint(material.base.w) & MATERIAL_THIN) != 0u;
    setGlass(s, index, back, facing);
    float mirror_share = mirror ? 1.0 : matte ? clamp(material.gloss.w, 0.0, 1.0) : 0.0;
    s.reflect_chance = glass ? s.reflect_chance : mirror_share;
    s.refract_chance = glass ? s.refract_chance : 0.0;
    s.reflect_tint = mirror ? albedo : vec3(1.0);
    setRoughLobes(s, kind, material.gloss.y, index, glass ? 0.0 : 1.0 - mirror_share, facing);
    s.phong = matte ? material.phong.xy : vec2(0.0, 1.0);
    return s;
}

// Whether light from other directions than the perfectly reflected and refracted ones is scattered to wo.
bool hasSmoothLobe(SurfaceMaterial s) { return s.glossy_chance + s.matte_chance > 0.0; }

// Whether no light asked for at the point could have come this way.
bool isDelta(Scattering scattering) { return scattering.pdf == 0.0; }

// The two smooth lobes at a pair of directions, both times dot(n, wi), and sampleBsdf's density of wi. All 0 for
// directions below the surface.
void smoothLobes(SurfaceMaterial s, vec3 n, vec3 wo, vec3 wi, out vec3 glossy, out vec3 matte, out float pdf) {
    float cosine_i = dot(n, wi);
    bool above = cosine_i > 0.0;
    cosine_i = max(cosine_i, 1e-6);
    GgxLobe lobe = ggxLobe(s.alpha, n, wo, wi, max(dot(n, wo), 1e-6), cosine_i);
    float grazing = schlickWeight(lobe.facing), by_cosine = cosine_i / kPi;
    vec3 fresnel = s.facing + (s.grazing - s.facing) * grazing;
    float leaves = coatLeaves(s.coat, ggxAlbedo(s.table_row, cosine_i));
    glossy = above ? fresnel * lobe.value : vec3(0.0);
    matte = above ? s.matte_albedo * (leaves / s.coat_mean * by_cosine) : vec3(0.0);
    pdf = above ? s.glossy_chance * lobe.pdf + s.matte_chance * by_cosine : 0.0;
}

// bsdf * |dot(n, wi)| without perfectly reflected and refracted light. The bsdf is the same for exchanged directions.
vec3 evaluateBsdf(SurfaceMaterial s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return glossy + matte;
}

// The density over solid angle in which sampleBsdf chooses wi, but by perfect reflection and refraction. Where those
// have a share, or where it answers directions below the surface, its integral is less than 1.
float bsdfPdf(SurfaceMaterial s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return pdf;
}

vec3 refractedWay(SurfaceMaterial s, vec3 n, vec3 wo) {
    float cosine = clamp(dot(n, wo), 1e-6, 1.0), behind;
    dielectricReflectance(cosine, s.eta, behind);
    return s.thin ? -wo : refractedDirection(n, wo, cosine, s.eta, behind);
}

// Draws a direction from u in [0, 1): z chooses the lobe, xy the direction.
Scattering sampleBsdf(SurfaceMaterial s, vec3 n, vec3 wo, vec3 u) {
    float sharp = s.reflect_chance + s.refract_chance;
    bool specular = u.z < sharp || !hasSmoothLobe(s);
    bool refracts = specular && u.z >= s.reflect_chance && s.refract_chance > 0.0;
    mat3 frame = frameAround(n);
    vec3 smooth_wi = frame * ggxOrCosineSample(u.z < sharp + s.glossy_chance, s.alpha, wo * frame, u.xy);
    vec3 sharp_wi = refracts ? refractedWay(s, n, wo) : reflect(-wo, n);
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, smooth_wi, glossy, matte, pdf);
    vec3 smooth_weight = pdf > 0.0 ? (glossy + matte) / pdf : vec3(0.0);
    vec3 sharp_weight = refracts ? s.albedo : s.reflect_tint;
    return Scattering(specular ? sharp_wi : smooth_wi, specular ? sharp_weight : smooth_weight, specular ? 0.0 : pdf,
                      refracts);
}

// For integrators without chance. The rays for perfectly reflected and refracted light; glossy lobes are taken for a
// mirror's to the share (1 - roughness)^2. Both weights and smoothAlbedo add up to 1 for a white surface.
SpecularPair specularPair(SurfaceMaterial s, vec3 n, vec3 wo) {
    return SpecularPair(reflect(-wo, n), s.reflect_chance * s.reflect_tint + s.mirrored * s.glossy_albedo,
                        refractedWay(s, n, wo), s.refract_chance * s.albedo);
}

// What is given back to wo of light that comes evenly from all directions, without what specularPair's rays bring.
vec3 smoothAlbedo(SurfaceMaterial s) { return (1.0 - s.mirrored) * s.glossy_albedo + s.matte_albedo; }

// Phong's highlight of matte surfaces, in evaluateBsdf's unit; it conserves no energy.
float phongHighlight(SurfaceMaterial s, vec3 n, vec3 wo, vec3 wi) {
    float aligned = max(dot(reflect(-wi, n), wo), 0.0);
    return dot(n, wi) > 0.0 ? s.phong.x / kPi * pow(aligned, s.phong.y) : 0.0;
}

// evaluateBsdf and phongHighlight for integrators that follow specularPair's rays. Of a lamp that those rays can meet,
// the glossy lobe adds only what they do not bring; a lamp without extent is seen by no ray, and adds all.
vec3 classicBsdf(SurfaceMaterial s, vec3 n, vec3 wo, vec3 wi, bool rays_meet_lamp) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return glossy * (rays_meet_lamp ? 1.0 - s.mirrored : 1.0) + matte + phongHighlight(s, n, wo, wi);
}

// The mirror share (gloss.w) with which whitted shows what phong shows with a highlight alone: Fresnel's for the index
// of common dielectrics, in full from a highlight of weight a quarter up.
float glossedMirrorShare(Material material, float cosine) {
    const float kCommonFacing = 0.04;
    float gloss = kCommonFacing + (1.0 - kCommonFacing) * schlickWeight(clamp(cosine, 0.0, 1.0));
    bool highlighted = int(material.gloss.x) == MATERIAL_MATTE && material.phong.x > 0.0;
    return max(material.gloss.w, highlighted ? gloss * min(1.0, 4.0 * material.phong.x) : 0.0);
}

#endif
