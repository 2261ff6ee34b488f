// SPDX-License-Identifier: Apache-2.0
// The time to trace in a frame while the view moves, from the refresh rate of the display.
#pragma once

#include <optional>

namespace pointrt {

/// A frame lasts one refresh of the display if the device traces enough of the picture in that time. Otherwise it lasts
/// as many refreshes as still give 30 frames per second.
class PreviewBudget {
public:
    /// Seconds to trace in the next frame.
    /// @param display_hz none: as if the display had 60 Hz and the device were slow
    /// @param picture_s predicted time to trace all of the picture; infinity for a device that is always slow
    double next(std::optional<double> display_hz, double picture_s);

private:
    bool each_refresh_ = false;
};

} // namespace pointrt
