// SPDX-License-Identifier: Apache-2.0
// Points of a mesh as a scan in random order, so that a bake gains nothing from the order of its input.
#include <algorithm>
#include <bit>
#include <fstream>
#include <numeric>
#include <random>

#include "preprocess/input/read.h"
#include "tests/bench/compare_options.h"

namespace pointrt::test {

namespace {

/// Points relative to the cloud's origin, which floats could not hold.
void writePoints(const std::string& path, const Cloud& cloud, const std::vector<std::uint32_t>& order, bool normals) {
    static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << order.size() << '\n';
    for (const char* name : {"x", "y", "z"}) file << "property float " << name << '\n';
    if (normals)
        for (const char* name : {"nx", "ny", "nz"}) file << "property float " << name << '\n';
    file << "end_header\n";
    for (const std::uint32_t i : order) {
        file.write(reinterpret_cast<const char*>(cloud.positions[i].data()), 3 * sizeof(float));
        if (normals) file.write(reinterpret_cast<const char*>(cloud.normals[i].data()), 3 * sizeof(float));
    }
    if (!file.flush()) throw Error(ExitCode::kCannotWrite, path + ": cannot be written");
}

struct Request {
    std::string mesh, output;
    std::uint64_t count = 0, seed = 1;
    bool normals = false;
};

int makePoints(const Request& request) {
    ReadOptions options;
    options.sample_count = request.count;
    options.seed = request.seed;
    const Cloud cloud = readInputs({request.mesh}, options);
    std::vector<std::uint32_t> order(cloud.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(request.seed));
    writePoints(request.output, cloud, order, request.normals);
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt::test;
    CLI::App app("Samples a mesh into a PLY of points in random order.", "make_points");
    Request request;
    app.add_option("MESH", request.mesh)->required();
    app.add_option("N", request.count, "Points")->required()->check(CLI::Range(1u, 2'000'000'000u));
    app.add_option("OUT.ply", request.output)->required();
    app.add_flag("--normals", request.normals, "Write the surface's normals too");
    app.add_option("--seed", request.seed, "Of points and order");
    return runCompare(app, argc, argv, [&] { return makePoints(request); });
}
