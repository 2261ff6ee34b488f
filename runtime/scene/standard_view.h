// SPDX-License-Identifier: Apache-2.0
// Named views of every scene.
#pragma once

#include <array>

#include "runtime/util/names.h"

namespace pointrt {

enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kIso, kSensor };
inline constexpr std::array kStandardViewNames = {
    Name{"front", StandardView::kFront}, Name{"back", StandardView::kBack},     Name{"left", StandardView::kLeft},
    Name{"right", StandardView::kRight}, Name{"top", StandardView::kTop},       Name{"bottom", StandardView::kBottom},
    Name{"iso", StandardView::kIso},     Name{"sensor", StandardView::kSensor},
};

} // namespace pointrt
