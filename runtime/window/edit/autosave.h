// SPDX-License-Identifier: Apache-2.0
// A copy of the edited scene, for the case that the program ends before it is saved.
#pragma once

#include <string>

#include "format/os/file_lock.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The autosave of one open scene. Each scene has up to ten, one for each program that has it open; a lock says which
/// are in use. Without a folder that can be written nothing is saved.
class Autosave {
public:
    /// folder: of autosaves; "" for none. scene: path that the scene is known by.
    Autosave(const std::string& folder, const std::string& scene);
    /// Keeps the file.
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Path of the scene file with unsaved edits from a session that crashed; empty if there is none.
    const std::string& left() const { return left_; }
    /// Where write puts the scene; empty if nowhere.
    const std::string& path() const { return path_; }
    /// Throws Error as writeSceneFile does.
    void write(const SceneDescription& scene);
    /// Deletes the file: the edits are saved, or not wanted.
    void discard();

private:
    bool take(const std::string& path);

    std::string path_; ///< "": none could be taken
    std::string left_;
    format::FileLock lock_;
};

} // namespace pointrt
