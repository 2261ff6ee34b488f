// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_dialog.h"

#include <sstream>
#include <utility>

#include "format/os/find_program.h"

namespace pointrt {

std::vector<std::string> dialogCommand(const std::string& folder, const std::string& search_path,
                                       const std::string& desktop) {
    const std::string zenity = findProgram("zenity", search_path), kdialog = findProgram("kdialog", search_path);
    const bool prefers_kde = desktop.find("KDE") != std::string::npos;
    if (!kdialog.empty() && (prefers_kde || zenity.empty()))
        return {kdialog, "--title", "Open", "--multiple", "--separate-output", "--getopenfilename", folder};
    if (zenity.empty()) return {};
    return {zenity, "--file-selection", "--title=Open", "--multiple", "--separator=\n", "--filename=" + folder + "/"};
}

std::vector<std::string> pathsIn(const std::string& output) {
    std::vector<std::string> paths;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with('/')) paths.push_back(line);
    return paths;
}

std::optional<std::vector<std::string>> FileDialog::result() {
    const std::optional<int> status = child_.waitStatus();
    for (std::string text; !(text = child_.read({})).empty();) output_ += text;
    if (!status) return std::nullopt;
    return *status == 0 ? pathsIn(output_) : std::vector<std::string>();
}

} // namespace pointrt
