// SPDX-License-Identifier: Apache-2.0
// The viewer's errors name command line options; callers of the library know them as settings.
#pragma once

#include <string>

#include "format/base/error.h"

namespace pointrt {

/// The message with options named as settings: "color_map: needs color_by" for "--color-map: needs --color-by". Keeps
/// dashes within a word, such as a file's name.
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
