// SPDX-License-Identifier: Apache-2.0
// gaussian_oracle FILE.ply|FILE.pro --eye X,Y,Z ... -o OUT.pfm: the picture that pointrt-view must render of a file of
// Gaussians, by brute force in double precision.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "format/base/run_tool.h"
#include "tests/gaussians/float_picture.h"
#include "tests/gaussians/gaussian_ply.h"
#include "tests/gaussians/gaussian_pro.h"
#include "tests/gaussians/oracle_picture.h"

namespace pointrt::test {

namespace {

struct Request {
    std::string input, output, size = "512x512";
    OracleView view;
    PictureOptions picture;
    bool layers = false, never_stops = false, culls_nothing = false;
};

void addVector(CLI::App& app, const char* name, Double3& vector, const char* help, const char* type = "X,Y,Z") {
    app.add_option(name, vector, help)->delimiter(',')->type_name(type);
}

void addOptions(CLI::App& app, Request& request) {
    app.add_option("FILE", request.input, "Gaussians: a .ply of a training program, or a .pro")->required();
    app.add_option("-o,--output", request.output, "Display-encoded picture, OUT.pfm")->required();
    addVector(app, "--eye", request.view.eye, "Camera position (default 0,0,4)");
    addVector(app, "--target", request.view.target, "Point to look at (default 0,0,0)");
    addVector(app, "--up", request.view.up, "Up direction of the picture (default 0,1,0)");
    app.add_option("--fov", request.view.fov_deg, "Vertical field of view in degrees (default 40)");
    app.add_option("--size", request.size, "Width and height in pixels (default 512x512)")->type_name("WxH");
    addVector(app, "--background", request.picture.background, "Display-encoded colour behind (default 0,0,0)",
              "R,G,B");
    app.add_option("--spp", request.picture.spp,
                   "Samples per pixel, placed as pointrt-view places them; 1 is through the centre (default 1)")
        ->check(CLI::Range(1u, 65536u));
    app.add_option("--seed", request.picture.seed, "Random seed of the samples' places (default 0)");
    app.add_flag("--layers", request.layers,
                 "Also write OUT_depth.pfm, OUT_transmittance.pfm, OUT_count.pfm and OUT_strongest.u32 (32-bit "
                 "indices, top row first, 4294967295 for none) of the rays through pixel centres");
    app.add_flag("--never-stop", request.never_stops, "Composite all Gaussians, even behind opaque ones");
    app.add_flag("--no-culling", request.culls_nothing, "Test every Gaussian for every ray: slow");
}

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

OracleScene readScene(const std::string& path) {
    return oracleScene(endsWith(path, ".pro") ? readGaussianPro(path) : readGaussianPly(path));
}

OracleCamera cameraOf(const Request& request) {
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(request.size.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width == 0 || height == 0)
        throw Error(ExitCode::kBadUsage, "--size: must be WxH, as 640x480");
    return lookAt(request.view, width, height);
}

/// A grey picture of a value of each pixel's composite.
template <typename Value>
FloatPicture layerOf(const OraclePicture& picture, const Value& value) {
    FloatPicture layer{picture.width, picture.height, 1, {}};
    for (const OracleComposite& each : picture.centers) layer.values.push_back(static_cast<float>(value(each)));
    return layer;
}

FloatPicture colorsOf(const OraclePicture& picture) {
    FloatPicture colors{picture.width, picture.height, 3, {}};
    for (const Double3& each : picture.colors)
        for (const double channel : each) colors.values.push_back(static_cast<float>(channel));
    return colors;
}

void writeStrongest(const std::string& path, const OraclePicture& picture) {
    std::ofstream file(path, std::ios::binary);
    for (const OracleComposite& each : picture.centers)
        file.write(reinterpret_cast<const char*>(&each.strongest), sizeof(each.strongest));
    if (!file.flush()) throw Error(ExitCode::kCannotWrite, path + ": cannot be written");
}

void writeLayers(const std::string& stem, const OraclePicture& picture) {
    writePfm(stem + "_depth.pfm", layerOf(picture, [](const OracleComposite& each) { return each.depth; }));
    writePfm(stem + "_transmittance.pfm",
             layerOf(picture, [](const OracleComposite& each) { return each.transmittance; }));
    writePfm(stem + "_count.pfm", layerOf(picture, [](const OracleComposite& each) { return each.counted; }));
    writeStrongest(stem + "_strongest.u32", picture);
}

void report(const OracleScene& scene, const OraclePicture& picture, double seconds) {
    std::uint64_t counted = 0;
    for (const OracleComposite& each : picture.centers) counted += each.counted;
    std::printf("%zu Gaussians, %.1f composited per ray, %.1f s\n", scene.gaussians.size(),
                static_cast<double>(counted) / static_cast<double>(picture.centers.size()), seconds);
}

int render(Request request) {
    if (!endsWith(request.output, ".pfm")) throw Error(ExitCode::kBadUsage, "-o: must end with .pfm");
    if (request.never_stops) request.picture.stop_below = kNeverStop;
    request.picture.culls = !request.culls_nothing;
    const OracleCamera camera = cameraOf(request);
    const OracleScene scene = readScene(request.input);
    const auto start = std::chrono::steady_clock::now();
    const OraclePicture picture = renderPicture(scene, camera, request.picture);
    report(scene, picture, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    writePfm(request.output, colorsOf(picture));
    if (request.layers) writeLayers(request.output.substr(0, request.output.size() - 4), picture);
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt;
    CLI::App app("Renders Gaussians by brute force in double precision.", "gaussian_oracle");
    test::Request request;
    test::addOptions(app, request);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kBadUsage);
    }
    return runTool("gaussian_oracle", [&] { return test::render(request); });
}
