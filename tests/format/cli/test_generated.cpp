// SPDX-License-Identifier: Apache-2.0
// Manual pages and completions generated from a command line: characters special to troff and shells are escaped.
#include <gtest/gtest.h>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "tests/support/contains.h"

namespace pointrt {
namespace {

using test::contains;

struct Tool {
    std::string file, word;
    bool flag = false;
    CommandLine app{"Try things.\nAnd more.", "pointrt-try"};

    Tool() {
        app.option_defaults()->group("First");
        app.add_option("INPUT", file, "The input")->required()->type_name("");
        completes(app, "INPUT", ".pro .toml");
        app.add_option("-o,--output", file, "It's [new]: \\ and 'quoted'")->type_name("FILE")->required();
        app.option_defaults()->group("Second");
        app.add_option("--mode", word, ".dots and 'more' (default none)")->type_name("fast|best|LEVEL");
        app.add_option("--step", word, "One of them")->type_name("STEP");
        completes(app, "--step", "plan block:");
        app.add_flag("-q,--quiet", flag, "Print nothing");
        addCommonOptions(app, "1.2.3", "INPUT is wrong", "  pointrt-try a.pro -o b\n  .hidden 'x'\n",
                         "A note.\n.Last.\n\nParagraph.");
    }
};

TEST(CommandText, DescribesTheOptions) {
    const Tool tool;
    const CommandText text = describe(tool.app);
    EXPECT_EQ(text.name, "pointrt-try");
    EXPECT_EQ(text.purpose, "try things");
    EXPECT_EQ(text.version, "1.2.3");
    EXPECT_EQ(text.input.value.placeholder, "INPUT");
    EXPECT_EQ(text.input.value.suffixes, (std::vector<std::string>{".pro", ".toml"}));
    ASSERT_EQ(text.options.size(), 7u);
    EXPECT_EQ(text.options[0].short_name, "-o");
    EXPECT_EQ(text.options[0].long_name, "--output");
    EXPECT_TRUE(text.options[0].required);
    EXPECT_TRUE(text.options[0].value.is_file);
    EXPECT_EQ(text.options[1].heading, "Second");
    EXPECT_EQ(text.options[1].value.words, (std::vector<std::string>{"fast", "best"}));
    EXPECT_FALSE(text.options[1].value.is_file);
    EXPECT_EQ(text.options[2].value.words, (std::vector<std::string>{"plan", "block:"}));
    EXPECT_FALSE(text.options[3].takesValue());
}

TEST(ManualPage, EscapesTroffRequestsAndSpecialCharacters) {
    const Tool tool;
    const std::string page = manualPage(describe(tool.app));
    EXPECT_TRUE(contains(
        page, "\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\nIt\\(aqs [new]: \\e and \\(aqquoted\\(aq (required).\n"));
    EXPECT_TRUE(contains(page, "\n\\&.dots and \\(aqmore\\(aq (default none).\n"));
    EXPECT_TRUE(contains(page, "\n  .hidden \\(aqx\\(aq\n.fi\n"));
    EXPECT_TRUE(contains(page, "\n\\&.Last.\n"));
    EXPECT_TRUE(contains(page, "\\fBfast\\fR|\\fBbest\\fR|\\fILEVEL\\fR"));
    EXPECT_TRUE(contains(page, ".SS Second\n"));
    EXPECT_TRUE(contains(page, "Bad input: INPUT is wrong.\n"));
    EXPECT_TRUE(contains(page, "\n.PP\nParagraph.\n"));
}

TEST(Completions, QuoteSpecialCharactersOfShells) {
    const Tool tool;
    const CommandText text = describe(tool.app);
    EXPECT_TRUE(contains(zshCompletion(text), "'(-o --output)'{-o,--output=}'[It'\\''s \\[new\\]]:FILE:_files'"));
    EXPECT_TRUE(contains(zshCompletion(text), "'--step=[One of them]:STEP:(plan block\\:)'"));
    EXPECT_TRUE(contains(fishCompletion(text), "-s o -l output -r -F -d 'It\\'s [new]'"));
    EXPECT_TRUE(contains(fishCompletion(text), "-l mode -x -a 'fast best' -d '.dots and \\'more\\''"));
    EXPECT_TRUE(contains(bashCompletion(text), "--mode) _pointrt_try_words 'fast best'; return"));
    EXPECT_TRUE(contains(bashCompletion(text), "'*.[pP][rR][oO]' '*.[tT][oO][mM][lL]'"));
}

TEST(Generate, PrintsKnownKindsAndRefusesOthers) {
    Tool tool;
    const char* const words[] = {"pointrt-try", "--generate", "fish"};
    testing::internal::CaptureStdout();
    EXPECT_EQ(parseCommandLine(tool.app, 3, words), 0);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), fishCompletion(describe(tool.app)));
    EXPECT_THROW(generatedText(describe(tool.app), "tcsh"), Error);
    CommandLine part("A part.", "pointrt-try part");
    addCommonOptions(part, "1.2.3", "it is wrong", "");
    EXPECT_THROW(generatedText(describe(part), "bash"), Error);
    EXPECT_TRUE(contains(generatedText(describe(part), "man"), ".TH POINTRT\\-TRY\\-PART 1"));
}

TEST(Completes, ThrowsForAnUnknownOption) {
    Tool tool;
    EXPECT_THROW(completes(tool.app, "--outptu", ".png"), CLI::OptionNotFound);
}

} // namespace
} // namespace pointrt
