// SPDX-License-Identifier: Apache-2.0
// consume_trace FILE.pro MISSING.pro: a ray onto splat 0 of the tiny scene (tests/format/tiny_scene.h), a pulse of a
// simulated scanner, a picture, then an error.
#include <pointrt/lidar.hpp>
#include <pointrt/render.hpp>
#include <pointrt/studies.hpp>
#include <pointrt/trace.hpp>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 3) return 1;
    const pointrt::TraceDevice device;
    const pointrt::TraceScene scene(device, {argv[1]});
    const std::vector<double> rays{10.5, 20.75, 31, 0, 0, -1};
    std::vector<double> t(1);
    scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
    if (std::abs(t[0] - 0.5) > 1e-5) return 2;
    const auto sensor =
        pointrt::parseLidarSensor("[spinning]\nelevations_deg = [-90]\nrotation_hz = 1\nstep_deg = 360\n"
                                  "[range]\nmax_m = 1\n[pose]\nposition = [10.5, 20.75, 31]\n",
                                  "sensor");
    double range = 0;
    pointrt::simulateLidar(scene, sensor.sensor, {.trajectory = sensor.trajectory},
                           [&](const pointrt::LidarPoints& points) { range = points.ranges.at(0); });
    if (std::abs(range - 0.5) > 1e-5) return 5;
    pointrt::PictureRenderer renderer(device, {argv[1]});
    if (renderer.render(pointrt::LookAt{}, 8, 4, {"depth"}).layer("depth").floats.size() != 32) return 6;
    if (pointrt::sunLights({{80, 0}, {2026, 6, 21}, {2026, 6, 21}, 60, {}}, {}).weights.size() != 24) return 7;
    try {
        pointrt::TraceScene(device, {argv[2]});
    } catch (const pointrt::TraceError& error) {
        return error.kind == pointrt::TraceError::Kind::kBadInput && std::puts("hit") >= 0 ? 0 : 3;
    }
    return 4;
}
