// SPDX-License-Identifier: GPL-3.0-or-later
// A message of type sensor_msgs/PointCloud2.
#pragma once

#include <string>
#include <vector>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/input/points/ros_message.h"

namespace pointrt {

struct RosCloud {
    RosHeader header;
    std::uint32_t height = 0, width = 0, point_step = 0, row_step = 0;
    std::vector<FieldArray> fields; ///< `first` is null
    std::vector<std::size_t> offsets;
    bool swapped = false;
    std::string_view data;
    std::string packed; ///< the data, if its rows had padding
};

/// Throws Error if the message is malformed.
RosCloud takeRosCloud(const InputFile& input, RosEncoding encoding, std::string_view bytes);

/// Points the fields into the data, and finds out what they are. Throws Error if one lies outside its point.
void placeFields(const InputFile& input, RosCloud& cloud);

} // namespace pointrt
