// SPDX-License-Identifier: Apache-2.0
// The forms that a frame's passes may have. A film is gone on with in the form that it was begun in.
#pragma once

#include <optional>

namespace pointrt {

enum class PassForm {
    kQueued, ///< every step a pass of its own: what paths are goes through memory between them
    kFused,  ///< paths stay in registers from hit to hit, until instances are to be asked
};

/// A form that is wanted whatever the device is; none: what suits it.
using FormRequest = std::optional<PassForm>;

} // namespace pointrt
