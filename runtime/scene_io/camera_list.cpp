// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/camera_list.h"

#include <array>
#include <filesystem>
#include <stdexcept>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/scene_io/list_readers.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseList(const std::string& reason) { throw Error{ExitCode::kBadInput, reason}; }

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

struct CameraFileKind {
    const char* images;  ///< the file that lists the pictures
    const char* cameras; ///< a second file beside it that lists the lenses; null: none
    std::vector<CameraShot> (*read)(const std::string& images, const std::string& cameras,
                                    const CameraFileRequest& request);
};

constexpr std::array kKinds = {CameraFileKind{"transforms.json", nullptr, readTransforms},
                               CameraFileKind{"images.bin", "cameras.bin", readColmapBinary},
                               CameraFileKind{"images.txt", "cameras.txt", readColmapText}};

std::vector<CameraShot> readKind(const CameraFileKind& kind, const fs::path& file, const CameraFileRequest& request) {
    if (!kind.cameras) return kind.read(file.string(), "", request);
    const fs::path images = file.parent_path() / kind.images, cameras = file.parent_path() / kind.cameras;
    for (const fs::path& each : {images, cameras})
        if (!isThere(each)) refuseList(each.string() + ": No such file or directory; a COLMAP model needs both files");
    return kind.read(images.string(), cameras.string(), request);
}

std::optional<std::vector<CameraShot>> readFolder(const fs::path& folder, const CameraFileRequest& request) {
    for (const CameraFileKind& kind : kKinds)
        if (isThere(folder / kind.images)) return readKind(kind, folder / kind.images, request);
    return std::nullopt;
}

std::vector<CameraShot> readAny(const std::string& path, const CameraFileRequest& request) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) refuseList(path + ": " + (failure ? failure.message() : "No such file or directory"));
    if (fs::is_directory(status)) {
        for (const fs::path& folder : {fs::path(path), fs::path(path) / "sparse" / "0"})
            if (auto shots = readFolder(folder, request)) return std::move(*shots);
        refuseList(path + ": has neither transforms.json nor a COLMAP model (cameras and images, .bin or .txt)");
    }
    const std::string name = fs::path(path).filename().string();
    for (const CameraFileKind& kind : kKinds)
        if (name == kind.images || (kind.cameras && name == kind.cameras)) return readKind(kind, path, request);
    if (name.ends_with(".json")) return readTransforms(path, "", request);
    refuseList(path + ": not a list of cameras; use transforms.json or COLMAP's cameras and images (.bin or .txt)");
}

void requireUsable(const CameraShot& shot, bool drops_distortion) {
    if (shot.size.width < 1 || shot.size.height < 1 || shot.size.width > kMaxPixelSide ||
        shot.size.height > kMaxPixelSide)
        refuseList(shot.place + "picture size " + std::to_string(shot.size.width) + " x " +
                   std::to_string(shot.size.height) + "; each side must be 1 to " + std::to_string(kMaxPixelSide));
    if (!shot.distortion.empty() && !drops_distortion)
        refuseList(shot.place + "the lens has distortion (" + shot.distortion +
                   "), which cannot be rendered; --distortion drop ignores it");
    try {
        pinholeCamera(shot.pose, shot.lens, shot.size);
    } catch (const std::invalid_argument& error) {
        refuseList(shot.place + "the camera of " + printable(shot.name) + ": " + error.what());
    }
}

} // namespace

std::vector<CameraShot> readCameraList(const std::string& path, const CameraFileRequest& request) {
    std::vector<CameraShot> shots = readAny(path, request);
    if (shots.empty()) refuseList(path + ": contains no cameras");
    for (const CameraShot& shot : shots) requireUsable(shot, request.drops_distortion);
    return shots;
}

} // namespace pointrt
