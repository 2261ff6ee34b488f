// SPDX-License-Identifier: GPL-3.0-or-later
// The whole road from scan files to a .pro.
#pragma once

#include "preprocess/app/options.h"
#include "preprocess/app/report.h"

namespace pointrt {

/// Reads, estimates, builds, prunes and writes options.output. Throws Error; nothing half-written is left.
BakeReport bake(const BakeOptions& options);

} // namespace pointrt
