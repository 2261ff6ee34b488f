// SPDX-License-Identifier: Apache-2.0
// How much two pictures differ.
#pragma once

#include "tests/gaussians/float_picture.h"

namespace pointrt::test {

struct PictureDifference {
    double psnr_db = 0;        ///< over all channels, for a peak of 1; infinite if the pictures are equal
    double max_difference = 0; ///< of a channel
    double share_off = 0;      ///< of pixels with a channel that differs by more than 1/255
};

/// Display-encoded pictures of three channels. Values that are not finite differ by 1. Throws std::runtime_error if the
/// sizes differ.
PictureDifference differenceOf(const FloatPicture& a, const FloatPicture& b);

} // namespace pointrt::test
