// SPDX-License-Identifier: Apache-2.0
// The command line features that all tools share: --help, --version, --generate, and error lines for mistakes. Each
// tool includes this, and with it CLI11, only where it defines its options.
#pragma once

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "format/cli/command_text.h"

namespace pointrt {

/// CLI::App with the texts that CLI11 has no place for.
struct CommandLine : CLI::App {
    using CLI::App::App;
    std::map<const CLI::Option*, std::string> candidates; ///< see completes()
    std::string examples, notes, wrong_input;             ///< see CommandText
};

/// Suffixes of output files, with the option to suggest when such a file is given without one: {".png", "-o"}.
using OutputSuffixes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// Sets the values that shells complete for an option if its placeholder does not imply them: words, or suffixes of
/// files with their dots, separated by spaces. Placeholders with bars such as on|off imply words, FILE and FOLDER imply
/// files.
void completes(CommandLine& app, const std::string& option, const std::string& candidates);

/// Adds --version, --generate and --help, and the texts that end the help.
/// @param wrong_input when exit code 1 is returned: "a scan is malformed"
/// @param examples,notes see CommandText
void addCommonOptions(CommandLine& app, const std::string& version, const std::string& wrong_input,
                      const std::string& examples, const std::string& notes = "");

/// The command line as data. Call it after all options have been added.
CommandText describe(const CommandLine& app);

/// The output of --generate for "man" or the name of a shell; subcommands have a manual page only. Throws Error
/// kBadUsage for other words.
std::string generatedText(const CommandText& command, const std::string& what);

/// Parses the command line. Returns an exit code if the run ends here, after --help, --version or --generate has
/// printed its text to standard output. Throws Error kBadUsage with one line for mistakes.
std::optional<int> parseCommandLine(CommandLine& app, int argc, const char* const* argv, OutputSuffixes outputs = {});

} // namespace pointrt
