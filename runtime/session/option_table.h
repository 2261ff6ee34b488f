// SPDX-License-Identifier: Apache-2.0
// The options of the command line by their headings in --help, except render settings, which have their own table
// (runtime/scene/render_setting_table.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/render_setting_table.h"
#include "runtime/session/options.h"

namespace pointrt {

/// An option with a value, or a switch that sets a flag.
struct OptionRow {
    const char* names; ///< "-o,--output"
    const char* placeholder = nullptr;
    std::string help;
    /// Parses the value. Throws std::invalid_argument with the reason if it is invalid.
    void (*set)(Options& options, const std::string& text) = nullptr;
    std::string completes = {};    ///< values that shells complete; see completes() of command_line.h
    bool Options::*flag = nullptr; ///< for a switch, which has no placeholder
    bool repeats = false;          ///< set is called for each of several values
};

struct OptionGroup {
    const char* heading;
    std::vector<OptionRow> options;
    std::optional<HelpGroup> settings; ///< settings to list after the options
};

/// In the order of --help.
std::vector<OptionGroup> optionGroups();

} // namespace pointrt
