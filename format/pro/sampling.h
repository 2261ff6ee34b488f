// SPDX-License-Identifier: Apache-2.0
// The median of NOIS.
#pragma once

#include "format/pro/sections.h"

namespace pointrt::format {

/// The median noise of the splats in input units, the upper one for an even number; 0 without NOIS. Needs view.splats.
float medianNoise(const pro_info& info, const Content& content);

} // namespace pointrt::format
