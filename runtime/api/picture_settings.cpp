// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/picture_settings.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "format/base/error.h"
#include "runtime/scene/render_setting_table.h"
#include "runtime/session/option_table.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr std::string_view kDashes = "--";
/// Options that pictures in memory support although the table of settings lacks them.
constexpr std::string_view kOtherOptions[] = {"--up", "--memory", "--clip", "--only", "--section", "--ortho", "--sun"};
constexpr const char* kStagedFor = "--staged-for";
/// Settings that only affect 8-bit files, or that are arguments of render().
constexpr std::string_view kElsewhere[] = {"--size", "--exposure", "--legend"};

template <typename List>
bool has(const List& list, std::string_view option) {
    return std::find(std::begin(list), std::end(list), option) != std::end(list);
}

/// The name of the command line option.
std::string optionNamed(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return std::string(kDashes) + name;
}

/// False if the table has no such option.
bool takeTableSetting(const std::string& option, const std::string& text, Options& options) {
    bool found = false;
    forEachRenderSetting([&](const auto& row) {
        if (option != row.command_line.option || has(kElsewhere, option)) return;
        options.choices.*row.choice = parseValue(row.limits, text);
        found = true;
    });
    return found;
}

/// The values of an option that can be repeated, separated by spaces.
std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

bool takeOtherOption(const std::string& option, const std::string& text, Options& options) {
    if (!has(kOtherOptions, option)) return false;
    for (const OptionGroup& group : optionGroups())
        for (const OptionRow& row : group.options) {
            if (option != row.names) continue;
            for (const std::string& each : row.repeats ? words(text) : std::vector{text}) row.set(options, each);
        }
    return true;
}

std::string knownSettings() {
    std::string names;
    const auto add = [&](std::string_view option) {
        if (!has(kElsewhere, option)) names += (names.empty() ? "" : ", ") + std::string(option.substr(kDashes.size()));
    };
    forEachRenderSetting([&](const auto& row) { add(row.command_line.option); });
    for (const std::string_view option : kOtherOptions) add(option);
    add(kStagedFor);
    return names;
}

void take(const std::string& option, const std::string& text, PictureOptions& taken) {
    if (option == kStagedFor)
        taken.staged_for = parseVector(text);
    else if (!takeTableSetting(option, text, taken.options) && !takeOtherOption(option, text, taken.options))
        throw std::invalid_argument("unknown setting; known settings are " + knownSettings());
}

} // namespace

PictureOptions pictureOptions(const PictureSettings& settings) {
    PictureOptions taken;
    for (const auto& [name, text] : settings) try {
            take(optionNamed(name), text, taken);
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadUsage, name + ": " + error.what()};
        }
    return taken;
}

} // namespace pointrt
