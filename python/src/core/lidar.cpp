// SPDX-License-Identifier: Apache-2.0
#include "pointrt/lidar.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "module.h"

namespace nb = nanobind;

namespace pointrt::python {
namespace {

/// Rows of t x y z qx qy qz qw.
using Poses = nb::ndarray<const double, nb::shape<-1, 8>, nb::c_contig, nb::device::cpu>;
constexpr std::size_t kPoseNumbers = 8;

std::vector<LidarPose> posesOf(const Poses& rows) {
    std::vector<LidarPose> poses(rows.shape(0));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const double* n = rows.data() + kPoseNumbers * i;
        poses[i] = {n[0], {n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7]}};
    }
    return poses;
}

/// A NumPy array that owns the numbers.
/// @param wide numbers per row
template <typename Number>
nb::object arrayOf(std::vector<Number> numbers, std::size_t wide = 1) {
    auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
    Number* const data = kept->data();
    const std::size_t shape[] = {kept->size() / wide, wide};
    const nb::capsule owner(kept.release(), [](void* p) noexcept { delete static_cast<std::vector<Number>*>(p); });
    return nb::cast(nb::ndarray<nb::numpy, Number>(data, wide > 1 ? 2 : 1, shape, owner));
}

nb::object rowsOf(const std::vector<LidarPose>& poses) {
    std::vector<double> numbers;
    for (const LidarPose& pose : poses) {
        numbers.push_back(pose.time);
        numbers.insert(numbers.end(), pose.position.begin(), pose.position.end());
        numbers.insert(numbers.end(), pose.rotation.begin(), pose.rotation.end());
    }
    return arrayOf(std::move(numbers), kPoseNumbers);
}

nb::dict arraysOf(LidarPoints points, bool has_tiles) {
    nb::dict arrays;
    arrays["positions"] = arrayOf(std::move(points.positions), 3);
    arrays["times"] = arrayOf(std::move(points.times));
    arrays["ranges"] = arrayOf(std::move(points.ranges));
    arrays["intensities"] = arrayOf(std::move(points.intensities));
    arrays["powers"] = arrayOf(std::move(points.powers));
    arrays["incidences_deg"] = arrayOf(std::move(points.incidences_deg));
    arrays["scan_angles_deg"] = arrayOf(std::move(points.scan_angles_deg));
    arrays["return_numbers"] = arrayOf(std::move(points.return_numbers));
    arrays["numbers_of_returns"] = arrayOf(std::move(points.numbers_of_returns));
    arrays["rings"] = arrayOf(std::move(points.rings));
    arrays["pulses"] = arrayOf(std::move(points.pulses));
    arrays["splat_ids"] = arrayOf(std::move(points.splat_ids));
    arrays["instance_ids"] = arrayOf(std::move(points.instance_ids));
    if (has_tiles) arrays["tile_ids"] = arrayOf(std::move(points.tile_ids));
    return arrays;
}

/// Lets Python handle Ctrl-C between blocks.
void lookForSignals() {
    const nb::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

nb::dict simulate(const TraceScene& scene, const LidarSensorFile& file, const Poses& poses,
                  std::optional<double> start_s, std::optional<double> duration_s, std::uint64_t seed,
                  double metres_per_unit) {
    LidarRun run;
    run.trajectory = posesOf(poses);
    run.start_s = start_s;
    run.duration_s = duration_s;
    run.seed = seed;
    run.metres_per_unit = metres_per_unit;
    LidarPoints all;
    {
        const nb::gil_scoped_release others_go_on;
        simulateLidar(scene, file.sensor, run, [&](const LidarPoints& points) {
            all.append(points);
            lookForSignals();
        });
    }
    return arraysOf(std::move(all), scene.hasTiles());
}

} // namespace

void bindLidar(nb::module_& module) {
    nb::class_<LidarSensorFile>(module, "LidarSensorFile", "The content of a sensor file.")
        .def_prop_ro("poses", [](const LidarSensorFile& file) { return rowsOf(file.trajectory); });
    module.def("read_lidar_sensor", &readLidarSensor, nb::arg("path"));
    module.def(
        "parse_lidar_sensor",
        [](const std::string& text, const std::string& name) { return parseLidarSensor(text, name); }, nb::arg("text"),
        nb::arg("name"));
    module.def(
        "read_lidar_trajectory", [](const std::string& path) { return rowsOf(readLidarTrajectory(path)); },
        nb::arg("path"));
    module.def("lidar_rotation", &lidarRotation, nb::arg("yaw_deg"), nb::arg("pitch_deg"), nb::arg("roll_deg"));
    module.def("simulate_lidar", &simulate, nb::arg("scene"), nb::arg("sensor"), nb::arg("poses"),
               nb::arg("start_s").none(), nb::arg("duration_s").none(), nb::arg("seed"), nb::arg("metres_per_unit"));
}

} // namespace pointrt::python
