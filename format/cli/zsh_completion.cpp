// SPDX-License-Identifier: Apache-2.0
#include "format/cli/command_text.h"

namespace pointrt {
namespace {

/// The action of an argument of _arguments: words, files, or a space for no candidates.
std::string action(const ValueText& value) {
    if (value.is_file) {
        std::string pattern;
        for (const std::string& suffix : value.suffixes) pattern += (pattern.empty() ? "" : "|") + suffix.substr(1);
        if (value.suffixes.size() > 1) pattern = "(" + pattern + ")"; // one alone would be a glob qualifier
        return pattern.empty() ? "_files" : "_files -g \"(#i)*." + pattern + "\"";
    }
    return value.words.empty() ? " " : "(" + escaped(joinedWords(value.words, " "), ":\\") + ")";
}

/// A quoted argument of _arguments.
std::string argument(const std::string& text) { return inShellQuotes(text, "'\\''"); }

std::string valueSpec(const ValueText& value) { return ":" + escaped(value.placeholder, ":\\") + ":" + action(value); }

std::string optionSpec(const OptionText& option) {
    const bool both = !option.short_name.empty();
    const std::string equals = option.takesValue() ? "=" : "";
    const std::string excludes = option.repeats ? "*"
                                 : both         ? "(" + option.short_name + " " + option.long_name + ")"
                                                : "";
    const std::string rest =
        "[" + escaped(shortHelp(option), "[]\\") + "]" + (option.takesValue() ? valueSpec(option.value) : "");
    if (!both) return argument(excludes + option.long_name + equals + rest);
    return (excludes.empty() ? "" : argument(excludes)) + "{" + option.short_name + "," + option.long_name + equals +
           "}" + argument(rest);
}

/// A call that completes the words after the name of a command.
std::string argumentsCall(const CommandText& command, const std::string& indent) {
    std::string text = indent + "_arguments -s -S";
    for (const OptionText& option : command.options) text += " \\\n" + indent + "    " + optionSpec(option);
    const ValueText& input = command.input.value;
    if (!input.placeholder.empty())
        text += " \\\n" + indent + "    " + argument((command.input.repeats ? "*" : "1") + valueSpec(input));
    return text + "\n";
}

std::string commandCases(const CommandText& command) {
    std::string names, cases;
    for (const CommandText& each : command.commands) {
        const std::string name(lastWord(each.name));
        names += " " + argument(name + ":" + escaped(each.purpose, ":\\"));
        cases += "        " + name + ")\n" + argumentsCall(each, "            ") + "            ;;\n";
    }
    return "if [[ $CURRENT$PREFIX = 2-* ]]; then\n" + argumentsCall(command, "    ") +
           "elif (( CURRENT == 2 )); then\n    local -a commands=(" + names.substr(1) +
           ")\n    _describe command commands\nelse\n    shift words\n    (( CURRENT-- ))\n    case $words[1] in\n" +
           cases + "    esac\nfi\n";
}

} // namespace

std::string zshCompletion(const CommandText& command) {
    return "#compdef " + command.name + "\n# made by " + command.name + " --generate zsh\n" +
           (command.commands.empty() ? argumentsCall(command, "") : commandCases(command));
}

} // namespace pointrt
