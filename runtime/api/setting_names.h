// SPDX-License-Identifier: Apache-2.0
// Errors of the viewer name command line options; callers of the library know settings.
#pragma once

#include <string>

#include "format/base/error.h"

namespace pointrt {

/// The message with options named as settings: "color_map: needs color_by" for "--color-map: needs --color-by". Dashes
/// within a word, as in a file's name, stay.
std::string withSettingNames(const std::string& message);

/// Returns act(). Rethrows Error with withSettingNames.
template <typename Act>
auto namingSettings(const Act& act) {
    try {
        return act();
    } catch (const Error& error) {
        throw Error{error.code, withSettingNames(error.what())};
    }
}

} // namespace pointrt
