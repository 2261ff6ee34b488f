// SPDX-License-Identifier: Apache-2.0
// How surfaces scatter light. Directions point away from the surface and have unit length, the normal n is on the side
// of wo. Rough surfaces are a glossy lobe over one that scatters by cosine: matter below a plastic's coat, or what a
// metal's facets pass on among themselves (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, 2017).
// The lower one gets exactly what the upper one leaves, in both directions, so that white surfaces give back all light.
//
// Kinds differ in coefficients alone (Lobes): on CPUs all branches of a shader are run anyway.
//
// The program defines loadGgxAlbedo(i), see ggx.glsl.
#ifndef POINTRT_SHADERS_MATERIAL_GLSL
#define POINTRT_SHADERS_MATERIAL_GLSL

#include "shaders/shared/scene_layout.h"

// A program may say which kinds there are.
#ifndef mayHaveMaterial
#define mayHaveMaterial(kind) true
#endif
// And whether any of those has the glossy lobe: what a table tells of that need not be asked for else.
#ifndef mayBeRough
#define mayBeRough true
#endif

// And whether any has Phong's highlight.
#ifndef mayHaveHighlight
#define mayHaveHighlight true
#endif

#include "shaders/lib/basis.glsl"
#include "shaders/shade/fresnel.glsl"
#include "shaders/shade/ggx.glsl"

bool isKind(int kind, int wanted) { return mayHaveMaterial(wanted) && kind == wanted; }

// A material as seen from one direction wo.
struct Bsdf {
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

// What a kind of material makes of the light from wo. As its function is given it, nothing is reflected.
struct Lobes {
    float reflect_chance; // as in Bsdf
    float refract_chance;
    vec3 reflect_tint;
    vec3 facing;
    float grazing;
    vec3 coat;
    vec3 below;           // reflectance of the matte lobe below the coat
    vec2 phong;
};

// What it is asked for.
struct Seen {
    vec3 albedo;
    float index;  // of refraction
    float eta;    // as in Bsdf
    bool thin;
    float cosine; // between normal and view
    float lost;   // by the glossy lobe on average (ggx.glsl)
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

// Glass reflects by Fresnel and lets the rest through, coloured by its albedo. Radiance grows with the square of the
// index inside and shrinks by the same on the way out. Camera and lights being outside, both factors are left away, for
// light that ends or starts in glass as well; photons are weighed alike (photon.comp.glsl).
void setGlass(inout Lobes lobes, Material material, Seen seen) {
    float behind, side = dielectricReflectance(seen.cosine, seen.eta, behind);
    lobes.reflect_chance = seen.thin ? paneReflectance(side) : side;
    lobes.refract_chance = 1.0 - lobes.reflect_chance;
}

// A kind without its function does not compile.
Lobes lobesOf(Material material, Seen seen) {
    Lobes lobes = Lobes(0.0, 0.0, vec3(1.0), vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), vec3(0.0), vec2(0.0, 1.0));
    int kind = materialKind(material);
#define LOBES(number, NAME, Name, word, label, lobes_of_kind, traits)                                                  \
    if (isKind(kind, number)) lobes_of_kind(lobes, material, seen);
    MATERIALS(LOBES)
#undef LOBES
    return lobes;
}

// material as seen in a direction whose cosine with the normal is that, back on the inner side of a closed surface.
// albedo: material.base times the colour of the splat.
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
    // of light that is not reflected as by a mirror
    float share = 1.0 - s.reflect_chance - s.refract_chance;
    float glossy = largest(s.glossy_albedo), matte = largest(s.matte_albedo);
    s.glossy_chance = share * glossy / max(glossy + matte, 1e-9);
    s.matte_chance = share - s.glossy_chance;
    s.mirrored = s.grazing * (1.0 - rough) * (1.0 - rough);
    s.phong = lobes.phong;
    return s;
}

// Whether light from other directions than the perfectly reflected and refracted ones is scattered to wo.
bool hasSmoothLobe(Bsdf s) { return s.glossy_chance + s.matte_chance > 0.0; }

// Whether no light asked for at the point could have come this way.
bool isDelta(Scattering scattering) { return scattering.pdf == 0.0; }

// The two smooth lobes at a pair of directions, both times dot(n, wi), and sampleBsdf's density of wi. All 0 for
// directions below the surface.
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

// bsdf * |dot(n, wi)| without perfectly reflected and refracted light. The bsdf is the same for exchanged directions.
vec3 evaluateBsdf(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return glossy + matte;
}

// The density over solid angle in which sampleBsdf chooses wi, but by perfect reflection and refraction. Where those
// have a share, or where it answers directions below the surface, its integral is less than 1.
float bsdfPdf(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    return pdf;
}

vec3 refractedWay(Bsdf s, vec3 n, vec3 wo) {
    float cosine = clamp(dot(n, wo), 1e-6, 1.0), behind;
    dielectricReflectance(cosine, s.eta, behind);
    return s.thin ? -wo : refractedDirection(n, wo, cosine, s.eta, behind);
}

// Draws a direction from u in [0, 1): z chooses the lobe, xy the direction.
Scattering sampleBsdf(Bsdf s, vec3 n, vec3 wo, vec3 u) {
    float sharp = s.reflect_chance + s.refract_chance;
    bool specular = u.z < sharp || !hasSmoothLobe(s);
    bool refracts = specular && u.z >= s.reflect_chance && s.refract_chance > 0.0;
    mat3 frame = frameAround(n);
    vec3 smooth_wi = frame * ggxOrCosineSample(mayBeRough && u.z < sharp + s.glossy_chance, s.alpha, wo * frame, u.xy);
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
SpecularPair specularPair(Bsdf s, vec3 n, vec3 wo) {
    return SpecularPair(reflect(-wo, n), s.reflect_chance * s.reflect_tint + s.mirrored * s.glossy_albedo,
                        refractedWay(s, n, wo), s.refract_chance * s.albedo);
}

// What is given back to wo of light that comes evenly from all directions, without what specularPair's rays bring.
vec3 smoothAlbedo(Bsdf s) { return (1.0 - s.mirrored) * s.glossy_albedo + s.matte_albedo; }

// Phong's highlight of matte surfaces, in evaluateBsdf's unit; it conserves no energy.
float phongHighlight(Bsdf s, vec3 n, vec3 wo, vec3 wi) {
    float aligned = max(dot(reflect(-wi, n), wo), 0.0);
    return dot(n, wi) > 0.0 ? s.phong.x / kPi * pow(aligned, s.phong.y) : 0.0;
}

// evaluateBsdf and phongHighlight for integrators that follow specularPair's rays. Of a lamp that those rays can meet,
// the glossy lobe adds only what they do not bring; a lamp without extent is seen by no ray, and adds all.
vec3 classicBsdf(Bsdf s, vec3 n, vec3 wo, vec3 wi, bool rays_meet_lamp) {
    vec3 glossy, matte;
    float pdf;
    smoothLobes(s, n, wo, wi, glossy, matte, pdf);
    vec3 smooth_light = glossy * (rays_meet_lamp ? 1.0 - s.mirrored : 1.0) + matte;
    if (mayHaveHighlight) smooth_light += phongHighlight(s, n, wo, wi);
    return smooth_light;
}

// The mirror share (gloss.w) with which whitted shows what phong shows with a highlight alone: Fresnel's for the index
// of common dielectrics, in full from a highlight of weight a quarter up.
float glossedMirrorShare(Material material, float cosine) {
    const float kCommonFacing = 0.04;
    float gloss = kCommonFacing + (1.0 - kCommonFacing) * schlickWeight(clamp(cosine, 0.0, 1.0));
    float weight = highlightWeight(material);
    bool highlighted = materialKind(material) == MATERIAL_MATTE && weight > 0.0;
    return max(mirrorShare(material), highlighted ? gloss * min(1.0, 4.0 * weight) : 0.0);
}

#endif
