// SPDX-License-Identifier: Apache-2.0
// Metadata by which viewers recognise a panorama.
#pragma once

#include <string>

#include "runtime/util/pixel_size.h"

namespace pointrt {

/// An XMP packet with Google's GPano properties (https://developers.google.com/streetview/spherical-metadata) for an
/// equirectangular picture of this size that covers the whole sphere.
std::string panoramaXmp(PixelSize size);

} // namespace pointrt
