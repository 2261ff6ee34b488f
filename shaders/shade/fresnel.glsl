// SPDX-License-Identifier: Apache-2.0
// Reflectance of smooth boundaries. Cosines are in [0, 1].
#ifndef POINTRT_SHADERS_FRESNEL_GLSL
#define POINTRT_SHADERS_FRESNEL_GLSL

// Schlick's weight of the reflection at grazing angles.
float schlickWeight(float cosine) {
    float m = 1.0 - min(cosine, 1.0), m2 = m * m;
    return m2 * m2 * m;
}

// Reflectance at normal incidence of a boundary between air and a medium of this index of refraction.
float facingReflectance(float index) {
    float r = (index - 1.0) / (index + 1.0);
    return r * r;
}

// Fresnel's equations for unpolarized light. cosine > 0; eta: ratio of the indices of refraction in front of and behind
// the boundary. cosine_behind: of the refracted direction; 0 beyond the critical angle, where all light is reflected.
float dielectricReflectance(float cosine, float eta, out float cosine_behind) {
    cosine_behind = sqrt(max(0.0, 1.0 - eta * eta * (1.0 - cosine * cosine)));
    float across = (eta * cosine - cosine_behind) / (eta * cosine + cosine_behind);
    float along = (cosine - eta * cosine_behind) / (cosine + eta * cosine_behind);
    return 0.5 * (across * across + along * along);
}

// Reflectance of a pane, the sum over all internal reflections. side: reflectance of each of its two sides.
float paneReflectance(float side) { return 2.0 * side / (1.0 + side); }

// Refracted direction of light from wo. cosine = dot(n, wo).
vec3 refractedDirection(vec3 n, vec3 wo, float cosine, float eta, float cosine_behind) {
    return normalize((eta * cosine - cosine_behind) * n - eta * wo);
}

#endif
