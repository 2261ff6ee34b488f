// SPDX-License-Identifier: Apache-2.0
// Progressive photon mapping: the samples of a picture use a sequence of photon maps with ever narrower discs, so that
// their mean converges (Hachisuka, Ogaki and Jensen, Progressive Photon Mapping, 2008; Knaus and Zwicker, Progressive
// Photon Mapping: A Probabilistic Approach, 2011). A sample's map depends only on its number and the picture's
// size, so resumed films equal films rendered without interruption.
#pragma once

#include <cstdint>

namespace pointrt {

/// Number of the map that a sample uses, in a picture of this many pixels.
std::uint32_t mapOfSample(std::uint32_t sample, std::uint64_t pixels);

/// Radius of the discs of a map relative to those of the first map.
double discShrink(std::uint32_t map);

} // namespace pointrt
