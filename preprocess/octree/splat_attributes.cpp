// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/splat_attributes.h"

#include <algorithm>
#include <set>
#include <span>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "format/base/printable.h"
#include "format/base/unique_name.h"
#include "preprocess/cloud/gather.h"

namespace pointrt {
namespace {

static_assert(static_cast<int>(Scalar::kI8) + 1 == PRO_TYPE_I8 && static_cast<int>(Scalar::kF64) + 1 == PRO_TYPE_F64,
              "Scalar and PRO_TYPE_* have the same order");

/// A valid and unused name for the file.
std::string fittingName(const std::string& name, const std::set<std::string>& taken) {
    const std::string plain = name.empty() ? "unnamed" : printable(name, std::string::npos);
    return uniqueName(plain, PRO_ATTRIBUTE_NAME_MAX, [&](const std::string& each) { return taken.contains(each); });
}

void gather(const Attribute& from, std::span<const std::uint32_t> indices, char* to) {
    const std::size_t size = from.bytesEach();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, indices.size()), [&](const auto& range) {
        gatherValues(from.values.data(), size, indices.subspan(range.begin(), range.size()), to + range.begin() * size);
    });
}

} // namespace

void fitAttributes(Cloud& cloud) {
    const std::string file = cloud.scans.empty() ? "" : cloud.scans.front().name;
    if (cloud.attributes.size() > PRO_ATTRIBUTE_MAX) {
        cloud.notes.push_back({file, "has " + std::to_string(cloud.attributes.size()) + " attributes; the first " +
                                         std::to_string(PRO_ATTRIBUTE_MAX) +
                                         " are kept; choose others with --attributes"});
        cloud.attributes.resize(PRO_ATTRIBUTE_MAX);
    }
    std::set<std::string> taken;
    for (Attribute& attribute : cloud.attributes) {
        const std::string name = fittingName(attribute.name, taken);
        if (name != attribute.name)
            cloud.notes.push_back(
                {file, "attribute '" + printable(attribute.name, 80) + "' is renamed to '" + name + "'"});
        attribute.name = name;
        taken.insert(name);
    }
}

std::vector<std::uint32_t> sourcePoints(const PackedSplats& splats) {
    std::vector<std::uint32_t> points = splats.input_index;
    if (splats.filled == 0) return points;
    for (std::uint32_t& point : points)
        if (point >= splats.input_count) point = splats.filled_from[point - splats.input_count];
    return points;
}

std::vector<Attribute> gatherAttributes(std::vector<Attribute>& attributes,
                                        const std::vector<std::uint32_t>& point_of_splat) {
    std::vector<Attribute> gathered;
    for (Attribute& attribute : attributes) {
        Attribute& to = gathered.emplace_back(Attribute{attribute.name, attribute.type, attribute.components, {}});
        to.values.resize(point_of_splat.size() * attribute.bytesEach());
        gather(attribute, point_of_splat, to.values.data());
        std::vector<char>().swap(attribute.values);
    }
    return gathered;
}

std::vector<pro_attribute> attributeViews(const std::vector<Attribute>& attributes) {
    std::vector<pro_attribute> views;
    for (const Attribute& attribute : attributes) {
        pro_attribute& view = views.emplace_back(pro_attribute{});
        attribute.name.copy(view.name, PRO_ATTRIBUTE_NAME_MAX);
        view.type = static_cast<std::uint32_t>(attribute.type) + 1;
        view.components = attribute.components;
        view.values = attribute.values.data();
    }
    return views;
}

std::vector<double> sensorRows(const std::vector<Scan>& scans) {
    std::vector<double> rows;
    bool known = false;
    for (const Scan& scan : scans) {
        const Vec3d place = scan.sensor.value_or(Vec3d::Zero());
        rows.insert(rows.end(), {place.x(), place.y(), place.z(), scan.sensor ? 1.0 : 0.0});
        known |= scan.sensor.has_value();
    }
    return known ? rows : std::vector<double>();
}

} // namespace pointrt
