// SPDX-License-Identifier: GPL-3.0-or-later
// What must not be written over.
#pragma once

#include <string>

#include "preprocess/app/options.h"

namespace pointrt {

/// Throws Error (kBadUsage) where path, which the option names, is an input.
void requireNoInput(const BakeOptions& options, const std::string& path, const char* option);

/// The report must not land on a scan or on the scene. Throws Error.
void checkStats(const BakeOptions& options);

} // namespace pointrt
