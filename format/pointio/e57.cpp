// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/e57.h"

#include "format/pointio/bytes.h"
#include "format/pointio/rust_abi.h"

namespace pointrt {
namespace {

std::optional<E57Limits> limitsOf(const scan_e57_limits& limits) {
    if (!limits.are_there) return std::nullopt;
    return E57Limits{limits.least, limits.most};
}

E57Column columnOf(const scan_e57_column& column) {
    return {column.name, static_cast<E57Kind>(column.kind), column.least, column.most, column.scale, column.offset};
}

E57Scan scanOf(const scan_e57_scan& facts) {
    E57Scan scan;
    scan.name = facts.name;
    scan.guid = facts.guid;
    scan.points = facts.points;
    scan.has_pose = facts.has_pose;
    for (std::size_t i = 0; i < facts.column_count; ++i) scan.columns.push_back(columnOf(facts.columns[i]));
    for (std::size_t i = 0; i < 4; ++i) scan.rotation[i] = facts.rotation[i];
    for (std::size_t i = 0; i < 3; ++i) {
        scan.translation[i] = facts.translation[i];
        scan.color_limits[i] = limitsOf(facts.color_limits[i]);
    }
    scan.intensity_limits = limitsOf(facts.intensity_limits);
    return scan;
}

} // namespace

bool hasE57() { return true; }

void CloseE57::operator()(scan_e57* file) const { scan_e57_close(file); }
void CloseE57::operator()(scan_e57_points* points) const { scan_e57_end(points); }

E57File openE57(std::string_view bytes) {
    scan_error error;
    E57File file;
    file.handle.reset(scan_e57_open(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &error));
    if (!file.handle) refuseFile(error.text);
    for (std::size_t i = 0; i < scan_e57_scans(file.handle.get()); ++i)
        file.scans.push_back(scanOf(scan_e57_describe(file.handle.get(), i)));
    file.images = scan_e57_images(file.handle.get());
    file.coordinate_metadata = scan_e57_coordinate_metadata(file.handle.get());
    return file;
}

E57Points e57Points(const E57File& file, std::size_t scan) {
    scan_error error;
    E57Points points;
    points.handle.reset(scan_e57_begin(file.handle.get(), scan, &error));
    if (!points.handle) refuseFile(error.text);
    return points;
}

std::size_t readE57Points(E57Points& points, std::size_t capacity, void* const* columns) {
    scan_error error;
    std::size_t count = 0;
    if (!scan_e57_read(points.handle.get(), capacity, columns, &count, &error)) refuseFile(error.text);
    return count;
}

std::uint64_t e57Position(const E57Points& points) { return scan_e57_position(points.handle.get()); }

} // namespace pointrt
