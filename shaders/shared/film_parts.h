// SPDX-License-Identifier: Apache-2.0
// The parts of a film, a row each: one list for the film's arrays, for files, the tracer, the window and the shader
// that shows them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_FILM_PARTS_H
#define POINTRT_SHADERS_FILM_PARTS_H

// Of a first hit's words (params.h), by number.
#define HIT_SPLAT 0u // or shape
#define HIT_OWNER 1u // in its low bits; above: 1 + the tile's number in its set, 0 of what is in none
#define HIT_MATERIAL 2u
#define HIT_TILE_SHIFT 8u
#define HIT_OWNER_MASK 0xFFu

// clang-format off
// X(array, Value, channels, group, nothing, source, view)
//   array     Film's member (runtime/image/film.h): pixel after pixel the values of its channels
//   Value     float or std::uint32_t
//   channels  in OpenEXR files: COLOR or VECTOR of a layer, or CHANNELS
//   group     what films have it: FilmGroup::GROUP (runtime/image/film_parts.h)
//   nothing   its value where nothing is hit
//   source    struct of runtime/render/film_readout.cpp that fills it
//   view      NOT_SHOWN, or SHOWN(number, NAME, label, how, function): one of the window's choices, counted from 0;
//             SHOWN_NAME and ShownAs::HOW to the code (runtime/image/film_views.h), function of
//             shaders/display/resolve.comp.glsl
//
// rgba         linear light, background included; share covered by the scene
// depth        along the centre ray from its start, input units
// normal       unit, towards the eye
// position     input coordinates
// direct       light that reached the first hit straight from a lamp
// indirect     light by way of other surfaces
// caustic      light that was bundled or bent on its way to a matte surface
// albedo       0 to 1: reflectance of the first hit
// splat_id     number in its .pro; none on shapes
// tile_id      number in its set of the tile whose .pro that is; none on what is in no set
// instance_id  number in the scene; OWNER_SHAPES on shapes
// material_id  row of the scene's table of materials
// samples      paths traced through the pixel
// variance     of the mean luminance
#define FILM_PARTS(X) \
    X(rgba, float, CHANNELS("R", "G", "B", "A"), kPicture, 0, Beauty, \
      SHOWN(0u, BEAUTY, "Picture", kLight, showBeauty)) \
    X(depth, float, CHANNELS("Z"), kFirstHits, INFINITY, Depth, \
      SHOWN(3u, DEPTH, "Depth", kNumber, showDepth)) \
    X(normal, float, VECTOR("N"), kFirstHits, 0, Normal, \
      SHOWN(2u, NORMAL, "Normals", kNumber, showNormal)) \
    X(position, float, VECTOR("P"), kFirstHits, 0, Position, NOT_SHOWN) \
    X(direct, float, COLOR("direct"), kLightParts, 0, Mean<LAYER_DIRECT>, \
      SHOWN(4u, DIRECT, "Direct light", kLight, showDirect)) \
    X(indirect, float, COLOR("indirect"), kLightParts, 0, Mean<LAYER_INDIRECT>, \
      SHOWN(5u, INDIRECT, "Indirect light", kLight, showIndirect)) \
    X(caustic, float, COLOR("caustic"), kLightParts, 0, Mean<LAYER_CAUSTIC>, \
      SHOWN(6u, CAUSTIC, "Caustics", kLight, showCaustic)) \
    X(albedo, float, COLOR("albedo"), kAlways, 0, Mean<LAYER_ALBEDO>, \
      SHOWN(1u, ALBEDO, "Colours only", kShare, showAlbedo)) \
    X(splat_id, std::uint32_t, CHANNELS("id.splat"), kFirstHits, NO_INDEX, SplatId, NOT_SHOWN) \
    X(tile_id, std::uint32_t, CHANNELS("id.tile"), kFirstHits, NO_INDEX, TileId, NOT_SHOWN) \
    X(instance_id, std::uint32_t, CHANNELS("id.instance"), kFirstHits, NO_INDEX, OwnerId, NOT_SHOWN) \
    X(material_id, std::uint32_t, CHANNELS("id.material"), kFirstHits, NO_INDEX, HitWord<HIT_MATERIAL>, \
      SHOWN(8u, MATERIAL, "Materials", kNumber, showMaterial)) \
    X(samples, float, CHANNELS("samples"), kAlways, 0, Samples, NOT_SHOWN) \
    X(variance, float, CHANNELS("variance"), kAlways, 0, Variance, \
      SHOWN(7u, NOISE, "Noise", kNumber, showNoise))
// clang-format on

#endif
