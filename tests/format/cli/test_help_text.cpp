// SPDX-License-Identifier: Apache-2.0
// --help fits terminals of 80 columns, whatever the length of its texts.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "format/cli/command_text.h"
#include "tests/support/contains.h"

namespace pointrt {
namespace {

using test::contains;

std::string sentence(int words) {
    std::string text = "First";
    for (int i = 1; i < words; ++i) text += " word" + std::to_string(i);
    return text;
}

OptionText option(const std::string& name, const std::string& placeholder, const std::string& help) {
    OptionText text;
    text.long_name = name;
    text.heading = "Options";
    text.help = help;
    text.value.placeholder = placeholder;
    return text;
}

CommandText command() {
    CommandText text;
    text.name = "pointrt-try";
    text.about = sentence(30) + "\nSecond line.";
    text.input = option("", "INPUT", sentence(20));
    text.input.required = text.input.repeats = true;
    text.options = {option("--long", "VALUE", sentence(40)), option("--a-very-long-name", "PLACEHOLDER", "Its help"),
                    option("--switch", "", "Do it")};
    text.options[0].short_name = "-l";
    text.options[0].required = true;
    text.options[2].heading = "More";
    text.examples = "  pointrt-try a   " + sentence(20) + "\n  pointrt-try abc   short\n";
    text.notes = sentence(30) + "\nsame paragraph.\n\nNext paragraph.";
    text.wrong_input = sentence(20);
    return text;
}

TEST(HelpText, FitsIn80Columns) {
    std::istringstream help(helpText(command()));
    std::size_t widest = 0;
    for (std::string line; std::getline(help, line); widest = std::max(widest, line.size()))
        EXPECT_LE(line.size(), 80u) << line;
    EXPECT_GT(widest, 70u);
}

TEST(HelpText, AlignsDescriptions) {
    const std::string help = helpText(command()), column(26, ' ');
    EXPECT_TRUE(contains(help, "\n  -l,--long VALUE         First word1 ")) << help;
    EXPECT_TRUE(contains(help, "\n" + column + "word9 ")) << help;
    EXPECT_TRUE(contains(help, " word39 (required)\n")) << help;
    EXPECT_TRUE(contains(help, "\n  --a-very-long-name PLACEHOLDER\n" + column + "Its help\n")) << help;
    EXPECT_TRUE(contains(help, "\n\nMore:\n  --switch                Do it\n")) << help;
    EXPECT_TRUE(contains(help, "\n  pointrt-try abc   short\n")) << help;
    EXPECT_TRUE(contains(help, "\n  pointrt-try a     First ")) << help;
}

TEST(HelpText, HasUsageNotesAndExitCodes) {
    const std::string help = helpText(command());
    EXPECT_TRUE(contains(help, "\nUsage: pointrt-try [OPTION]... INPUT... -l VALUE\n")) << help;
    EXPECT_TRUE(contains(help, "\nSecond line.\n")) << help;
    EXPECT_TRUE(contains(help, " same paragraph.\n\nNext paragraph.\n\nExit codes:\n  0  success\n")) << help;
}

TEST(HelpText, BreaksLongExamplesWhereShellsJoinThem) {
    CommandText text = command();
    text.examples = "  pointrt-try " + std::string(50, 'a') + " --one VALUE --two VALUE -o FILE | cat\n";
    EXPECT_TRUE(contains(helpText(text), " --one VALUE \\\n      --two VALUE -o FILE | cat\n")) << helpText(text);
}

TEST(HelpText, ListsCommands) {
    CommandText text = command(), part;
    part.name = "pointrt-try part";
    part.purpose = "does a part";
    text.commands = {part};
    EXPECT_TRUE(contains(helpText(text), "\nUsage: pointrt-try COMMAND ...\n")) << helpText(text);
    EXPECT_TRUE(contains(helpText(text), "\nCommands:\n  part                    does a part\n")) << helpText(text);
}

} // namespace
} // namespace pointrt
