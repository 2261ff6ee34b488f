// SPDX-License-Identifier: Apache-2.0
#include "format/cli/command_text.h"

namespace pointrt {
namespace {

/// ".laz" as a pattern in either case: "*.[lL][aA][zZ]".
std::string suffixPattern(const std::string& suffix) {
    std::string pattern = "*";
    for (const char c : suffix) {
        const bool letter = c >= 'a' && c <= 'z';
        pattern += letter ? std::string{'[', c, static_cast<char>(c - 'a' + 'A'), ']'} : std::string(1, c);
    }
    return pattern;
}

/// A command that adds the candidates for a value to COMPREPLY.
std::string candidates(const ValueText& value, const std::string& tool) {
    std::string text;
    if (!value.words.empty()) text += "_" + tool + "_words " + inShellQuotes(joinedWords(value.words, " "), "'\\''");
    if (!value.is_file) return text.empty() ? ":" : text;
    text += (text.empty() ? "_" : "; _") + tool + "_files";
    if (value.suffixes.empty()) return text + " '*'";
    for (const std::string& suffix : value.suffixes) text += " '" + suffixPattern(suffix) + "'";
    return text;
}

std::string longNames(const CommandText& command) {
    std::string names;
    for (const OptionText& option : command.options) names += (names.empty() ? "" : " ") + option.long_name;
    return names;
}

/// A function that completes the words after the name of a command.
std::string function(const CommandText& command, const std::string& tool) {
    std::string cases;
    for (const OptionText& option : command.options) {
        if (!option.takesValue()) continue;
        cases += "        " + (option.short_name.empty() ? "" : option.short_name + "|") + option.long_name + ") " +
                 candidates(option.value, tool) + "; return ;;\n";
    }
    return "_" + functionName(command.name) + "() {\n    case $before in\n" + cases +
           "    esac\n    case $current in\n        -*) _" + tool + "_words '" + longNames(command) +
           "'; return ;;\n    esac\n    " + candidates(command.input.value, tool) + "\n}\n";
}

std::string commandFunctions(const CommandText& command, const std::string& tool) {
    std::string text, cases, names;
    for (const CommandText& each : command.commands) {
        const std::string name(lastWord(each.name));
        text += function(each, tool);
        cases += "        " + name + ") _" + functionName(each.name) + " ;;\n";
        names += (names.empty() ? "" : " ") + name;
    }
    return text + "_" + tool + "() {\n    case $COMP_CWORD:$current in\n        1:-*) _" + tool + "_words '" +
           longNames(command) + "'; return ;;\n        1:*) _" + tool + "_words '" + names +
           "'; return ;;\n    esac\n    case ${COMP_WORDS[1]} in\n" + cases + "    esac\n}\n";
}

/// @ is replaced by the tool's name. Bash splits --option=VALUE into three words.
constexpr const char* kHelpers = R"(
_@_words() {
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$current")
}
_@_files() {
    local pattern
    compopt -o filenames 2>/dev/null
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
        compgen -d -- "$current"
        for pattern; do compgen -f -X "!$pattern" -- "$current"; done
    )
}
_@_start() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if [ "$current" = = ]; then
        current=""
    elif [ "$before" = = ]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    _@
}
)";

std::string withTool(std::string text, const std::string& tool) {
    for (std::size_t at = text.find("_@"); at != text.npos; at = text.find("_@", at)) text.replace(at + 1, 1, tool);
    return text;
}

} // namespace

std::string bashCompletion(const CommandText& command) {
    const std::string tool = functionName(command.name);
    return "# bash completion of " + command.name + ", made by " + command.name + " --generate bash" +
           withTool(kHelpers, tool) +
           (command.commands.empty() ? function(command, tool) : commandFunctions(command, tool)) + "complete -F _" +
           tool + "_start " + command.name + "\n";
}

} // namespace pointrt
