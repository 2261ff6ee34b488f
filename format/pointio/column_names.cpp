// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/column_names.h"

namespace pointrt {
namespace {

std::string asWord(std::string name, const std::string& separators) {
    for (char& letter : name) {
        const bool is_blank = (static_cast<unsigned char>(letter) <= ' ') || letter == 0x7f;
        if (is_blank || separators.find(letter) != std::string::npos) letter = '_';
    }
    return name;
}

} // namespace

std::vector<std::string> componentNames(const PointColumn& column, const std::string& separators) {
    if (column.role == PointRole::kNormal) return {"nx", "ny", "nz"};
    if (column.role == PointRole::kRadius) return {"radius"};
    if (column.role == PointRole::kColor) return {"red", "green", "blue"};
    const std::string name = asWord(column.name, separators);
    if (column.components == 1) return {name};
    std::vector<std::string> names;
    for (std::uint32_t c = 0; c < column.components; ++c) names.push_back(name + "_" + std::to_string(c));
    return names;
}

} // namespace pointrt
