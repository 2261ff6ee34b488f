// SPDX-License-Identifier: Apache-2.0
// Numbers as text with a fixed number of decimals, and round numbers.
#pragma once

#include <string>

namespace pointrt {

/// value: finite.
std::string decimalText(double value, int decimals);

/// Decimals that resolve this step, 0 to 9; 3 for a step that is not above 0.
int decimalsOf(double step);

/// The largest of 1, 2, 5, 10, 20 ... (and of 0.5, 0.2 ...) that is not above limit. limit: above 0.
double roundBelow(double limit);
/// The smallest such number that is not below limit.
double roundAbove(double limit);

} // namespace pointrt
