// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/command_table.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "runtime/rays/common_options.h"

namespace pointrt {

namespace {

/// Two columns.
std::string listLines(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::size_t widest = 0;
    for (const auto& [name, purpose] : rows) widest = std::max(widest, name.size());
    std::string text;
    for (const auto& [name, purpose] : rows)
        text += "  " + name + std::string(widest + 2 - name.size(), ' ') + purpose + "\n";
    return text;
}

} // namespace

CommandText toolText(std::span<const RayCommand> commands, const std::string& version) {
    CommandLine app("Asks scans what rays meet.", "pointrt-rays");
    addCommonOptions(app, version, kWrongInput, "");
    CommandText tool = describe(app);
    for (const RayCommand& command : commands) {
        tool.commands.push_back(command.text());
        tool.commands.back().purpose = command.purpose;
    }
    return tool;
}

std::string toolHelp(const CommandText& tool) {
    std::vector<std::pair<std::string, std::string>> commands, options;
    for (const CommandText& each : tool.commands) commands.emplace_back(lastWord(each.name), each.purpose);
    for (const OptionText& each : tool.options)
        options.emplace_back((each.short_name.empty() ? "" : each.short_name + ",") + each.long_name +
                                 (each.takesValue() ? " " + each.value.placeholder : ""),
                             each.help);
    return tool.about + "\nUsage: pointrt-rays COMMAND ...\n\nCommands:\n" + listLines(commands) + "\nOptions:\n" +
           listLines(options) + "\npointrt-rays COMMAND --help tells more of each.\n";
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
