// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/notes.h"

namespace pointrt {

void addNote(Cloud& cloud, const std::string& file, const std::string& text) {
    for (Note& note : cloud.notes) {
        if (note.text != text) continue;
        note.more_files += note.file != file;
        return;
    }
    cloud.notes.push_back({file, text});
}

} // namespace pointrt
