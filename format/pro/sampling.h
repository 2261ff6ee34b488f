// SPDX-License-Identifier: Apache-2.0
// What NOIS says of a whole file.
#pragma once

#include "format/pro/header.h"

namespace pointrt::format {

/// The median of the splats' noise in input units, of an even number the upper one; 0 without NOIS. Needs view.splats.
float medianNoise(const pro_info& info, const Content& content);

} // namespace pointrt::format
