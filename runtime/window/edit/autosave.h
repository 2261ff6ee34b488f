// SPDX-License-Identifier: Apache-2.0
// A copy of the edited scene, in case the program ends before the user saves the scene.
#pragma once

#include <string>

#include "format/os/file_lock.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The autosave of one open scene. A scene has up to ten, one for each program that has the scene open; locks mark the
/// autosaves in use. Nothing is saved if the folder is not writable.
class Autosave {
public:
    /// folder: of autosaves; "" for none. scene: the path by which users know the scene.
    Autosave(const std::string& folder, const std::string& scene);
    /// Does not delete the file.
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Path of the scene file with unsaved edits from a session that crashed; empty if there is none.
    const std::string& left() const { return left_; }
    /// The path that write uses; empty: none.
    const std::string& path() const { return path_; }
    /// Throws Error as writeSceneFile does.
    void write(const SceneDescription& scene);
    /// Deletes the file: the edits are saved, or not wanted.
    void discard();

private:
    bool take(const std::string& path);

    std::string path_; ///< "": none was available
    std::string left_;
    format::FileLock lock_;
};

} // namespace pointrt
