// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/command/command_table.h"

#include <algorithm>

#include "format/base/error.h"

namespace pointrt {

std::string commandHelp(std::span<const RayCommand> commands) {
    std::string text = "Asks scans what rays meet.\nUsage: pointrt-rays COMMAND ...\n\nCommands:\n";
    std::size_t widest = 0;
    for (const RayCommand& command : commands) widest = std::max(widest, command.name.size());
    for (const RayCommand& command : commands)
        text += "  " + std::string(command.name) + std::string(widest + 2 - command.name.size(), ' ') +
                std::string(command.purpose) + "\n";
    return text + "\npointrt-rays COMMAND --help tells more of each. --version prints the version.\n";
}

const RayCommand& commandNamed(std::span<const RayCommand> commands, std::string_view name) {
    std::string there;
    for (const RayCommand& command : commands) {
        if (command.name == name) return command;
        there += (there.empty() ? "" : ", ") + std::string(command.name);
    }
    throw Error(ExitCode::kBadUsage, name.empty() ? "a command is missing: " + there
                                                  : std::string(name) + ": no command; there is " + there);
}

} // namespace pointrt
