// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// How lists present a part of a scene: an instance, a shape, a light, a clip or a measurement.
struct Layer {
    std::string name;    ///< empty: named by its kind and number
    bool locked = false; ///< the window does not edit or delete it
    bool operator==(const Layer&) const = default;
};

} // namespace pointrt
