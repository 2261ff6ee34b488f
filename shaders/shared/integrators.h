// SPDX-License-Identifier: Apache-2.0
// The integrators, a row each: what command line, scene files, window, host and shaders know of them. Valid in C++ and
// GLSL.
#ifndef POINTRT_SHADERS_INTEGRATORS_H
#define POINTRT_SHADERS_INTEGRATORS_H

// What sets integrators apart.
#define INTEGRATOR_SHOWS_LIGHT 1u // the others show surfaces as they are, whatever lights them
#define INTEGRATOR_BY_CHANCE 2u   // at each hit one light and one ray, drawn by chance; the others ask all lights
#define INTEGRATOR_GLOSSES_HIGHLIGHTS 4u // matte surfaces with a highlight mirror by Fresnel
#define INTEGRATOR_OFFERS_BOUNCES 8u     // the window lets bounces and caustics be chosen

// clang-format off
// The functions that shade a hit, which integrators may share. X(number, NAME, function)
//   number    counts from 0
//   NAME      what the integrators' rows call it
//   function  of shaders/shade; shade_hit.glsl calls it
#define SHADINGS(X) \
    X(0u, CLASSIC, shadeClassic) \
    X(1u, PATH, shadePath) \
    X(2u, NORMAL, shadeNormal) \
    X(3u, DEPTH, shadeDepth)

// X(number, Name, word, label, SHADING, traits)
//   number   counts from 0
//   Name     Integrator::kName in C++ (runtime/scene/integrator.h)
//   word     what the command line and scene files call it
//   label    what the window calls it
//   SHADING  one of SHADINGS
//   traits   INTEGRATOR_* above
#define INTEGRATORS(X) \
    X(0u, Phong, "phong", "Direct light (phong)", CLASSIC, \
      INTEGRATOR_SHOWS_LIGHT) \
    X(1u, Whitted, "whitted", "With mirrors (whitted)", CLASSIC, \
      INTEGRATOR_SHOWS_LIGHT | INTEGRATOR_GLOSSES_HIGHLIGHTS | INTEGRATOR_OFFERS_BOUNCES) \
    X(2u, Path, "path", "Full light (path)", PATH, \
      INTEGRATOR_SHOWS_LIGHT | INTEGRATOR_BY_CHANCE | INTEGRATOR_OFFERS_BOUNCES) \
    X(3u, Normal, "normal", "Normals", NORMAL, 0u) \
    X(4u, Depth, "depth", "Depth", DEPTH, 0u)
// clang-format on

// Traits of all of them in one number, so that a shader knows those of its integrator when it is built.
#define INTEGRATOR_BITS 4u
#define INTEGRATOR_TRAITS_OF_ROW(number, Name, word, label, SHADING, traits) | ((traits) << (INTEGRATOR_BITS * number))
#define INTEGRATOR_TRAITS (0u INTEGRATORS(INTEGRATOR_TRAITS_OF_ROW))
#define integratorHas(integrator, trait) ((INTEGRATOR_TRAITS >> (INTEGRATOR_BITS * (integrator)) & (trait)) != 0u)

#endif
