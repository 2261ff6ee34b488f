// SPDX-License-Identifier: Apache-2.0
// compare_raw MESH PICTURE...: compares pictures of a raw scan's surface with views of the truth.
// Writes FILM.errors.png for each film (writeErrors).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "format/base/run_tool.h"
#include "tests/bench/quality/raw/raw_report.h"

namespace pointrt::quality {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string mesh, name = "mean";
    std::vector<std::string> pictures, raw, eyes;
    std::vector<double> target{0, 0, 0}, up{0, 1, 0};
    double fov = 30, depth_tolerance = 0, seen = 0.001;
    int size = 1024;
    std::string figures;
};

Vec3d vectorOf(const std::string& text) {
    Vec3d vector;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &vector.x(), &vector.y(), &vector.z(), &rest) != 3)
        throw Error(ExitCode::kBadUsage, "--eye " + text + ": is not X,Y,Z");
    return vector;
}

bool isFilm(const std::string& path) { return path.ends_with(".exr"); }

/// The picture from each eye: films, or views of one mesh.
class Pictures {
public:
    Pictures(const Options& options, const UnitFrame& frame) : options_(options), frame_(frame) {
        const std::size_t wanted = isFilm(options.pictures.front()) ? options.eyes.size() : 1;
        if (options.pictures.size() != wanted)
            throw Error(ExitCode::kBadUsage, "takes an EXR an --eye, or one mesh for all of them");
        if (isFilm(options.pictures.front())) return;
        mesh_ = loadMesh(options.pictures.front());
        for (Vec3f& position : mesh_.positions)
            position = frame.unitFromInput(mesh_.frame.center + mesh_.frame.radius * position.cast<double>());
        tracing_.emplace(mesh_);
    }
    Sights of(std::size_t number, const Pinhole& camera) const {
        return tracing_ ? castMesh(mesh_, *tracing_, UnitCamera(camera, frame_))
                        : readSights(options_.pictures[number], camera, frame_);
    }

private:
    const Options& options_;
    const UnitFrame& frame_;
    Mesh mesh_;
    std::optional<Tracing> tracing_;
};

/// Figures for each eye, then their mean.
Json compareAll(const Options& options) {
    const Mesh mesh = loadMesh(options.mesh);
    const UnitFrame& frame = mesh.frame;
    const Tracing tracing(mesh);
    const RawPoints raw = loadRawPoints(options.raw, frame);
    const Pictures pictures(options, frame);
    const double tolerance = options.depth_tolerance > 0 ? options.depth_tolerance : 0.01 * frame.radius;
    const PictureTruth against{tracing, raw, static_cast<float>(tolerance / frame.radius),
                               static_cast<float>(options.seen / frame.radius)};
    std::vector<Json> all, seen;
    Json report = Json::array();
    for (std::size_t i = 0; i < options.eyes.size(); ++i) {
        const Pinhole camera{vectorOf(options.eyes[i]), Vec3d(options.target.data()), Vec3d(options.up.data()),
                             options.fov, options.size};
        const UnitCamera unit_camera(camera, frame);
        const AllAndSeen errors =
            compareSights(castMesh(mesh, tracing, unit_camera), pictures.of(i, camera), unit_camera, against);
        if (isFilm(options.pictures.front())) writeErrors(options.pictures[i] + ".errors.png", errors.pixels);
        all.push_back(figuresOf(errors.all));
        seen.push_back(figuresOf(errors.seen));
        report.push_back({{"name", options.eyes[i]}, {"all", all.back()}, {"seen", seen.back()}});
    }
    report.push_back({{"name", options.name}, {"all", meanOf(all)}, {"seen", meanOf(seen)}});
    return report;
}

int compare(const Options& options) {
    const Json report = compareAll(options);
    if (!options.figures.empty() && !(std::ofstream(options.figures) << report.dump(2) << std::endl))
        throw Error(ExitCode::kCannotWrite, options.figures + ": cannot be written");
    std::fputs(titleLine().c_str(), stdout);
    for (const Json& row : report)
        std::fputs(lineOf(row.at("name").get<std::string>(), row.at("all"), row.at("seen")).c_str(), stdout);
    return 0;
}

void addOptions(CLI::App& app, Options& options) {
    app.add_option("mesh", options.mesh, "The truth")->required();
    app.add_option("pictures", options.pictures,
                   "For each --eye what pointrt-view wrote with --spp 1 -o FILE.exr, or one mesh to trace instead")
        ->required();
    app.add_option("--raw", options.raw, "The raw points, any scan that pointrt-bake reads")->required();
    app.add_option("--eye", options.eyes, "X,Y,Z, one a picture")->required();
    app.add_option("--target", options.target, "X,Y,Z (default 0,0,0)")->delimiter(',')->expected(3);
    app.add_option("--up", options.up, "X,Y,Z (default 0,1,0)")->delimiter(',')->expected(3);
    app.add_option("--fov", options.fov, "Degrees from the first row to the last (default 30)");
    app.add_option("--size", options.size, "Pixels a side (default 1024)")->check(CLI::Range(1, 16384));
    app.add_option("--seen", options.seen, "Truth within this distance of a raw point was scanned (default 0.001)");
    app.add_option("--depth-tolerance", options.depth_tolerance,
                   "Off in depth is more than this along the ray (default 1% of half the truth's diagonal)");
    app.add_option("--name", options.name, "Of the line of means (default mean)");
    app.add_option("--figures", options.figures, "JSON of the table (default: none)");
}

} // namespace

} // namespace pointrt::quality

int main(int argc, char** argv) {
    pointrt::quality::Options options;
    CLI::App app{"Compares pictures of a raw scan's surface with the mesh that is the truth."};
    pointrt::quality::addOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(pointrt::ExitCode::kBadUsage);
    }
    return pointrt::runTool("compare_raw", [&] { return pointrt::quality::compare(options); });
}
