// SPDX-License-Identifier: Apache-2.0
// BSDFs. Directions are unit vectors pointing away from the surface; the normal n is on the side of wo. Rough surfaces
// have a glossy lobe over a matte (cosine) lobe: the material below the coat of a plastic, or interreflection between
// the microfacets of a metal (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, 2017). The matte lobe
// gets exactly the energy that the glossy one leaves, in both directions, so that white surfaces conserve energy.
//
// Kinds differ only in coefficients (Lobes): on CPUs all branches of a shader are executed anyway.
//
// The program defines loadGgxAlbedo(i), see ggx.glsl.
#ifndef POINTRT_SHADERS_MATERIAL_GLSL
#define POINTRT_SHADERS_MATERIAL_GLSL

#include "shaders/shared/scene_layout.h"

// A program may define which kinds of material it supports,
#ifndef mayHaveMaterial
#define mayHaveMaterial(kind) true
#endif
// that no material has a glossy lobe, which saves table lookups,
#ifndef mayBeRough
#define mayBeRough true
#endif

// and that no material has a Phong highlight.
#ifndef mayHaveHighlight
#define mayHaveHighlight true
#endif

#include "shaders/lib/basis.glsl"
#include "shaders/shade/fresnel.glsl"
#include "shaders/shade/ggx.glsl"

bool isKind(int kind, int wanted) { return mayHaveMaterial(wanted) && kind == wanted; }

// A material evaluated for one view direction wo.
struct Bsdf {
    vec3 albedo;
    vec3 reflect_tint;    // weight of a mirror reflection chosen with reflect_chance
    float reflect_chance; // probability of mirror reflection
    float refract_chance; // and of refraction
    float eta;            // glass: index of refraction on the side of wo over the one behind the surface
    bool thin;
    float alpha;          // of the glossy lobe
    float table_row;      // row of the glossy lobe in the GGX table
    vec3 facing;          // its Fresnel term at normal incidence
    float grazing;        // and at grazing angles: 1, or 0 without a glossy lobe
    vec3 glossy_albedo;   // directional albedo of the glossy lobe
    vec3 matte_albedo;    // and of the matte lobe below it
    vec3 coat;            // the glossy lobe transmits dot(coat, (1 - grazing, lost, 1)), with values of the GGX table
    float coat_mean;      // cosine-weighted mean of this transmittance over all directions
    float glossy_chance;  // probabilities of the lobes in sampleBsdf
    float matte_chance;
    float mirrored;       // share of the glossy lobe that phong and whitted treat as a mirror
    vec2 phong;           // weight and exponent of the highlight
};

struct Scattering {
    vec3 direction;
    vec3 weight;      // bsdf * |cosine| / pdf; 0 ends the path
    float pdf;        // over solid angle; 0: a delta lobe, or the path ends
    bool transmitted;
};

struct SpecularPair {
    vec3 reflected;
    vec3 reflected_weight;
    vec3 refracted;
    vec3 refracted_weight;
};

float coatLeaves(vec3 coat, vec2 table) { return dot(coat, vec3(1.0 - table.y, table.x, 1.0)); }

// Interreflection between the microfacets of a metal, tinted at each reflection. mean: average of Schlick's Fresnel
// term.
vec3 metalUnderside(vec3 facing, float lost) {
    vec3 mean = (20.0 * facing + 1.0) / 21.0;
    return mean * mean * (1.0 - lost) / (1.0 - mean * lost);
}

// Lobe coefficients of a material for one view direction; initialized to no reflection.
struct Lobes {
    float reflect_chance; // as in Bsdf, down to coat
    float refract_chance;
    vec3 reflect_tint;
    vec3 facing;
    float grazing;
    vec3 coat;
    vec3 below;           // reflectance of the matte lobe below the coat
    vec2 phong;
};

// Inputs of the functions that set Lobes.
struct Seen {
    vec3 albedo;
    float index;  // of refraction
    float eta;    // as in Bsdf
    bool thin;
    float cosine; // between normal and view direction
    float lost;   // mean energy that the glossy lobe loses (ggx.glsl)
};

void setMatte(inout Lobes lobes, Material material, Seen seen) {
    lobes.reflect_chance = clamp(mirrorShare(material), 0.0, 1.0);
    lobes.below = seen.albedo * (1.0 - lobes.reflect_chance);
    lobes.phong = vec2(highlightWeight(material), highlightExponent(material));
}

void setMetal(inout Lobes lobes, Material material, Seen seen) {
    lobes.facing = seen.albedo;
    lobes.grazing = 1.0;
    lobes.coat = vec3(0.0, 1.0, 0.0);
    lobes.below = metalUnderside(seen.albedo, seen.lost);
}

void setPlastic(inout Lobes lobes, Material material, Seen seen) {
    float dielectric = facingReflectance(seen.index);
    lobes.facing = vec3(dielectric);
    lobes.grazing = 1.0;
    lobes.coat = vec3(1.0 - dielectric, dielectric, 0.0);
    lobes.below = seen.albedo;
}

void setMirror(inout Lobes lobes, Material material, Seen seen) {
    lobes.reflect_chance = 1.0;
    lobes.reflect_tint = seen.albedo;
}

// Glass reflects according to Fresnel and transmits the rest, tinted by its albedo. Radiance scales with the square of
// the index on entering, and back on leaving. With camera and lights outside, the two factors cancel, so both are
// omitted, even for paths that end or start in glass; photons are weighted consistently (photon.comp.glsl).
void setGlass(inout Lobes lobes, Material material, Seen seen) {
    float behind, side = dielectricReflectance(seen.cosine, seen.eta, behind);
    lobes.reflect_chance = seen.thin ? paneReflectance(side) : side;
    lobes.refract_chance = 1.0 - lobes.reflect_chance;
}

// A kind without its function fails to compile.
Lobes lobesOf(Material material, Seen seen) {
    Lobes lobes = Lobes(0.0, 0.0, vec3(1.0), vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), vec3(0.0), vec2(0.0, 1.0));
    int kind = materialKind(material);
#define LOBES(number, NAME, Name, word, label, lobes_of_kind, traits)                                                  \
    if (isKind(kind, number)) lobes_of_kind(lobes, material, seen);
    MATERIALS(LOBES)
#undef LOBES
    return lobes;
}

// The BSDF of material. albedo: material.base times the colour of the splat; back: on the inner side of a closed
// surface; cosine: between normal and view direction.
Bsdf materialBsdf(Material material, vec3 albedo, bool back, float cosine) {
    float index = max(indexOfRefraction(material), 1.0), rough = max(roughness(material), GGX_MIN_ROUGHNESS);
    float facing = clamp(cosine, 1e-6, 1.0);
    Bsdf s;
    s.albedo = albedo;
    s.thin = isThin(material);
    s.eta = back && !s.thin ? index : 1.0 / index;
    s.alpha = rough * rough;
    s.table_row = ggxRow(rough);
    vec2 seen = vec2(0.0), mean = vec2(0.0);
    if (mayBeRough) {
        seen = ggxAlbedo(s.table_row, facing);
        mean = ggxMeanAlbedo(s.table_row);
    }
    Lobes lobes = lobesOf(material, Seen(albedo, index, s.eta, s.thin, facing, mean.x));
    s.reflect_chance = lobes.reflect_chance;
    s.refract_chance = lobes.refract_chance;
    s.reflect_tint = lobes.reflect_tint;
    s.facing = lobes.facing;
    s.grazing = lobes.grazing;
    s.coat = lobes.coat;
    s.coat_mean = coatLeaves(s.coat, mean);
    s.glossy_albedo = s.facing * (1.0 - seen.x - seen.y) + s.grazing * seen.y;
    s.matte_albedo = lobes.below * coatLeaves(s.coat, seen);
    // share of light left to the smooth lobes
    float share = 1.0 - s.reflect_chance - s.refract_chance;
    float glossy = largest(s.glossy_albedo), matte = largest(s.matte_albedo);
    s.glossy_chance = share * glossy / max(glossy + matte, 1e-9);
    s.matte_chance = share - s.glossy_chance;
    s.mirrored = s.grazing * (1.0 - rough) * (1.0 - rough);
    s.phong = lobes.phong;
    return s;
}

// Whether there is a lobe besides mirror reflection and refraction.
bool hasSmoothLobe(Bsdf s) { return s.glossy_chance + s.matte_chance > 0.0; }

// Whether next event estimation cannot sample this direction.
bool isDelta(Scattering scattering) { return scattering.pdf == 0.0; }

// The two smooth lobes for a pair of directions, each times dot(n, wi), and the density with which sampleBsdf draws wi.
// All 0 for directions below the surface.
void smoothLobes(Bsdf s, vec3 n, vec3 wo, vec3 wi, out vec3 glossy, out vec3 matte, out float pdf) {
    float cosine_i = dot(n, wi);
    bool above = cosine_i > 0.0;
    cosine_i = max(cosine_i, 1e-6);
    float by_cosine = cosine_i / kPi, share = by_cosine;
    glossy = vec3(0.0);
    pdf = 0.0;
    if (mayBeRough) {
        GgxLobe lobe = ggxLobe(s.alpha, n, wo, wi, max(dot(n, wo), 1e-6), cosine_i);
        vec3 fresnel = s.facing + (s.grazing - s.facing) * schlickWeight(lobe.facing);
        float leaves = coatLeaves(s.coat, ggxAlbedo(s.table_row, cosine_i));
        glossy = above ? fresnel * lobe.value : vec3(0.0);
        share = leaves / s.coat_mean * by_cosine;
        pdf = s.glossy_chance * lobe.pdf;
    }
    matte = above ? s.matte_albedo * share : vec3(0.0);
    pdf = above ? pdf + s.matte_chance * by_cosine : 0.0;
}

// bsdf * |dot(n, wi)| of the smooth lobes. The BSDF is reciprocal.
vec3 evaluateBsdf(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return glossy + matte;
}

// Density over solid angle with which sampleBsdf draws wi, delta lobes excluded. Its integral is less than 1 if there
// are delta lobes or samples below the surface.
float bsdfPdf(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return pdf;
}

vec3 refractedThrough(Bsdf s, vec3 n, vec3 wo) {
    float cosine = clamp(dot(n, wo), 1e-6, 1.0), behind;
    dielectricReflectance(cosine, s.eta, behind);
    return s.thin ? -wo : refractedDirection(n, wo, cosine, s.eta, behind);
}

// Draws a direction for u in [0, 1)^3: z chooses the lobe, xy the direction.
Scattering sampleBsdf(Bsdf s, vec3 n, vec3 wo, vec3 u) {
    float delta_chance = s.reflect_chance + s.refract_chance;
    bool specular = u.z < delta_chance || !hasSmoothLobe(s);
    bool refracts = specular && u.z >= s.reflect_chance && s.refract_chance > 0.0;
    mat3 frame = frameAround(n);
    bool glossy_lobe = mayBeRough && u.z < delta_chance + s.glossy_chance;
    vec3 smooth_wi = frame * ggxOrCosineSample(glossy_lobe, s.alpha, wo * frame, u.xy);
    vec3 delta_wi = refracts ? refractedThrough(s, n, wo) : reflect(-wo, n);
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, smooth_wi, glossy, matte, pdf);
    vec3 smooth_weight = pdf > 0.0 ? (glossy + matte) / pdf : vec3(0.0);
    vec3 delta_weight = refracts ? s.albedo : s.reflect_tint;
    return Scattering(specular ? delta_wi : smooth_wi, specular ? delta_weight : smooth_weight, specular ? 0.0 : pdf,
                      refracts);
}

// The reflected and the refracted ray of phong and whitted. A fraction (1 - roughness)^2 of a glossy lobe is reflected
// as by a mirror. For a white surface, the two weights and smoothAlbedo add up to 1.
SpecularPair specularPair(Bsdf s, vec3 n, vec3 wo) {
    return SpecularPair(reflect(-wo, n), s.reflect_chance * s.reflect_tint + s.mirrored * s.glossy_albedo,
                        refractedThrough(s, n, wo), s.refract_chance * s.albedo);
}

// Directional albedo, without the light of specularPair's rays.
vec3 smoothAlbedo(Bsdf s) { return (1.0 - s.mirrored) * s.glossy_albedo + s.matte_albedo; }

// Phong highlight of matte surfaces, in the unit of evaluateBsdf. It does not conserve energy.
float phongHighlight(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    float aligned = max(dot(reflect(-wi, n), wo), 0.0);
    return dot(n, wi) > 0.0 ? s.phong.x / kPi * pow(aligned, s.phong.y) : 0.0;
}

// evaluateBsdf and phongHighlight for integrators that follow specularPair's rays. For lights that those rays can hit,
// the mirrored share of the glossy lobe is left to them; delta lights, which no ray hits, get the whole lobe.
vec3 classicBsdf(Bsdf s, vec3 n, vec3 wo, vec3 wi, bool rays_hit_light) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    vec3 smooth_light = glossy * (rays_hit_light ? 1.0 - s.mirrored : 1.0) + matte;
    if (mayHaveHighlight) smooth_light += phongHighlight(s, n, wo, wi);
    return smooth_light;
}

// The mirror share (gloss.w) with which whitted shows a highlight as a reflection: the Fresnel term of common
// dielectrics, in full for highlights of weight 1/4 and more.
float highlightMirrorShare(Material material, float cosine) {
    const float kCommonFacing = 0.04;
    float gloss = kCommonFacing + (1.0 - kCommonFacing) * schlickWeight(clamp(cosine, 0.0, 1.0));
    float weight = highlightWeight(material);
    bool highlighted = materialKind(material) == MATERIAL_MATTE && weight > 0.0;
    return max(mirrorShare(material), highlighted ? gloss * min(1.0, 4.0 * weight) : 0.0);
}

#endif
