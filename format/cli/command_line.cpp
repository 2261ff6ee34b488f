// SPDX-License-Identifier: Apache-2.0
#include "format/cli/command_line.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <vector>

#include "format/base/error.h"
#include "format/base/near_name.h"
#include "format/os/program.h"

namespace pointrt {
namespace {

/// Thrown to end the parsing when --generate has text to print.
struct Generated {
    std::string text;
};

struct Generator {
    std::string_view name;
    std::string (*make)(const CommandText& command);
};
constexpr std::array kGenerators = {Generator{"man", manualPage}, Generator{"bash", bashCompletion},
                                    Generator{"zsh", zshCompletion}, Generator{"fish", fishCompletion}};

/// True for "pointrt-rays cast": its completions are part of those of pointrt-rays.
bool isSubcommand(std::string_view name) { return name.find(' ') != name.npos; }

std::string generatorNames(std::string_view command) {
    std::string names;
    for (const Generator& each : kGenerators) {
        names += (names.empty() ? "" : "|") + std::string(each.name);
        if (isSubcommand(command)) break;
    }
    return names;
}

[[noreturn]] void refuse(const std::string& reason) { throw Error{ExitCode::kBadUsage, reason}; }

void print(const std::string& text) {
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw Error{ExitCode::kCannotWrite, "standard output: cannot write"};
}

/// Long option names without their dashes.
std::vector<std::string_view> longNames(const CLI::App& app) {
    std::vector<std::string_view> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.emplace_back(name);
    return names;
}

std::string unknownOption(const CLI::App& app, std::string_view written) {
    const std::string_view option = written.substr(0, written.find('='));
    const std::string_view bare = option.substr(std::min(option.find_first_not_of('-'), option.size()));
    const std::vector<std::string_view> names = longNames(app);
    const std::string_view near = bare.size() > 1 ? nearestName(bare, names) : std::string_view();
    return "unknown option " + std::string(option) +
           (near.empty() ? "" : ", did you mean --" + std::string(near) + "?");
}

/// Refuses arguments that CLI11 would misread: an empty argument, usually from a shell variable that is not set;
/// -output, which CLI11 reads as -o utput; and -o=FILE, which it reads as a file named "=FILE".
void refuseSlips(const CLI::App& app, int argc, const char* const* argv) {
    const std::vector<std::string_view> names = longNames(app);
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i], before = i > 1 ? argv[i - 1] : "";
        if (argument == "--") return;
        if (argument.empty()) refuse((before.starts_with('-') ? std::string(before) + ": " : "") + "empty argument");
        if (!argument.starts_with('-') || argument.size() < 3 || argument[1] == '-') continue;
        if (std::find(names.begin(), names.end(), argument.substr(1, argument.find('=') - 1)) != names.end())
            refuse(unknownOption(app, argument));
        if (argument[2] == '=' && app.get_option_no_throw(std::string(argument.substr(0, 2))))
            refuse(std::string(argument) + ": write " + std::string(argument.substr(0, 2)) +
                   " VALUE, with a space and no =");
    }
}

/// An error line for the first argument that no option takes, or "". Unknown options come first: an argument after one
/// is probably its value.
std::string unexpectedArgument(const CLI::App& app, OutputSuffixes outputs) {
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

/// CLI11's message, with "--output: 1 required FILE missing" shortened to "--output: FILE missing".
std::string reasonOf(const CLI::ParseError& error) {
    std::string reason = error.what();
    const std::string needless = "1 required ";
    const std::size_t at = reason.find(needless);
    return at == std::string::npos ? reason : reason.erase(at, needless.size());
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

bool hasCapitals(const std::string& text) {
    return std::ranges::any_of(text, [](unsigned char c) { return std::isupper(c) != 0; });
}

ValueText valueText(const std::string& placeholder, const std::string& candidates) {
    ValueText value{.placeholder = placeholder, .words = {}, .is_file = false, .suffixes = {}};
    for (const std::string& part : split(placeholder, '|')) {
        if (part == "FILE" || part == "FOLDER") value.is_file = true;
        if (!hasCapitals(part) && placeholder.find('|') != placeholder.npos) value.words.push_back(part);
    }
    for (const std::string& candidate : split(candidates, ' ')) {
        value.is_file = value.is_file || candidate.starts_with('.');
        (candidate.starts_with('.') ? value.suffixes : value.words).push_back(candidate);
    }
    return value;
}

/// Also true for options that the tool itself requires, to report their absence better than CLI11 does.
bool isRequired(const CLI::Option& option) {
    return option.get_required() || option.get_option_text().ends_with("REQUIRED");
}

OptionText optionText(const CommandLine& app, const CLI::Option& option) {
    const auto candidates = app.candidates.find(&option);
    const bool is_input = option.get_positional();
    const std::string placeholder = is_input                      ? option.get_name()
                                    : option.get_type_size() == 0 ? ""
                                                                  : option.get_type_name();
    OptionText text{.short_name = option.get_snames().empty() ? "" : "-" + option.get_snames().front(),
                    .long_name = option.get_lnames().empty() ? "" : "--" + option.get_lnames().front(),
                    .heading = option.get_group(),
                    .help = option.get_description(),
                    .value = valueText(placeholder, candidates == app.candidates.end() ? "" : candidates->second),
                    .required = isRequired(option),
                    .repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll};
    for (const CLI::Option* other : option.get_excludes()) text.help += " (not with " + other->get_name() + ")";
    return text;
}

} // namespace

void completes(CommandLine& app, const std::string& option, const std::string& candidates) {
    app.candidates[app.get_option(option)] = candidates;
}

void addCommonOptions(CommandLine& app, const std::string& version, const std::string& wrong_input,
                      const std::string& examples, const std::string& notes) {
    app.examples = examples;
    app.notes = notes;
    app.wrong_input = wrong_input;
    app.set_version_flag("--version", app.get_name() + " " + version, "Print the version and exit");
    app.add_option_function<std::string>(
           "--generate", [&app](const std::string& what) { throw Generated{generatedText(describe(app), what)}; },
           isSubcommand(app.get_name()) ? "Print the manual page and exit" : "Print a manual page or shell completions")
        ->type_name(generatorNames(app.get_name()));
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.allow_windows_style_options(false); // names of files may begin with a /
}

CommandText describe(const CommandLine& app) {
    const std::string about = app.get_description(), version = app.version();
    std::string purpose = about.substr(0, about.find('\n'));
    if (purpose.ends_with('.')) purpose.pop_back();
    if (!purpose.empty())
        purpose.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(purpose.front())));
    CommandText text{.name = app.get_name(),
                     .purpose = purpose,
                     .about = about,
                     .version = version.substr(version.rfind(' ') + 1),
                     .input = {},
                     .options = {},
                     .examples = app.examples,
                     .notes = app.notes,
                     .wrong_input = app.wrong_input,
                     .commands = {}};
    for (const std::string& heading : app.get_groups())
        for (const CLI::Option* option : app.get_options()) {
            if (option->get_group() != heading) continue;
            if (option->get_positional())
                text.input = optionText(app, *option);
            else
                text.options.push_back(optionText(app, *option));
        }
    return text;
}

std::string generatedText(const CommandText& command, const std::string& what) {
    for (const Generator& each : kGenerators) {
        if (each.name == what) return each.make(command);
        if (isSubcommand(command.name)) break;
    }
    refuse("--generate: '" + what + "' is not one of " + generatorNames(command.name));
}

std::optional<int> parseCommandLine(CommandLine& app, int argc, const char* const* argv, OutputSuffixes outputs) {
    std::vector<std::string> words(argv, argv + argc);
    for (std::string& word : words) word = plainPath(word);
    std::vector<const char*> plain;
    for (const std::string& word : words) plain.push_back(word.c_str());
    refuseSlips(app, argc, plain.data());
    try {
        app.parse(argc, plain.data());
        return {};
    } catch (const CLI::CallForHelp&) {
        print(helpText(describe(app)));
    } catch (const CLI::CallForVersion& version) {
        print(std::string(version.what()) + "\n");
    } catch (const Generated& generated) {
        print(generated.text);
    } catch (const CLI::ParseError& error) {
        // a missing option may be present but misspelt
        const std::string unexpected = unexpectedArgument(app, outputs);
        refuse(unexpected.empty() ? reasonOf(error) : unexpected);
    }
    return static_cast<int>(ExitCode::kDone);
}

} // namespace pointrt
