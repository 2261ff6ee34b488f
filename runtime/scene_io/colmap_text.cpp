// SPDX-License-Identifier: Apache-2.0
// COLMAP's cameras.txt and images.txt.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/scene_io/colmap_model.h"
#include "runtime/scene_io/list_readers.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

/// Reads numbered lines one by one: every second line of images.txt may contain a megabyte of points.
class Lines {
public:
    explicit Lines(const std::string& path) : path_(path), file_(path) {
        if (!file_) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    }
    bool next(std::string& line) {
        ++number_;
        if (!std::getline(file_, line)) {
            if (file_.bad()) refuse("cannot be read");
            return false;
        }
        if (line.ends_with('\r')) line.pop_back();
        return true;
    }
    /// The next line that is neither empty nor a comment.
    bool nextRow(std::string& line) {
        while (next(line)) {
            const std::size_t first = line.find_first_not_of(" \t");
            if (first != std::string::npos && line[first] != '#') return true;
        }
        return false;
    }
    std::string place() const { return path_ + ":" + std::to_string(number_) + ": "; }
    [[noreturn]] void refuse(const std::string& reason) const { throw Error{ExitCode::kBadInput, place() + reason}; }

private:
    std::string path_;
    std::ifstream file_;
    std::uint64_t number_ = 0;
};

/// The next word of a line, as a number.
template <typename Number>
Number take(std::istringstream& words, const Lines& lines, const char* what) {
    std::string word;
    Number number{};
    if (!(words >> word)) lines.refuse(std::string(what) + " is missing");
    if (!parseNumber(word, number)) lines.refuse(printable(word) + " is not a valid " + what);
    return number;
}

ColmapCameras readTextCameras(const std::string& path) {
    Lines lines(path);
    ColmapCameras cameras;
    for (std::string line; lines.nextRow(line);) {
        std::istringstream words(line);
        const auto id = take<std::uint32_t>(words, lines, "CAMERA_ID");
        std::string model;
        words >> model;
        ColmapCamera camera{colmapModel(model), {}, {}};
        if (!camera.model) lines.refuse(printable(model) + " is not a COLMAP camera model");
        camera.size.width = take<std::uint32_t>(words, lines, "WIDTH");
        camera.size.height = take<std::uint32_t>(words, lines, "HEIGHT");
        for (std::size_t i = 0; i < camera.model->parameters; ++i)
            camera.parameters.push_back(take<double>(words, lines, "parameter of the model"));
        if (!cameras.emplace(id, std::move(camera)).second)
            lines.refuse("camera " + std::to_string(id) + " is defined twice");
    }
    return cameras;
}

ColmapImage imageOf(const std::string& line, const Lines& lines) {
    std::istringstream words(line);
    take<std::uint32_t>(words, lines, "IMAGE_ID");
    ColmapImage image;
    for (double& part : image.rotation) part = take<double>(words, lines, "part of the quaternion");
    for (double& part : image.translation) part = take<double>(words, lines, "part of the translation");
    image.camera = take<std::uint32_t>(words, lines, "CAMERA_ID");
    std::getline(words >> std::ws, image.name);
    if (image.name.empty()) lines.refuse("NAME is missing");
    return image;
}

} // namespace

std::vector<CameraShot> readColmapText(const std::string& images, const std::string& cameras,
                                       const CameraFileRequest&) {
    const ColmapCameras known = readTextCameras(cameras);
    Lines lines(images);
    std::vector<CameraShot> shots;
    for (std::string line; lines.nextRow(line);) {
        try {
            shots.push_back(colmapShot(imageOf(line, lines), known, lines.place()));
        } catch (const std::invalid_argument& error) {
            lines.refuse(error.what());
        }
        lines.next(line); // skips the list of the image's 2D points, which may be empty
    }
    return shots;
}

} // namespace pointrt
