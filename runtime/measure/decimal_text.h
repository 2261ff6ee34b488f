// SPDX-License-Identifier: Apache-2.0
// Numbers as text with a fixed number of decimals.
#pragma once

#include <string>

namespace pointrt {

/// value: finite.
std::string decimalText(double value, int decimals);

/// Decimals that resolve this step, 0 to 9; 3 for a step that is not above 0.
int decimalsOf(double step);

} // namespace pointrt
