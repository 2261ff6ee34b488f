// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians of SPZ files, which glTF files may hold too.
#pragma once

#include "preprocess/input/gaussian/gaussians.h"
#include "preprocess/input/gaussian/spz_streams.h"

namespace pointrt {

/// The degree of the harmonics that are read, up to 3.
int spzDegree(const SpzFile& file);

/// index: below file.count
Gaussian spzGaussian(const SpzFile& file, std::size_t index);

} // namespace pointrt
