// SPDX-License-Identifier: Apache-2.0
// The commands of pointrt-rays by their names.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/cli/command_text.h"

namespace pointrt {

struct RayCommand {
    std::string_view name;
    std::string_view purpose; ///< for --help, a few words
    /// The words from the command's name on; returns the exit code or throws Error.
    int (*run)(int argc, const char* const* argv);
    CommandText (*text)(); ///< what its --help says
};

/// pointrt-rays with all of its commands.
CommandText toolText(std::span<const RayCommand> commands, const std::string& version);

/// What pointrt-rays --help prints, where no command is named.
std::string toolHelp(const CommandText& tool);

/// Throws Error kBadUsage with the names that there are.
const RayCommand& commandNamed(std::span<const RayCommand> commands, std::string_view name);

} // namespace pointrt
