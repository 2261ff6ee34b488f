// SPDX-License-Identifier: Apache-2.0
// The command line shared by the tools that compare first hits.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>

#include "format/base/run_tool.h"

namespace pointrt::test {

struct CompareOptions {
    std::size_t rays = 1'000'000; ///< of each kind
    std::uint64_t seed = 1;
    bool json = false;
};

inline void addCompareOptions(CLI::App& app, CompareOptions& options) {
    app.add_option("--rays", options.rays, "Random rays, and as many grazing ones")->check(CLI::Range(1, 100'000'000));
    app.add_option("--seed", options.seed, "Of the rays");
    app.add_flag("--json", options.json, "JSON on standard output");
}

/// Parses the command line and calls body() -> int, with errors like those of the product's tools.
template <typename Body>
int runCompare(CLI::App& app, int argc, char** argv, Body&& body) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), static_cast<int>(ExitCode::kBadUsage));
    }
    return runTool(app.get_name().c_str(), body);
}

} // namespace pointrt::test
