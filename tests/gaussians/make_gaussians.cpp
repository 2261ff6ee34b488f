// SPDX-License-Identifier: Apache-2.0
// make_gaussians KIND COUNT OUT.ply [SEED]: writes Gaussians that are hard to trace.
#include <CLI/CLI.hpp>

#include "format/base/run_tool.h"
#include "tests/gaussians/gaussian_ply.h"
#include "tests/gaussians/nasty_gaussians.h"

int main(int argc, char** argv) {
    using namespace pointrt;
    std::string kind, output;
    std::size_t count = 0;
    std::uint64_t seed = 1;
    CLI::App app("Makes Gaussians that are hard to trace, as a PLY.", "make_gaussians");
    app.add_option("KIND", kind)->required()->check(CLI::IsMember(test::gaussianKinds()));
    app.add_option("COUNT", count, "Gaussians")->required()->check(CLI::Range(1u, 100'000'000u));
    app.add_option("OUT.ply", output)->required();
    app.add_option("SEED", seed, "Random seed (default 1)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kBadUsage);
    }
    return runTool("make_gaussians", [&] {
        test::writeGaussianPly(output, test::makeGaussians(kind, count, seed));
        return 0;
    });
}
