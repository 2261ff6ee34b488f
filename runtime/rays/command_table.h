// SPDX-License-Identifier: Apache-2.0
// The commands of pointrt-rays, by name.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/cli/command_text.h"

namespace pointrt {

struct RayCommand {
    std::string_view name;
    std::string_view purpose; ///< one line for --help
    /// argv starts with the command's name. Returns the exit code or throws Error.
    int (*run)(int argc, const char* const* argv);
    CommandText (*text)(); ///< of its --help
};

/// The text of pointrt-rays --help, as data.
CommandText toolText(std::span<const RayCommand> commands, const std::string& version);

/// Throws Error kBadUsage with the list of commands if there is no such command.
const RayCommand& commandNamed(std::span<const RayCommand> commands, std::string_view name);

} // namespace pointrt
