// SPDX-License-Identifier: Apache-2.0
// Attributes, sensors, up and units for the tiny scene: one attribute of each kind that a reader could get wrong.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tiny_index.h"

namespace pointrt::test {

struct TinyScan {
    pro_world world{};
    std::array<double, 8> sensors{1.5, -2.5, 1e6, 1, 0, 0, 0, 0}; ///< two scans, the second without a known sensor
    std::array<std::uint16_t, 5> intensity{0, 65535, 7, 300, 12};
    std::array<std::uint8_t, 5> classification{2, 2, 6, 5, 2};
    std::array<double, 5> gps_time{1e9 + 0.25, std::numeric_limits<double>::quiet_NaN(), 3, -4.5, 5};
    std::array<std::uint16_t, 15> rgb16{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 65535};
    std::array<std::int64_t, 5> wide{std::numeric_limits<std::int64_t>::min(), 0, 1, 2, -3};
    std::vector<pro_attribute> attributes;
    const pro_sampling* sampling = nullptr;
    bool indexed = true;

    TinyScan() {
        world.up[2] = 1;
        world.metres_per_unit = 0.3048;
        world.sensor_count = 2;
        world.sensors = sensors.data();
        add("intensity", PRO_TYPE_U16, 1, intensity.data());
        add("classification", PRO_TYPE_U8, 1, classification.data());
        add("gps_time", PRO_TYPE_F64, 1, gps_time.data());
        add("rgb16", PRO_TYPE_U16, 3, rgb16.data());
        add("größe in einer Einheit, 31 By", PRO_TYPE_I64, 1, wide.data());
    }
    TinyScan(const TinyScan&) = delete;

    void add(std::string_view name, std::uint32_t type, std::uint32_t components, const void* values) {
        pro_attribute attribute{};
        name.copy(attribute.name, PRO_ATTRIBUTE_NAME_MAX);
        attribute.type = type;
        attribute.components = components;
        attribute.values = values;
        attributes.push_back(attribute);
    }

    pro_result write(Scene& scene, const std::string& path, pro_message* message = nullptr) {
        const pro_view view = scene.view();
        Index index = tinyIndex();
        const pro_index pointers = index.view();
        const pro_content content{&scene.info,
                                  &view,
                                  indexed ? &pointers : nullptr,
                                  &world,
                                  attributes.data(),
                                  static_cast<std::uint32_t>(attributes.size()),
                                  sampling};
        return pro_write_content(path.c_str(), &content, 1, message);
    }
};

} // namespace pointrt::test
