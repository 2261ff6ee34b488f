// SPDX-License-Identifier: Apache-2.0
// Features of the scene as specialization constants: programs leave out code for absent features. On lavapipe, branches
// skip no code, so code costs time even where it does not apply.
#ifndef POINTRT_SHADERS_FEATURES_GLSL
#define POINTRT_SHADERS_FEATURES_GLSL
#include "shaders/shared/integrators.h"
#include "shaders/shared/params.h"
#include "shaders/shared/spec_constants.h"

layout(constant_id = SPEC_INTEGRATOR) const uint kIntegrator = 0u; // number in INTEGRATORS
// FEATURE_* bits
layout(constant_id = SPEC_FEATURES) const uint kFeatures = 0xFFFFFFFFu;

// Kinds of the scene's shapes, if there are at most HELD_SHAPES.
layout(constant_id = SPEC_SHAPE_KINDS) const uint kShapeKinds = 0u;
const uint kShapeCountMask = (1u << SHAPE_COUNT_BITS) - 1u;
const bool kHoldsShapes = (kShapeKinds & kShapeCountMask) != 0u;
const uint kHeldShapes = (kShapeKinds & kShapeCountMask) - 1u; // number of them
#define kHoldsShapes kHoldsShapes // tested by shapes.glsl

// The camera pass has a lane per pixel, with camera rays; other passes have a lane per path of the ray queue. Each has
// its own programs. CAMERA: a program for the camera pass only, without the queues that other passes read and write.
#ifdef CAMERA
const bool kCameraPass = true;
#else
layout(constant_id = SPEC_CAMERA_PASS) const bool kCameraPass = false;
#endif

// Whether the megakernel gathers photons. In the wavefront form, the program caustic gathers them.
layout(constant_id = SPEC_GATHERS_PHOTONS) const bool kGathersPhotons = false;

// Whether each dispatch of the megakernel traces a single bounce. Without the loop, GPUs have registers for more paths
// at once, and their lanes do not wait for the longest path.
layout(constant_id = SPEC_ONE_BOUNCE) const bool kOneBounce = false;

#define mayHaveLight(kind) ((kFeatures & FEATURE_LIGHT(kind)) != 0u)
const bool kHasGaussians = (kFeatures & FEATURE_GAUSSIANS) != 0u;
const bool kRelights = (kFeatures & FEATURE_RELIGHT) != 0u;
const bool kHasNoise = (kFeatures & FEATURE_NOISE) != 0u;
#define mayHaveMaterial(kind) ((kFeatures & FEATURE_MATERIAL(kind)) != 0u)
#define ROUGH(number, NAME, Name, word, label, lobes, traits)                                                          \
    | (((traits) & MATERIAL_IS_ROUGH) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool mayBeRough = (kFeatures & (0u MATERIALS(ROUGH))) != 0u;
#define mayBeRough mayBeRough // tested by material.glsl
#define REFRACTS(number, NAME, Name, word, label, lobes, traits)                                                       \
    | (((traits) & MATERIAL_REFRACTS) != 0u ? FEATURE_MATERIAL(number) : 0u)
const bool mayRefract = (kFeatures & (0u MATERIALS(REFRACTS))) != 0u;
const bool mayHaveHighlight = (kFeatures & FEATURE_HIGHLIGHTS) != 0u;
#define mayHaveHighlight mayHaveHighlight // tested by material.glsl
#define mayHaveShape(kind) ((kFeatures & FEATURE_SHAPE(kind)) != 0u)
#define mayHaveSecondaryRays() ((kFeatures & FEATURE_SECONDARY_RAYS) != 0u)
const bool kInlineNee = (kFeatures & FEATURE_INLINE_NEE) != 0u;

#endif
