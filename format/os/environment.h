// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// The value of a variable of the environment; empty if it is not set.
std::string environmentVariable(const char* name);

} // namespace pointrt
