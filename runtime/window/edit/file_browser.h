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
    std::string error;          ///< why the folder cannot be read; empty: it was
};

/// Whether a path is a file to open, or a scene or tile set that is a folder: not a folder to list.
bool isToOpen(const std::string& path);

/// Reads a folder; empty: the current one.
FileBrowser browse(const std::string& folder);

/// The paths of the chosen files.
std::vector<std::string> chosenFiles(const FileBrowser& browser);

} // namespace pointrt
