// SPDX-License-Identifier: Apache-2.0
#include "format/cli/command_text.h"

namespace pointrt {
namespace {

std::string quoted(const std::string& text) { return inShellQuotes(escaped(text, "\\"), "\\'"); }

/// The argument of -a: files with these suffixes, and folders.
std::string fileCandidates(const ValueText& value, const std::string& tool) {
    return "(__" + tool + "_files " + joinedWords(value.suffixes, " ") + ")";
}

/// The flags that describe the values of an option.
std::string valueFlags(const ValueText& value, const std::string& tool) {
    if (value.is_file) return value.suffixes.empty() ? " -r -F" : " -x -a " + quoted(fileCandidates(value, tool));
    return value.words.empty() ? " -x" : " -x -a " + quoted(joinedWords(value.words, " "));
}

/// @param start "complete -c TOOL", and its condition
std::string optionLine(const OptionText& option, const std::string& tool, const std::string& start) {
    return start + (option.short_name.empty() ? "" : " -s " + option.short_name.substr(1)) + " -l " +
           option.long_name.substr(2) + (option.takesValue() ? valueFlags(option.value, tool) : "") + " -d " +
           quoted(shortHelp(option)) + "\n";
}

std::string commandLines(const CommandText& command, const std::string& tool, const std::string& start) {
    std::string text;
    for (const OptionText& option : command.options) text += optionLine(option, tool, start);
    if (!command.input.value.placeholder.empty())
        text += start + " -a " + quoted(fileCandidates(command.input.value, tool)) + "\n";
    return text;
}

/// @ is replaced by the tool's name. --option=VALUE is one word.
constexpr const char* kFiles = R"(
function __@_files
    set -l word (string replace -r '^--[^=]*=' '' -- (commandline -ct))
    set -l endings /
    for suffix in $argv
        set -a endings (string escape --style=regex -- $suffix)
    end
    complete -C "'' $word" | string match -ir '^[^\t]*(?:'(string join '|' $endings)')(?:\t.*)?$'
end
)";

std::string filesFunction(std::string text, const std::string& tool) {
    const std::size_t at = text.find('@');
    return text.replace(at, 1, tool);
}

} // namespace

std::string fishCompletion(const CommandText& command) {
    const std::string tool = functionName(command.name), start = "complete -c " + command.name;
    std::string text = "# fish completion of " + command.name + ", made by " + command.name + " --generate fish" +
                       filesFunction(kFiles, tool) + start + " -f\n";
    if (command.commands.empty()) return text + commandLines(command, tool, start);
    text += commandLines(command, tool, start + " -n __fish_use_subcommand");
    for (const CommandText& each : command.commands) {
        const std::string name(lastWord(each.name));
        text += start + " -n __fish_use_subcommand -a " + name + " -d " + quoted(each.purpose) + "\n" +
                commandLines(each, tool, start + " -n " + quoted("__fish_seen_subcommand_from " + name));
    }
    return text;
}

} // namespace pointrt
