// SPDX-License-Identifier: Apache-2.0
// The integrators, one row each, as command line, scene files, window, host and shaders use them. Valid in C++ and
// GLSL.
#ifndef POINTRT_SHADERS_INTEGRATORS_H
#define POINTRT_SHADERS_INTEGRATORS_H

// Traits.
#define INTEGRATOR_USES_LIGHTS 1u        // shades with the scene's lights; the others show surfaces unlit
#define INTEGRATOR_IS_STOCHASTIC 2u      // samples one light and one ray at each hit; the others sample every light
#define INTEGRATOR_MIRRORS_HIGHLIGHTS 4u // matte surfaces with a highlight also mirror, by Fresnel
#define INTEGRATOR_HAS_BOUNCES 8u        // the window offers bounces and caustics
#define INTEGRATOR_IS_AMBIENT 16u // shades with the light of bright surroundings that nearby surfaces do not block

// clang-format off
// The functions that shade a hit; integrators may share one. X(number, NAME, function)
//   number    counts from 0
//   NAME      its name in INTEGRATORS
//   function  of shaders/shade, called by shade_hit.glsl
#define SHADINGS(X) \
    X(0u, CLASSIC, shadeClassic) \
    X(1u, PATH, shadePath) \
    X(2u, NORMAL, shadeNormal) \
    X(3u, DEPTH, shadeDepth) \
    X(4u, AMBIENT, shadeAmbient)

// X(number, Name, word, label, SHADING, traits)
//   number   counts from 0
//   Name     Integrator::kName in C++ (runtime/scene/integrator.h)
//   word     name on the command line and in scene files
//   label    name in the window
//   SHADING  one of SHADINGS
//   traits   INTEGRATOR_* above
#define INTEGRATORS(X) \
    X(0u, Phong, "phong", "Direct light (phong)", CLASSIC, \
      INTEGRATOR_USES_LIGHTS) \
    X(1u, Whitted, "whitted", "With mirrors (whitted)", CLASSIC, \
      INTEGRATOR_USES_LIGHTS | INTEGRATOR_MIRRORS_HIGHLIGHTS | INTEGRATOR_HAS_BOUNCES) \
    X(2u, Path, "path", "Full light (path)", PATH, \
      INTEGRATOR_USES_LIGHTS | INTEGRATOR_IS_STOCHASTIC | INTEGRATOR_HAS_BOUNCES) \
    X(3u, Normal, "normal", "Normals", NORMAL, 0u) \
    X(4u, Depth, "depth", "Depth", DEPTH, 0u) \
    X(5u, Ambient, "ambient", "Without lamps (ambient)", AMBIENT, \
      INTEGRATOR_IS_STOCHASTIC | INTEGRATOR_IS_AMBIENT)
// clang-format on

// The traits of all integrators packed into one constant, so that a shader knows those of its integrator at compile
// time.
#define INTEGRATOR_BITS 5u
#define INTEGRATOR_TRAITS_OF_ROW(number, Name, word, label, SHADING, traits) | ((traits) << (INTEGRATOR_BITS * number))
#define INTEGRATOR_TRAITS (0u INTEGRATORS(INTEGRATOR_TRAITS_OF_ROW))
#define integratorHas(integrator, trait) ((INTEGRATOR_TRAITS >> (INTEGRATOR_BITS * (integrator)) & (trait)) != 0u)

#endif
