// SPDX-License-Identifier: Apache-2.0
// A folder to choose files from, for desktops without a file dialog.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

struct FileBrowser {
    struct Entry {
        std::string name;
        bool is_folder = false; ///< tile sets are folders, too, but are opened as files
        bool chosen = false;
    };
    std::string folder;         ///< absolute
    std::vector<Entry> entries; ///< folders first, in natural order, without hidden files and files that are not scans
    std::string error;          ///< why the folder could not be read; empty: success
};

/// Whether to open a path (a file, or a folder that is a scene or tile set) rather than list it as a folder.
bool isToOpen(const std::string& path);

/// Reads a folder; empty: the current one.
FileBrowser browse(const std::string& folder);

/// The paths of the chosen files.
std::vector<std::string> chosenFiles(const FileBrowser& browser);

} // namespace pointrt
