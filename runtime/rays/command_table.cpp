// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/command_table.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "runtime/rays/common_options.h"

namespace pointrt {

CommandText toolText(std::span<const RayCommand> commands, const std::string& version) {
    CommandLine app("Casts rays at point scans.", "pointrt-rays");
    addCommonOptions(app, version, kWrongInput, "");
    CommandText tool = describe(app);
    for (const RayCommand& command : commands) {
        tool.commands.push_back(command.text());
        tool.commands.back().purpose = command.purpose;
    }
    return tool;
}

const RayCommand& commandNamed(std::span<const RayCommand> commands, std::string_view name) {
    std::string names;
    for (const RayCommand& command : commands) {
        if (command.name == name) return command;
        names += (names.empty() ? "" : ", ") + std::string(command.name);
    }
    throw Error(ExitCode::kBadUsage, name.empty() ? "a command is required: " + names
                                                  : std::string(name) + ": unknown command; commands: " + names);
}

} // namespace pointrt
