// SPDX-License-Identifier: Apache-2.0
// A command line as plain data: --help, manual pages and shell completions are generated from it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The values that an option takes.
struct ValueText {
    std::string placeholder;        ///< as --help shows it: "FILE", "auto|off|STRENGTH"; empty for a switch
    std::vector<std::string> words; ///< literal values; a placeholder with capitals allows others too
    bool is_file = false;
    std::vector<std::string> suffixes; ///< suffixes of the files to complete, with their dots; empty: all files
};

/// An option, or the positional argument, which has no names.
struct OptionText {
    std::string short_name, long_name; ///< with their dashes
    std::string heading, help;
    ValueText value;
    bool required = false;
    bool repeats = false; ///< can be given several times, or takes several values

    bool takesValue() const { return !value.placeholder.empty(); }
};

struct CommandText {
    std::string name;    ///< "pointrt-bake", "pointrt-rays cast"
    std::string purpose; ///< one line without an initial capital or a full stop
    std::string about;   ///< sentences, one or more lines
    std::string version;
    OptionText input;                ///< the positional argument; an empty placeholder if the command takes none
    std::vector<OptionText> options; ///< in the order of --help, grouped by heading
    std::string examples;    ///< lines: "  COMMAND", or "  COMMAND   DESCRIPTION" with three spaces or more between
    std::string notes;       ///< paragraphs, separated by empty lines; other line breaks do not count
    std::string wrong_input; ///< the meaning of exit code 1: "a scan is malformed"
    std::vector<CommandText> commands; ///< subcommands
};

/// The text of --help, at most 80 columns wide unless a single word is wider.
std::string helpText(const CommandText& command);

/// The outputs of --generate.
std::string manualPage(const CommandText& command);
std::string bashCompletion(const CommandText& command);
std::string zshCompletion(const CommandText& command);
std::string fishCompletion(const CommandText& command);

/// How --help and manual pages mark up words to type and placeholders for them.
struct SynopsisStyle {
    std::string (*literal)(std::string_view text);
    std::string (*placeholder)(std::string_view text);
};
/// "pointrt-bake [OPTION]... SCAN... -o FILE".
std::string synopsis(const CommandText& command, const SynopsisStyle& style);

/// The help of an option, with "(required)" where it is.
std::string optionHelp(const OptionText& option);
/// The start of an option's help for completion lists: up to the first comment, at most 60 characters.
std::string shortHelp(const OptionText& option);
/// The meanings of exit codes 0, 1, 2 ...
std::vector<std::string> exitMeanings(const CommandText& command);

/// name as an identifier of a shell function: "pointrt_rays_cast".
std::string functionName(std::string_view name);
/// "cast" of "pointrt-rays cast".
std::string_view lastWord(std::string_view name);
std::string joinedWords(const std::vector<std::string>& words, std::string_view separator);
/// text with a backslash before each of these characters.
std::string escaped(std::string_view text, std::string_view characters);
/// text in single quotes for a shell.
/// @param quote replaces each single quote within text: '\'' for POSIX shells, \' for fish
std::string inShellQuotes(std::string_view text, std::string_view quote);

} // namespace pointrt
