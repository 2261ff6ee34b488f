// SPDX-License-Identifier: Apache-2.0
// phong and whitted: matte light, highlights, mirrored and refracted rays side by side (Whitted, An Improved
// Illumination Model for Shaded Display, 1980). whitted lets matte surfaces with a highlight mirror by Fresnel as well.
#ifndef POINTRT_SHADERS_SHADE_CLASSIC_GLSL
#define POINTRT_SHADERS_SHADE_CLASSIC_GLSL

// Rays weaker than a display's last step are not worth their cost.
const float kLeastWeight = 1.0 / 512.0;

// Nothing goes on past the last bounce: the sky's ambient light is shown in place of black.
NextRay lastOrNext(vec3 direction, vec3 weight, bool last, inout vec3 added) {
    if (last) added += weight * ambientLight(direction);
    return NextRay(direction, !last && largest(weight) > kLeastWeight ? weight : vec3(0.0), 0.0);
}

Shading shadeClassic(PathState path, Point point, Material row, SurfaceMaterial matter) {
    vec3 throughput = path.throughput.rgb, view = -path.direction.xyz;
    if (point.t < 0.0) return onlyLight(throughput * skySeen(path));
    SpecularPair pair = specularPair(matter, point.normal, view);
    vec3 added = throughput * (row.emission.rgb + smoothAlbedo(matter) * ambientLight(point.normal));
    bool last = bounceOf(pathBits(path)) >= params.mode.y;
    NextRay reflected = lastOrNext(pair.reflected, throughput * pair.reflected_weight, last, added);
    NextRay refracted = lastOrNext(pair.refracted, throughput * pair.refracted_weight, last, added);
    return Shading(added, hasSmoothLobe(matter) ? throughput : vec3(0.0), reflected, refracted);
}

#endif
