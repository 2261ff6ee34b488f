// SPDX-License-Identifier: Apache-2.0
// Manual pages, in the man macros of troff.
#include <algorithm>
#include <cctype>
#include <string_view>

#include "format/cli/command_text.h"

namespace pointrt {
namespace {

/// text escaped for use within a line of troff. Dashes stay ASCII, so that commands can be copied to a shell.
std::string troff(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const std::string_view special = c == '\\'   ? "\\e"
                                         : c == '-'  ? "\\-"
                                         : c == '\'' ? "\\(aq"
                                         : c == '`'  ? "\\(ga"
                                         : c == '^'  ? "\\(ha"
                                         : c == '~'  ? "\\(ti"
                                                     : "";
        result += special.empty() ? std::string(1, c) : std::string(special);
    }
    return result;
}

/// Converts text to lines of troff that are not mistaken for requests. An empty line starts a paragraph.
std::string troffLines(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        result += (end == 0 ? ".PP" : text.starts_with('.') ? "\\&" : "") + troff(text.substr(0, end)) + "\n";
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

std::string bold(std::string_view text) { return "\\fB" + troff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + troff(text) + "\\fR"; }

/// A placeholder with its literal words in bold and the rest in italics.
std::string placeholderText(std::string_view placeholder) {
    std::string text;
    for (std::size_t begin = 0; begin <= placeholder.size();) {
        const std::size_t end = std::min(placeholder.find('|', begin), placeholder.size());
        const std::string_view word = placeholder.substr(begin, end - begin);
        const bool is_word = std::ranges::none_of(word, [](char c) { return c >= 'A' && c <= 'Z'; });
        text += (begin == 0 ? "" : "|") + (is_word ? bold(word) : italic(word));
        begin = end + 1;
    }
    return text;
}

std::string sentence(const std::string& text) {
    const bool ends = text.empty() || text.ends_with('.') || text.ends_with('?');
    return troffLines(text + (ends ? "" : "."));
}

std::string optionParagraph(const OptionText& option) {
    std::string names = option.short_name.empty() ? "" : bold(option.short_name) + ", ";
    names += bold(option.long_name);
    if (option.takesValue()) names += " " + placeholderText(option.value.placeholder);
    return ".TP\n" + names + "\n" + sentence(optionHelp(option));
}

std::string section(const std::string& heading, const std::string& text) {
    return text.empty() ? "" : ".SH " + heading + "\n" + text;
}

std::string dashed(std::string name) {
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::string commandList(const CommandText& command) {
    std::string text;
    for (const CommandText& each : command.commands)
        text += ".TP\n.BR " + troff(dashed(each.name)) + " (1)\n" + sentence(each.purpose);
    return text;
}

std::string optionParagraphs(const CommandText& command) {
    std::string text, heading;
    const OptionText& input = command.input;
    if (!input.value.placeholder.empty())
        text += ".TP\n" + italic(input.value.placeholder) + "\n" + sentence(input.help);
    for (const OptionText& option : command.options) {
        if (option.heading != heading && option.heading != "Options") text += ".SS " + troff(option.heading) + "\n";
        heading = option.heading;
        text += optionParagraph(option);
    }
    return text;
}

std::string capitalized(std::string text) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

std::string exitStatus(const CommandText& command) {
    std::string text;
    int code = 0;
    for (const std::string& meaning : exitMeanings(command))
        text += ".TP\n.B " + std::to_string(code++) + "\n" + sentence(capitalized(meaning));
    return text;
}

std::string seeAlso(const CommandText& command) {
    std::string text;
    for (const std::string name : {"pointrt-bake", "pointrt-info", "pointrt-rays", "pointrt-view"}) {
        if (name == command.name) continue;
        text += (text.empty() ? ".BR " : ",\n.BR ") + troff(name) + " (1)";
    }
    return text + "\n";
}

} // namespace

std::string manualPage(const CommandText& command) {
    const std::string name = dashed(command.name), tool = command.name.substr(0, command.name.find(' '));
    std::string title = name;
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string page = ".\\\" made by " + tool + " --generate\n.TH " + troff(title) + " 1 \"\" \"pointrt " +
                       command.version + "\" \"User Commands\"\n.nh\n.ad l\n";
    page += section("NAME", troff(name) + " \\- " + troff(command.purpose) + "\n");
    page += section("SYNOPSIS", synopsis(command, {bold, placeholderText}) + "\n");
    page += section("DESCRIPTION", troffLines(command.about));
    page += section("COMMANDS", commandList(command));
    page += section("OPTIONS", optionParagraphs(command));
    page += section("NOTES", troffLines(command.notes));
    page += section("EXIT STATUS", exitStatus(command));
    page += section("EXAMPLES", command.examples.empty() ? "" : ".nf\n" + troffLines(command.examples) + ".fi\n");
    return page + section("SEE ALSO", seeAlso(command));
}

} // namespace pointrt
