// SPDX-License-Identifier: Apache-2.0
// read_pro SCAN.pro
// Prints the first ten splats of a .pro file. Build it with CMake: find_package(pointrt REQUIRED),
// target_link_libraries(read_pro PRIVATE pointrt::pro) and target_compile_features(read_pro PRIVATE cxx_std_20).
#include <pointrt/pro.hpp>

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) try {
    if (argc != 2) return std::fputs("usage: read_pro SCAN.pro\n", stderr), 2;
    const pointrt::ProFile file(argv[1]); // maps the file and checks every offset in it
    const std::size_t count = file.info().splat_count;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 10); ++i) {
        const pro_splat splat = file.splat(i); // in units of the octree's cube
        const auto [x, y, z] = file.position(splat);
        std::printf("%.3f %.3f %.3f radius %.4f normal %.3f %.3f %.3f\n", x, y, z, file.radius(splat), splat.normal[0],
                    splat.normal[1], splat.normal[2]);
    }
    return 0;
} catch (const pointrt::ProError& error) {
    return std::fprintf(stderr, "read_pro: error: %s\n", error.what()), 1;
}
