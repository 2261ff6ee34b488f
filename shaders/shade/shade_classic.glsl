// SPDX-License-Identifier: Apache-2.0
// phong and whitted: matte light, highlights, and both mirrored and refracted rays (Whitted, An Improved Illumination
// Model for Shaded Display, 1980). In whitted, matte surfaces with a highlight also mirror, by Fresnel.
#ifndef POINTRT_SHADERS_SHADE_CLASSIC_GLSL
#define POINTRT_SHADERS_SHADE_CLASSIC_GLSL
#include "shaders/lib/sampler.glsl"

// Russian roulette: rays weaker than this, half an 8-bit step, survive with a probability proportional to their weight,
// and then get this weight.
const float kMinWeight = 1.0 / 512.0;

// The next ray. After the last bounce, the sky's ambient light replaces the ray.
NextRay lastOrNext(vec3 direction, vec3 weight, bool last, float u, inout vec3 radiance) {
    if (last) radiance += weight * ambientLight(direction);
    float chance = min(largest(weight) / kMinWeight, 1.0);
    return NextRay(direction, !last && u < chance ? weight / chance : vec3(0.0), 0.0);
}

Shading shadeClassic(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 throughput = path.throughput, view = -path.direction;
    uint bounce = bounceOf(path.bits);
    vec2 u = sample2(pixel, push.sample_index, dimensionPair(bounce, PAIR_DIRECTION), params.seed);
    if (point.t < 0.0) return onlyRadiance(throughput * skySeen(path));
    SpecularPair pair = specularPair(bsdf, point.normal, view);
    vec3 radiance = throughput * (row.emission.rgb + smoothAlbedo(bsdf) * ambientLight(point.normal));
    bool last = bounce >= ofLane(params.bounces);
    NextRay reflected = lastOrNext(pair.reflected, throughput * pair.reflected_weight, last, u.x, radiance);
    NextRay refracted = noRay();
    if (mayRefract) refracted = lastOrNext(pair.refracted, throughput * pair.refracted_weight, last, u.y, radiance);
    return Shading(radiance, hasSmoothLobe(bsdf) ? throughput : vec3(0.0), reflected, refracted);
}

#endif
