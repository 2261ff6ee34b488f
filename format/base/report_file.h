// SPDX-License-Identifier: Apache-2.0
// Writes reports to a file, standard output or a pipe.
#pragma once

#include <string>

namespace pointrt {

/// Writes text to path atomically, replacing an existing file; "-" is standard output. Writes to pipes and devices
/// directly. Throws Error kCannotWrite "PATH: reason".
void writeReport(const std::string& path, const std::string& text);

/// Throws as writeReport does if that is sure to fail. Call it before long work.
void requireReportWritable(const std::string& path);

} // namespace pointrt
