// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "format/index/build_index.h"
#include "preprocess/octree/write.h"

namespace pointrt {

/// The tracing index of a file's sections. If the index cannot be built, throws Error with "NAME: reason; REMEDY".
TracingIndex fileIndex(const ProSections& sections, const IndexOptions& options, const std::string& name,
                       std::string_view remedy);

} // namespace pointrt
