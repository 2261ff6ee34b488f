// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/carry_attributes.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "format/base/printable.h"

namespace pointrt {
namespace {

static_assert(static_cast<int>(Scalar::kI8) + 1 == PRO_TYPE_I8 && static_cast<int>(Scalar::kF64) + 1 == PRO_TYPE_F64,
              "types of attributes are numbered as those of the file");

/// Not within a character: bytes 10xxxxxx continue one.
std::string cutTo(std::string name, std::size_t bytes) {
    if (name.size() <= bytes) return name;
    while (bytes > 0 && (static_cast<unsigned char>(name[bytes]) & 0xC0) == 0x80) --bytes;
    name.resize(bytes);
    return name;
}

/// A name that a file can hold, and that is not taken.
std::string fittingName(const std::string& name, const std::set<std::string>& taken) {
    const std::string plain = name.empty() ? "unnamed" : printable(name, std::string::npos);
    std::string fitting = cutTo(plain, PRO_ATTRIBUTE_NAME_MAX);
    for (int number = 2; taken.contains(fitting); ++number) {
        const std::string suffix = "_" + std::to_string(number);
        fitting = cutTo(plain, PRO_ATTRIBUTE_NAME_MAX - suffix.size()) + suffix;
    }
    return fitting;
}

template <std::size_t kSize>
void gatherFixed(const Attribute& from, const std::vector<std::uint32_t>& indices, char* to) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, indices.size()), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            std::memcpy(to + i * kSize, from.values.data() + std::size_t{indices[i]} * kSize, kSize);
    });
}

void gatherAny(const Attribute& from, const std::vector<std::uint32_t>& indices, char* to) {
    const std::size_t size = from.bytesEach();
    for (std::size_t i = 0; i < indices.size(); ++i)
        std::memcpy(to + i * size, from.values.data() + indices[i] * size, size);
}

void gather(const Attribute& from, const std::vector<std::uint32_t>& indices, char* to) {
    switch (from.bytesEach()) {
    case 1:
        return gatherFixed<1>(from, indices, to);
    case 2:
        return gatherFixed<2>(from, indices, to);
    case 4:
        return gatherFixed<4>(from, indices, to);
    case 8:
        return gatherFixed<8>(from, indices, to);
    default:
        return gatherAny(from, indices, to);
    }
}

} // namespace

void fitAttributes(Cloud& cloud) {
    const std::string file = cloud.scans.empty() ? "" : cloud.scans.front().name;
    if (cloud.attributes.size() > PRO_ATTRIBUTE_MAX) {
        cloud.notes.push_back({file, "has " + std::to_string(cloud.attributes.size()) + " attributes; the first " +
                                         std::to_string(PRO_ATTRIBUTE_MAX) + " are kept, --attributes chooses others"});
        cloud.attributes.resize(PRO_ATTRIBUTE_MAX);
    }
    std::set<std::string> taken;
    for (Attribute& attribute : cloud.attributes) {
        const std::string name = fittingName(attribute.name, taken);
        if (name != attribute.name)
            cloud.notes.push_back({file, "attribute '" + printable(attribute.name, 80) + "' is called '" + name + "'"});
        attribute.name = name;
        taken.insert(name);
    }
}

std::vector<Attribute> carryAttributes(std::vector<Attribute>& attributes,
                                       const std::vector<std::uint32_t>& input_index) {
    std::vector<Attribute> carried;
    for (Attribute& attribute : attributes) {
        Attribute& to = carried.emplace_back(Attribute{attribute.name, attribute.type, attribute.components, {}});
        to.values.resize(input_index.size() * attribute.bytesEach());
        gather(attribute, input_index, to.values.data());
        std::vector<char>().swap(attribute.values);
    }
    return carried;
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
