// SPDX-License-Identifier: Apache-2.0
// The text of --help, wrapped for terminals of 80 columns.
#include <algorithm>
#include <sstream>
#include <string_view>

#include "format/cli/command_text.h"

namespace pointrt {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kHelpColumn = 26; ///< where option descriptions start, which leaves 54 columns
constexpr std::size_t kExampleGap = 3;  ///< spaces between an example and its description, at least

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Wraps text that starts at this column; lines after the first are indented.
std::string wrapped(const std::string& text, std::size_t column, std::size_t indent) {
    std::string result;
    bool at_start = true; // of a line
    std::istringstream stream(text);
    for (std::string word; stream >> word; at_start = false) {
        if (!at_start && column + 1 + word.size() > kColumns) {
            result += "\n" + std::string(indent, ' ');
            column = indent;
            at_start = true;
        }
        result += (at_start ? "" : " ") + word;
        column += word.size() + (at_start ? 0 : 1);
    }
    return result + "\n";
}

/// Wraps each line of text separately.
std::string wrappedLines(const std::string& text) {
    std::string result;
    for (const std::string& line : linesOf(text)) result += wrapped(line, 0, 0);
    return result;
}

/// Wraps paragraphs, which are separated by empty lines.
std::string wrappedParagraphs(const std::string& text) {
    std::string result, paragraph;
    for (const std::string& line : linesOf(text + "\n\n")) {
        paragraph += line + " ";
        if (!line.empty()) continue;
        if (paragraph != " ") result += (result.empty() ? "" : "\n") + wrapped(paragraph, 0, 0);
        paragraph.clear();
    }
    return result;
}

/// A name and its description, side by side unless the name is too wide.
std::string entry(const std::string& name, const std::string& description) {
    const std::string start = "  " + name;
    const bool fits = start.size() + 2 <= kHelpColumn;
    return start + (fits ? std::string(kHelpColumn - start.size(), ' ') : "\n" + std::string(kHelpColumn, ' ')) +
           wrapped(description, kHelpColumn, kHelpColumn);
}

std::string optionEntry(const OptionText& option) {
    std::string names = (option.short_name.empty() ? "" : option.short_name + ",") + option.long_name;
    if (option.takesValue()) names += " " + option.value.placeholder + (option.repeats ? " ..." : "");
    return entry(names, optionHelp(option));
}

std::string argumentSection(const OptionText& input) {
    if (!input.takesValue()) return "";
    return "\nArguments:\n" + entry(input.value.placeholder + (input.repeats ? "..." : ""), input.help);
}

std::string commandSection(const CommandText& command) {
    if (command.commands.empty()) return "";
    std::string text = "\nCommands:\n";
    for (const CommandText& each : command.commands) text += entry(std::string(lastWord(each.name)), each.purpose);
    return text;
}

std::string optionSections(const CommandText& command) {
    std::string text, heading;
    for (const OptionText& option : command.options) {
        if (option.heading != heading) text += "\n" + wrapped(option.heading + ":", 0, 0);
        heading = option.heading;
        text += optionEntry(option);
    }
    return text;
}

struct Example {
    std::string command, description;
};

Example exampleOf(const std::string& line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find(std::string(kExampleGap, ' '), begin);
    if (gap == line.npos) return {line.substr(begin), ""};
    return {line.substr(begin, gap - begin), line.substr(line.find_first_not_of(' ', gap))};
}

/// Splits a command into lines that end in backslashes, before options and pipes.
std::string commandLines(std::string command) {
    std::string text = "  ";
    const std::string next = " \\\n      "; // deeper than the first line
    for (std::size_t indent = 2; indent + command.size() > kColumns; indent = 6) {
        const std::size_t longest = kColumns - indent - 2; // the backslash takes two columns
        const std::size_t at = std::max(command.rfind(" -", longest) + 1, command.rfind(" | ", longest) + 1);
        if (at == 0) break;
        text += command.substr(0, at - 1) + next;
        command.erase(0, at);
    }
    return text + command;
}

std::string exampleSection(const std::string& lines) {
    std::vector<Example> examples;
    std::size_t column = 0; // of descriptions
    for (const std::string& line : linesOf(lines)) {
        examples.push_back(exampleOf(line));
        const Example& last = examples.back();
        if (!last.description.empty()) column = std::max(column, 2 + last.command.size() + kExampleGap);
    }
    std::string text = examples.empty() ? "" : "\nExamples:\n";
    for (const auto& [command, description] : examples)
        text += description.empty() ? commandLines(command) + "\n"
                                    : "  " + command + std::string(column - 2 - command.size(), ' ') +
                                          wrapped(description, column, column);
    return text;
}

std::string exitSection(const CommandText& command) {
    std::string text = "\nExit codes:\n";
    int code = 0;
    for (const std::string& meaning : exitMeanings(command))
        text += "  " + std::to_string(code++) + "  " + wrapped(meaning, 5, 5);
    return text;
}

std::string closing(const CommandText& command) {
    if (!command.commands.empty()) return "\nRun '" + command.name + " COMMAND --help' for help on a command.\n";
    return exampleSection(command.examples) + (command.notes.empty() ? "" : "\n" + wrappedParagraphs(command.notes)) +
           exitSection(command);
}

} // namespace

std::string helpText(const CommandText& command) {
    constexpr SynopsisStyle kPlain = {[](std::string_view text) { return std::string(text); },
                                      [](std::string_view text) { return std::string(text); }};
    const std::string usage = "Usage: ";
    return wrappedLines(command.about) + usage + wrapped(synopsis(command, kPlain), usage.size(), usage.size()) +
           argumentSection(command.input) + commandSection(command) + optionSections(command) + closing(command);
}

} // namespace pointrt
