// SPDX-License-Identifier: Apache-2.0
// The options of the command line under their headings in --help, but for the render settings, which have a table of
// their own (runtime/scene/render_setting_table.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/render_setting_table.h"
#include "runtime/session/options.h"

namespace pointrt {

/// An option with a value, or a switch that turns on a flag.
struct OptionRow {
    const char* names; ///< "-o,--output"
    const char* placeholder = nullptr;
    std::string help;
    /// Takes the value. Throws std::invalid_argument with the reason where it is none.
    void (*set)(Options& options, const std::string& text) = nullptr;
    std::string completes = {};    ///< what shells offer: completes() of command_line.h
    bool Options::*flag = nullptr; ///< of a switch, which has no placeholder
};

struct OptionGroup {
    const char* heading;
    std::vector<OptionRow> options;
    std::optional<HelpGroup> settings; ///< those come after the options
};

/// In the order of --help.
std::vector<OptionGroup> optionGroups();

} // namespace pointrt
