// SPDX-License-Identifier: GPL-3.0-or-later
// Bakes scan files to a .pro.
#pragma once

#include "preprocess/app/options.h"
#include "preprocess/app/report.h"

namespace pointrt {

/// Runs all stages and writes options.output atomically. Throws Error.
BakeReport bake(const BakeOptions& options);

} // namespace pointrt
