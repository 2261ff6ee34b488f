// SPDX-License-Identifier: Apache-2.0
// The parts (AOVs) of a film, one row each: the single list behind the film's arrays, OpenEXR channels, the renderer,
// the window's views and the shader that shows them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_FILM_PARTS_H
#define POINTRT_SHADERS_FILM_PARTS_H

// The words of a first hit (params.h), by index.
#define HIT_SPLAT 0u // or shape
#define HIT_OWNER 1u // low bits: the owner; higher bits: 1 + number of the tile in its set, 0 outside sets
#define HIT_MATERIAL 2u
#define HIT_TILE_SHIFT 8u
#define HIT_OWNER_MASK 0xFFu

// clang-format off
// X(array, Value, channels, group, nothing, source, view)
//   array     member of Film (runtime/image/film.h): the values of its channels, pixel by pixel
//   Value     float or std::uint32_t
//   channels  of OpenEXR files: COLOR or VECTOR of a layer, or CHANNELS
//   group     which films have it: FilmGroup::GROUP (runtime/image/film_parts.h)
//   nothing   value where no surface is hit
//   source    struct of runtime/render/film_readout.cpp that computes it
//   view      NOT_SHOWN, or SHOWN(number, NAME, label, how, function): a view of the window, numbered from 0; the code
//             knows it as SHOWN_NAME and ShownAs::HOW (runtime/image/film_views.h) and draws it with that function of
//             shaders/display/resolve.comp.glsl
//
// rgba         linear radiance with the background; coverage by the scene; for Gaussians without a hit behind, their
// opacity
// depth        distance along the centre ray from its origin, input units; of Gaussians, to where half of the light is
//              hidden
// normal       unit vector, facing the eye; of Gaussians, the shortest axis
// position     input coordinates
// direct       light that reached the first hit straight from a light source
// indirect     light that reached it by way of other surfaces
// caustic      light focused by mirrors or glass onto a surface that scatters it
// albedo       reflectance of the first hit, 0 to 1
// splat_id     index in its .pro; none on shapes; of Gaussians, that of the one that adds most up to the depth
// tile_id      index of the splat's tile in its set; none outside sets
// instance_id  index in the scene; OWNER_SHAPES on shapes
// material_id  row of the scene's material table
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
