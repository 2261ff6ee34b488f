// SPDX-License-Identifier: Apache-2.0
// A tile set from splats that were estimated from the whole cloud, for comparison with bakes in tiles.
#include <iostream>

#include "format/base/error.h"
#include "preprocess/input/read.h"
#include "preprocess/octree/splat_attributes.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/find_up.h"
#include "tests/bench/compare_options.h"
#include "tests/support/cloud_set.h"

namespace pointrt::test {

namespace {

struct Request {
    std::string input, output;
    std::size_t tiles = 16;
    std::uint64_t tile_splats = 1000000;
    bool index = true, prune = true;
};

int makeSet(const Request& request) {
    Cloud cloud = readInputs({request.input}, {});
    fitAttributes(cloud);
    const std::vector<Attribute> attributes = std::exchange(cloud.attributes, {});
    const std::vector<Scan> scans = cloud.scans;
    CloudSetOptions options;
    options.world = cloud.world;
    options.sensors = sensorRows(scans);
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), {}, report);
    if (options.world.up.isZero()) options.world.up = findUp(splats, scans).up;
    options.edge = edgeForTiles(splats, request.tiles);
    options.tile_splats = request.tile_splats;
    options.tiles.index = request.index;
    options.tiles.prune = request.prune;
    const CloudSet made = writeCloudSet(request.output, splats, attributes, options);
    for (std::size_t level = 0; level < made.set.levels.size(); ++level)
        std::cout << "level " << level << ": " << made.set.levels[level].tiles << " tiles, "
                  << made.set.levels[level].splats << " splats, error " << made.set.levels[level].error << '\n';
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt::test;
    CLI::App app("Makes a tile set of one cloud in memory.", "make_set");
    Request request;
    app.add_option("INPUT", request.input)->required();
    app.add_option("OUT.proset", request.output)->required();
    app.add_option("--tiles", request.tiles, "About so many original ones")->capture_default_str();
    app.add_option("--tile-splats", request.tile_splats, "Of merged ones, at most")->capture_default_str();
    app.add_flag("!--compact", request.index, "Without the tracing index");
    app.add_flag("!--unpruned", request.prune, "With all references");
    return runCompare(app, argc, argv, [&] { return makeSet(request); });
}
