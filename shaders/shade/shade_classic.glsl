// SPDX-License-Identifier: Apache-2.0
// phong and whitted: matte light, highlights, mirrored and refracted rays side by side (Whitted, An Improved
// Illumination Model for Shaded Display, 1980). whitted lets matte surfaces with a highlight mirror by Fresnel as well.
#ifndef POINTRT_SHADERS_SHADE_CLASSIC_GLSL
#define POINTRT_SHADERS_SHADE_CLASSIC_GLSL
#include "shaders/lib/sampler.glsl"

// Of rays weaker than half a display's last step only some are followed, with this weight: chance keeps their sum.
const float kMinWeight = 1.0 / 512.0;

// Nothing goes on past the last bounce: the sky's ambient light is shown in place of black.
NextRay lastOrNext(vec3 direction, vec3 weight, bool last, float u, inout vec3 added) {
    if (last) added += weight * ambientLight(direction);
    float chance = min(largest(weight) / kMinWeight, 1.0);
    return NextRay(direction, !last && u < chance ? weight / chance : vec3(0.0), 0.0);
}

Shading shadeClassic(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 throughput = path.throughput, view = -path.direction;
    uint bounce = bounceOf(path.bits);
    vec2 u = sample2(pixel, push.sample_index, dimensionPair(bounce, PAIR_DIRECTION), params.seed);
    if (point.t < 0.0) return onlyLight(throughput * skySeen(path));
    SpecularPair pair = specularPair(bsdf, point.normal, view);
    vec3 added = throughput * (row.emission.rgb + smoothAlbedo(bsdf) * ambientLight(point.normal));
    bool last = bounce >= ofLane(params.bounces);
    NextRay reflected = lastOrNext(pair.reflected, throughput * pair.reflected_weight, last, u.x, added);
    NextRay refracted = noRay();
    if (mayRefract) refracted = lastOrNext(pair.refracted, throughput * pair.refracted_weight, last, u.y, added);
    return Shading(added, hasSmoothLobe(bsdf) ? throughput : vec3(0.0), reflected, refracted);
}

#endif
