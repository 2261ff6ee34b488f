// SPDX-License-Identifier: Apache-2.0
// The points of .pro files with all of their attributes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/rays/study/point_source.h"

namespace pointrt {

/// File by file, each in the order of its input; those that fill gaps are left out. Columns are those that all files
/// have, and of several files instance_id, the number of a point's file. Throws Error kBadInput for what is no .pro.
std::unique_ptr<PointSource> scenePoints(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& left_out);

} // namespace pointrt
