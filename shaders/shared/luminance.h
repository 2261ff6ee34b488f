// SPDX-License-Identifier: Apache-2.0
// Luminance of a linear colour (Rec. 709). Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_LUMINANCE_H
#define POINTRT_SHADERS_LUMINANCE_H

#define LUMINANCE_WEIGHTS 0.2126, 0.7152, 0.0722

#ifdef __cplusplus
namespace pointrt {

/// In the precision of Real: luminance<double>(r, g, b).
template <class Real>
constexpr Real luminance(Real red, Real green, Real blue) {
    constexpr double weights[] = {LUMINANCE_WEIGHTS};
    return static_cast<Real>(weights[0]) * red + static_cast<Real>(weights[1]) * green +
           static_cast<Real>(weights[2]) * blue;
}

} // namespace pointrt
#else
float luminance(vec3 linear) { return dot(linear, vec3(LUMINANCE_WEIGHTS)); }
#endif

#endif
