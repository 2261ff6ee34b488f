// SPDX-License-Identifier: Apache-2.0
// What the command lines of all tools have in common: --help, --version, and what is said of a slip. For the one file
// of a tool that knows CLI11.
#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "format/base/near_name.h"

namespace pointrt {

/// Files that people write without the option they belong to: {".png", "-o"}.
using OutputSuffixes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// Gives --help its end, and adds --version and --help themselves.
/// @param examples lines of two columns or one, each begun with the tool's name
inline void addCommonOptions(CLI::App& app, const std::string& version, const std::string& examples,
                             const std::string& notes) {
    app.footer("Examples:\n" + examples + "\n" + notes);
    app.set_version_flag("--version", app.get_name() + " " + version, "Print the version and end");
    app.set_help_flag("-h,--help", "Print this help and end");
}

namespace command_line {

[[noreturn]] inline void refuse(const std::string& reason) { throw Error{ExitCode::kBadUsage, reason}; }

inline void print(const std::string& text) {
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw Error{ExitCode::kCannotWrite, "standard output: cannot write"};
}

/// Without their dashes.
inline std::vector<std::string_view> longNames(const CLI::App& app) {
    std::vector<std::string_view> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.emplace_back(name);
    return names;
}

inline std::string unknownOption(const CLI::App& app, std::string_view written) {
    const std::string_view option = written.substr(0, written.find('='));
    const std::string_view bare = option.substr(std::min(option.find_first_not_of('-'), option.size()));
    const std::vector<std::string_view> names = longNames(app);
    const std::string_view near = bare.size() > 1 ? nearestName(bare, names) : std::string_view();
    return "unknown option " + std::string(option) +
           (near.empty() ? "" : ", did you mean --" + std::string(near) + "?");
}

/// What CLI11 takes for something else than was meant: an empty argument, mostly a variable of the shell that is not
/// set; -output, which it reads as -o utput; and -o=FILE, of which it makes a file called "=FILE".
inline void refuseSlips(const CLI::App& app, int argc, const char* const* argv) {
    const std::vector<std::string_view> names = longNames(app);
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i], before = i > 1 ? argv[i - 1] : "";
        if (argument == "--") return;
        if (argument.empty())
            refuse((before.starts_with('-') ? std::string(before) + ": " : "") + "an empty argument is given");
        if (!argument.starts_with('-') || argument.size() < 3 || argument[1] == '-') continue;
        if (std::find(names.begin(), names.end(), argument.substr(1, argument.find('=') - 1)) != names.end())
            refuse(unknownOption(app, argument));
        if (argument[2] == '=' && app.get_option_no_throw(std::string(argument.substr(0, 2))))
            refuse(std::string(argument) + ": a blank, not an =, goes between " + std::string(argument.substr(0, 2)) +
                   " and its value");
    }
}

/// The first thing that no option asked for, "" where there is none. Options come first: what follows one that is
/// unknown is mostly its value.
inline std::string unexpected(const CLI::App& app, OutputSuffixes outputs) {
    std::vector<std::string> extras = app.remaining();
    std::erase(extras, "--");
    const auto isOption = [](const std::string& extra) { return extra.size() > 1 && extra.front() == '-'; };
    const auto option = std::find_if(extras.begin(), extras.end(), isOption);
    if (option != extras.end()) return unknownOption(app, *option);
    if (extras.empty()) return {};
    const std::string& extra = extras.front();
    for (const auto& [suffix, name] : outputs)
        if (extra.ends_with(suffix))
            return "unexpected argument " + extra + ", did you mean " + std::string(name) + " " + extra + "?";
    return "unexpected argument " + extra;
}

/// CLI11's "--output: 1 required FILE missing" in English.
inline std::string reasonOf(const CLI::ParseError& error) {
    std::string reason = error.what();
    const std::string needless = "1 required ";
    const std::size_t at = reason.find(needless);
    return at == std::string::npos ? reason : reason.erase(at, needless.size());
}

} // namespace command_line

/// Parses the command line. Returns an exit code where the run ends here: --help and --version, whose text goes to
/// standard output. Throws Error kBadUsage with one line for anything wrong.
inline std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                           OutputSuffixes outputs = {}) {
    command_line::refuseSlips(app, argc, argv);
    try {
        app.parse(argc, argv);
        return {};
    } catch (const CLI::CallForHelp&) {
        command_line::print(app.help());
    } catch (const CLI::CallForVersion& version) {
        command_line::print(std::string(version.what()) + "\n");
    } catch (const CLI::ParseError& error) {
        // what lacks an option may have it misspelt
        const std::string unexpected = command_line::unexpected(app, outputs);
        command_line::refuse(unexpected.empty() ? command_line::reasonOf(error) : unexpected);
    }
    return static_cast<int>(ExitCode::kDone);
}

} // namespace pointrt
