// SPDX-License-Identifier: Apache-2.0
// COLMAP's cameras.bin and images.bin: little-endian, packed.
#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "format/base/error.h"
#include "runtime/scene_io/colmap_model.h"
#include "runtime/scene_io/list_readers.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied from the file without byte swaps");

constexpr std::size_t kPointBytes = 24; ///< x and y as doubles, the id of a 3D point

class Bytes {
public:
    explicit Bytes(const std::string& path) : path_(path), bytes_(readFileBytes(path)) {}

    template <typename Number>
    Number take(const char* what) {
        Number number;
        require(sizeof number, what);
        std::memcpy(&number, bytes_.data() + at_, sizeof number);
        at_ += sizeof number;
        return number;
    }
    std::string takeText(const char* what) {
        const void* const end = std::memchr(bytes_.data() + at_, 0, bytes_.size() - at_);
        if (!end) refuse(std::string("truncated within ") + what);
        std::string text(reinterpret_cast<const char*>(bytes_.data() + at_));
        at_ += text.size() + 1;
        return text;
    }
    void skip(std::uint64_t count, std::size_t each, const char* what) {
        if (count > (bytes_.size() - at_) / each) refuse(std::string("truncated within ") + what);
        at_ += static_cast<std::size_t>(count) * each;
    }
    void requireEnd() const {
        if (at_ != bytes_.size()) refuse("extra bytes at the end");
    }
    std::string place() const { return path_ + ": byte " + std::to_string(at_) + ": "; }
    [[noreturn]] void refuse(const std::string& reason) const { throw Error{ExitCode::kBadInput, place() + reason}; }

private:
    void require(std::size_t count, const char* what) const {
        if (bytes_.size() - at_ < count) refuse(std::string("truncated within ") + what);
    }

    std::string path_;
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

std::uint32_t sideOf(std::uint64_t pixels) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(pixels, UINT32_MAX));
}

ColmapCameras readBinaryCameras(const std::string& path) {
    Bytes bytes(path);
    ColmapCameras cameras;
    const auto count = bytes.take<std::uint64_t>("the number of cameras");
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto id = bytes.take<std::uint32_t>("a camera");
        const auto model = bytes.take<std::int32_t>("a camera");
        ColmapCamera camera{colmapModel(model), {}, {}};
        if (!camera.model) bytes.refuse(std::to_string(model) + " is not a COLMAP camera model");
        camera.size.width = sideOf(bytes.take<std::uint64_t>("a camera"));
        camera.size.height = sideOf(bytes.take<std::uint64_t>("a camera"));
        for (std::size_t p = 0; p < camera.model->parameters; ++p)
            camera.parameters.push_back(bytes.take<double>("a camera"));
        if (!cameras.emplace(id, std::move(camera)).second)
            bytes.refuse("camera " + std::to_string(id) + " is defined twice");
    }
    bytes.requireEnd();
    return cameras;
}

ColmapImage takeImage(Bytes& bytes) {
    bytes.take<std::uint32_t>("an image");
    ColmapImage image;
    for (double& part : image.rotation) part = bytes.take<double>("an image");
    for (double& part : image.translation) part = bytes.take<double>("an image");
    image.camera = bytes.take<std::uint32_t>("an image");
    image.name = bytes.takeText("an image's name");
    bytes.skip(bytes.take<std::uint64_t>("an image"), kPointBytes, "an image's points");
    return image;
}

} // namespace

std::vector<CameraShot> readColmapBinary(const std::string& images, const std::string& cameras,
                                         const CameraFileRequest&) {
    const ColmapCameras known = readBinaryCameras(cameras);
    Bytes bytes(images);
    std::vector<CameraShot> shots;
    const auto count = bytes.take<std::uint64_t>("the number of images");
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string place = bytes.place();
        try {
            shots.push_back(colmapShot(takeImage(bytes), known, place));
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadInput, place + error.what()};
        }
    }
    bytes.requireEnd();
    return shots;
}

} // namespace pointrt
