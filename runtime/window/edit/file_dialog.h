// SPDX-License-Identifier: Apache-2.0
// The desktop's own file dialog, as a program that prints what the user chooses.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "format/os/child_process.h"

namespace pointrt {

/// The command of a dialog for several files that starts in folder: zenity or kdialog, the one of the desktop first.
/// Empty if neither is in search_path. desktop: XDG_CURRENT_DESKTOP
std::vector<std::string> dialogCommand(const std::string& folder, const std::string& search_path,
                                       const std::string& desktop);

/// The paths that a dialog printed, one per line; its other lines are warnings of its toolkit.
std::vector<std::string> pathsIn(const std::string& output);

/// A dialog that is open.
class FileDialog {
public:
    /// Throws std::system_error if command cannot be started.
    explicit FileDialog(const std::vector<std::string>& command) : child_(command) {}

    /// The chosen files once the dialog has closed, none if it was cancelled. Does not wait.
    std::optional<std::vector<std::string>> result();

private:
    ChildProcess child_;
    std::string output_;
};

} // namespace pointrt
