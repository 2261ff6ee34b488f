// SPDX-License-Identifier: Apache-2.0
// compare_truth SCENE.pro MESH: compares splats baked from samples of a mesh with the mesh.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "format/base/run_tool.h"
#include "tests/bench/quality/report.h"

namespace pointrt::quality {

namespace {

struct Options {
    std::string scene, mesh, view_folder;
    bool json = false;
};

ViewErrors compareViews(const Tracing& truth, const Discs& discs, const Options& options) {
    const Tracing splats(discs);
    ViewErrors errors;
    int number = 0;
    for (const Vec3f& direction : viewDirections()) {
        const auto classes = classifyView(castView(truth, splats, direction), discs.median_radius, errors);
        if (!options.view_folder.empty())
            writeClasses(options.view_folder + "/view_" + std::to_string(number++) + ".ppm", classes);
    }
    return errors;
}

int compare(const Options& options) {
    const Mesh mesh = loadMesh(options.mesh);
    const Discs discs = loadDiscs(options.scene, mesh.frame);
    const Tracing truth(mesh);
    const SplatErrors splats = compareSplats(mesh, truth, discs);
    const auto report = reportOf(discs, splats, compareViews(truth, discs, options));
    std::fputs(options.json ? (report.dump(2) + '\n').c_str() : tableOf(report).c_str(), stdout);
    return 0;
}

} // namespace

} // namespace pointrt::quality

int main(int argc, char** argv) {
    pointrt::quality::Options options;
    CLI::App app{"Compares splats baked from samples of a mesh with the mesh."};
    app.add_option("scene", options.scene, "The .pro, baked with --sample N --normals estimate")->required();
    app.add_option("mesh", options.mesh, "The mesh it was baked from")->required();
    app.add_flag("--json", options.json, "JSON instead of a table");
    app.add_option("--views", options.view_folder, "Folder for a picture of each view's errors, PPM (default: none)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(pointrt::ExitCode::kBadUsage);
    }
    return pointrt::runTool("compare_truth", [&] { return pointrt::quality::compare(options); });
}
