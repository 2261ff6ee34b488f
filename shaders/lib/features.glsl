// SPDX-License-Identifier: Apache-2.0
// What the scene has, known when programs are built: code for what it has not is left out. On lavapipe no branch skips
// code, so that what is there costs time whether it is met or not.
#ifndef POINTRT_SHADERS_FEATURES_GLSL
#define POINTRT_SHADERS_FEATURES_GLSL
#include "shaders/shared/integrators.h"
#include "shaders/shared/params.h"
#include "shaders/shared/spec_constants.h"

layout(constant_id = SPEC_INTEGRATOR) const uint kIntegrator = 0u; // number of one of INTEGRATORS
// FEATURE_* bits
layout(constant_id = SPEC_FEATURES) const uint kFeatures = 0xFFFFFFFFu;

// Kinds of the scene's shapes, where it has no more than HELD_SHAPES.
layout(constant_id = SPEC_SHAPE_KINDS) const uint kShapeKinds = 0u;
const uint kShapeCountMask = (1u << SHAPE_COUNT_BITS) - 1u;
const bool kHoldsShapes = (kShapeKinds & kShapeCountMask) != 0u;
const uint kHeldShapes = (kShapeKinds & kShapeCountMask) - 1u; // how many it has
#define kHoldsShapes kHoldsShapes // known to shapes.glsl

// Whether the lanes are the pixels and their rays the camera's; else they are those of the queue. Each has programs of
// its own.
layout(constant_id = SPEC_CAMERA_PASS) const bool kCameraPass = false;

// Whether points gather photons where they ask for light. In the queued form a program of its own does.
layout(constant_id = SPEC_GATHERS_PHOTONS) const bool kGathersPhotons = false;

#define mayHaveLight(kind) ((kFeatures & FEATURE_LIGHT(kind)) != 0u)
const bool kHasNoise = (kFeatures & FEATURE_NOISE) != 0u;
#define mayHaveMaterial(kind) ((kFeatures & FEATURE_MATERIAL(kind)) != 0u)
#define ROUGH(number, NAME, Name, word, label, lobes, traits)                                                          \
    | (((traits) & MATERIAL_IS_ROUGH) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool mayBeRough = (kFeatures & (0u MATERIALS(ROUGH))) != 0u;
#define mayBeRough mayBeRough // known to material.glsl
#define REFRACTS(number, NAME, Name, word, label, lobes, traits)                                                       \
    | (((traits) & MATERIAL_REFRACTS) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool mayRefract = (kFeatures & (0u MATERIALS(REFRACTS))) != 0u;
const bool mayHaveHighlight = (kFeatures & FEATURE_HIGHLIGHTS) != 0u;
#define mayHaveHighlight mayHaveHighlight // likewise
#define mayHaveShape(kind) ((kFeatures & FEATURE_SHAPE(kind)) != 0u)
#define mayGoOn() ((kFeatures & FEATURE_GOES_ON) != 0u)
const bool kLightOnTheWay = (kFeatures & FEATURE_LIGHT_ON_THE_WAY) != 0u;

#endif
