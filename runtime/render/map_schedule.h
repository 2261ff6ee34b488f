// SPDX-License-Identifier: Apache-2.0
// Progressive photon mapping: a picture's samples show one photon map after another, of ever narrower discs, so that
// their mean converges (Hachisuka, Ogaki and Jensen, Progressive Photon Mapping, 2008; Knaus and Zwicker, Progressive
// Photon Mapping: A Probabilistic Approach, 2011). All of it hangs on a sample's number alone: films that are gone on
// with show what they would have shown in one go.
#pragma once

#include <cstdint>

namespace pointrt {

/// The number of the map that a sample shows, in a picture of so many pixels.
std::uint32_t mapOfSample(std::uint32_t sample, std::uint64_t pixels);

/// How wide that map's discs are, in widths of the first one's.
double discShrink(std::uint32_t map);

} // namespace pointrt
