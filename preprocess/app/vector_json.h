// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "preprocess/cloud/bounds.h"

namespace pointrt {

inline nlohmann::ordered_json vectorJson(const Vec3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

} // namespace pointrt
