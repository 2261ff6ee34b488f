// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/devices/scans.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "format/base/error.h"
#include "tests/support/las_file.h"

namespace pointrt::quality {

namespace {

void writeFile(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
        throw Error(ExitCode::kCannotWrite, path + ": cannot be written");
}

std::string rangeGrid(const GridScan& scan) {
    std::string vertices, grid;
    std::size_t count = 0;
    for (const Vec3d& sample : scan.samples)
        if (isTaken(sample)) {
            vertices += fmt::format("{:.6g} {:.6g} {:.6g}\n", sample.x(), sample.y(), sample.z());
            grid += fmt::format("1 {}\n", count++);
        } else {
            grid += "0\n";
        }
    return fmt::format("ply\nformat ascii 1.0\nobj_info num_cols {}\nobj_info num_rows {}\nelement vertex {}\n"
                       "property float x\nproperty float y\nproperty float z\nelement range_grid {}\n"
                       "property list uchar int vertex_indices\nend_header\n",
                       scan.columns, scan.rows, count, scan.samples.size()) +
           vertices + grid;
}

std::string ptxOf(const GridScan& scan) {
    const Eigen::Matrix4d& pose = scan.world_from_device.matrix();
    std::string text = fmt::format("{}\n{}\n", scan.columns, scan.rows);
    for (const int column : {3, 0, 1, 2}) // the scanner's position, then its axes
        text += fmt::format("{:.6f} {:.6f} {:.6f}\n", pose(0, column), pose(1, column), pose(2, column));
    for (int column = 0; column < 4; ++column) // a row of the file is a column of the matrix
        text += fmt::format("{:.8f} {:.8f} {:.8f} {:.8f}\n", pose(0, column), pose(1, column), pose(2, column),
                            pose(3, column));
    for (std::size_t column = 0; column < scan.columns; ++column)
        for (std::size_t row = scan.rows; row-- > 0;) {
            const Vec3d& sample = scan.samples[row * scan.columns + column];
            text += isTaken(sample) ? fmt::format("{:.4f} {:.4f} {:.4f} 0.5\n", sample.x(), sample.y(), sample.z())
                                    : "0 0 0 0\n";
        }
    return text;
}

} // namespace

void writeConf(const std::string& folder, const std::vector<GridScan>& scans) {
    std::string conf;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const Vec3d place = scans[i].world_from_device.translation();
        const Eigen::Quaterniond turn(scans[i].world_from_device.linear().transpose()); // inverted, as in .conf files
        conf += fmt::format("bmesh scan{}.ply {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", i, place.x(),
                            place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w());
        writeFile(fmt::format("{}/scan{}.ply", folder, i), rangeGrid(scans[i]));
    }
    writeFile(folder + "/scan.conf", conf);
}

void writeOrganizedPcd(const std::string& path, const GridScan& scan) {
    std::string bytes =
        fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                    "COUNT 1 1 1\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
                    scan.columns, scan.rows, scan.samples.size());
    for (const Vec3d& sample : scan.samples) {
        const Vec3f values = sample.cast<float>();
        bytes.append(reinterpret_cast<const char*>(values.data()), 3 * sizeof(float));
    }
    writeFile(path, bytes);
}

void writePtx(const std::string& path, const std::vector<GridScan>& scans) {
    std::string text;
    for (const GridScan& scan : scans) text += ptxOf(scan);
    writeFile(path, text);
}

void writeLas(const std::string& path, const std::vector<Return>& returns) {
    test::LasParts las;
    las.format = 1;
    las.scale = 0.001;
    for (const Return& back : returns) {
        const auto steps = [&](int axis) {
            return static_cast<std::int32_t>(std::lround(back.position[axis] / las.scale));
        };
        std::string point(28, '\0'); // 20 bytes and the time
        for (int axis = 0; axis < 3; ++axis) test::put(point, 4 * static_cast<std::size_t>(axis), steps(axis));
        test::put(point, 14, static_cast<std::uint8_t>(back.number | back.of << 3));
        las.points.push_back(std::move(point));
    }
    writeFile(path, las.bytes());
}

void writePly(const std::string& path, const std::vector<Vec3d>& positions) {
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n",
                                    positions.size());
    for (const Vec3d& position : positions) {
        const Vec3f values = position.cast<float>();
        bytes.append(reinterpret_cast<const char*>(values.data()), 3 * sizeof(float));
    }
    writeFile(path, bytes);
}

} // namespace pointrt::quality
