// SPDX-License-Identifier: Apache-2.0
// What the command lines of all tools have in common: --help, --version, --generate, and what is said of a slip. For
// the one file of a tool that knows CLI11.
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

/// CLI11's, and what that has no place for.
struct CommandLine : CLI::App {
    using CLI::App::App;
    std::map<const CLI::Option*, std::string> candidates; ///< see completes
    std::string examples, notes, wrong_input;             ///< as CommandText has them
};

/// Files that people write without the option they belong to: {".png", "-o"}.
using OutputSuffixes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// What shells offer as values of the option of this name where its placeholder does not tell: words, or suffixes of
/// files with their dots, blanks between them. A placeholder with bars, as on|off, tells words, FILE and FOLDER files.
void completes(CommandLine& app, const std::string& option, const std::string& candidates);

/// Gives --help its end, and adds --version, --generate and --help themselves.
/// @param wrong_input what exit code 1 says: "a scan is wrong"
/// @param examples lines of two columns or one, each begun with the tool's name
void addCommonOptions(CommandLine& app, const std::string& version, const std::string& wrong_input,
                      const std::string& examples, const std::string& notes = "");

/// What --help says, as data. To be called when all options are there.
CommandText describe(const CommandLine& app);

/// What --generate prints, which is "man" or the name of a shell. Throws Error kBadUsage for others; of a command of a
/// tool there is the manual page alone.
std::string generatedText(const CommandText& command, const std::string& what);

/// Parses the command line. Returns an exit code where the run ends here: --help, --version and --generate, whose text
/// goes to standard output. Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseCommandLine(CommandLine& app, int argc, const char* const* argv, OutputSuffixes outputs = {});

} // namespace pointrt
