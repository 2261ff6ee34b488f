// SPDX-License-Identifier: Apache-2.0
// The commands of pointrt-rays by their names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pointrt {

struct RayCommand {
    std::string_view name;
    std::string_view purpose; ///< for --help, a few words
    /// The words from the command's name on; returns the exit code or throws Error.
    int (*run)(int argc, const char* const* argv);
};

/// What pointrt-rays --help prints, where no command is named.
std::string commandHelp(std::span<const RayCommand> commands);

/// Throws Error kBadUsage with the names that there are.
const RayCommand& commandNamed(std::span<const RayCommand> commands, std::string_view name);

} // namespace pointrt
