// SPDX-License-Identifier: Apache-2.0
#include "format/cli/command_text.h"

#include <algorithm>
#include <cctype>

namespace pointrt {

std::string synopsis(const CommandText& command, const SynopsisStyle& style) {
    std::string text = style.literal(command.name);
    if (!command.commands.empty()) return text + " " + style.placeholder("COMMAND") + " ...";
    text += " [" + style.placeholder("OPTION") + "]...";
    const ValueText& input = command.input.value;
    if (input.placeholder.empty()) return text;
    const std::string name = style.placeholder(input.placeholder) + (command.input.repeats ? "..." : "");
    text += command.input.required ? " " + name : " [" + name + "]";
    for (const OptionText& option : command.options)
        if (option.required)
            text += " " + style.literal(option.short_name.empty() ? option.long_name : option.short_name) + " " +
                    style.placeholder(option.value.placeholder);
    return text;
}

std::string optionHelp(const OptionText& option) { return option.help + (option.required ? " (required)" : ""); }

std::vector<std::string> exitMeanings(const CommandText& command) {
    return {"success", "bad input: " + command.wrong_input, "wrong usage of the command line",
            "unsupported on this machine (no Vulkan device, out of memory)", "cannot write the output"};
}

std::string shortHelp(const OptionText& option) {
    constexpr std::size_t kLongest = 60; // beside the option's names, on a terminal of 80 to 100 columns
    std::string_view text = option.help;
    for (const std::string_view end : {" (", ";", ": ", ", or ", "\n"}) text = text.substr(0, text.find(end));
    if (text.size() <= kLongest) return std::string(text);
    return std::string(text.substr(0, text.rfind(' ', kLongest - 3))) + "...";
}

std::string functionName(std::string_view name) {
    std::string function(name);
    std::ranges::replace_if(
        function, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return function;
}

std::string_view lastWord(std::string_view name) { return name.substr(name.rfind(' ') + 1); }

std::string joinedWords(const std::vector<std::string>& words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) text += (&word == &words.front() ? "" : std::string(separator)) + word;
    return text;
}

std::string escaped(std::string_view text, std::string_view characters) {
    std::string result;
    for (const char c : text) result += (characters.find(c) == characters.npos ? "" : "\\") + std::string(1, c);
    return result;
}

std::string inShellQuotes(std::string_view text, std::string_view quote) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string(quote) : std::string(1, c);
    return result + "'";
}

} // namespace pointrt
