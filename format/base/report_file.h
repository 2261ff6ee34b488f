// SPDX-License-Identifier: Apache-2.0
// Where reports for programs go: a file, standard output, a pipe.
#pragma once

#include <string>

namespace pointrt {

/// Writes text to path, whole or not at all, replacing what is there; "-" is standard output. Pipes and devices are
/// written to as they are. Throws Error kCannotWrite "PATH: reason".
void writeReport(const std::string& path, const std::string& text);

/// Throws as writeReport does where that is sure to fail. To be asked before long work.
void requireReportWritable(const std::string& path);

} // namespace pointrt
