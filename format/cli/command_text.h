// SPDX-License-Identifier: Apache-2.0
// A command line as text: what --help says of it, as plain data that manual pages and completions are made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// What an option's value can be.
struct ValueText {
    std::string placeholder;        ///< as --help has it: "FILE", "auto|off|STRENGTH"; empty for a switch
    std::vector<std::string> words; ///< that it can be; where the placeholder has capitals, other values as well
    bool is_file = false;
    std::vector<std::string> suffixes; ///< of files that fit, with their dots; empty: all files do
};

/// An option, or what stands without one, which has no names.
struct OptionText {
    std::string short_name, long_name; ///< with their dashes
    std::string heading, help;
    ValueText value;
    bool required = false;
    bool repeats = false; ///< or several values, one after the other

    bool takesValue() const { return !value.placeholder.empty(); }
};

struct CommandText {
    std::string name;    ///< "pointrt-bake", "pointrt-rays cast"
    std::string purpose; ///< one line, begun in lower case, with no full stop
    std::string about;   ///< sentences
    std::string version;
    OptionText input;                ///< its placeholder is empty where there is none
    std::vector<OptionText> options; ///< in the order of --help, those of one heading together
    std::string examples;            ///< lines
    std::string notes;               ///< sentences; a line is a line of --help
    std::string wrong_input;         ///< what exit code 1 says: "a scan is wrong"
    std::vector<CommandText> commands;
};

/// What people ask --generate for.
std::string manualPage(const CommandText& command);
std::string bashCompletion(const CommandText& command);
std::string zshCompletion(const CommandText& command);
std::string fishCompletion(const CommandText& command);

/// The beginning of an option's help, which stands in a line of a list: as far as a comment, 60 characters at most.
std::string shortHelp(const OptionText& option);
/// name as shells take names of functions: "pointrt_rays_cast".
std::string functionName(std::string_view name);
/// "cast" of "pointrt-rays cast".
std::string_view lastWord(std::string_view name);
std::string joinedWords(const std::vector<std::string>& words, std::string_view separator);
/// text with each of these characters behind a backslash.
std::string escaped(std::string_view text, std::string_view characters);
/// For a shell: in single quotes, those of its own written as close.
/// @param quote what stands for a quote within: '\'' for POSIX shells, \' for fish
std::string inShellQuotes(std::string_view text, std::string_view quote);

} // namespace pointrt
