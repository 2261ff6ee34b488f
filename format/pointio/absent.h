// SPDX-License-Identifier: Apache-2.0
// The error of builds without Rust for formats that need it.
#pragma once

#include <string>

#include "format/base/error.h"

namespace pointrt {

/// Throws Error (kCannotRun). format: "LAZ"
[[noreturn]] inline void refuseWithoutRust(const std::string& format) {
    throw Error(ExitCode::kCannotRun,
                "this build has no " + format +
                    " support: install Rust (Debian 12: cargo-web rustc-web, Debian 13: cargo rustc) and build again");
}

} // namespace pointrt
