// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/camera_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "format/base/error.h"
#include "runtime/image/image_exr.h"
#include "runtime/image/image_png.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMaxNumber = std::numeric_limits<std::uint16_t>::max();

void writeColors(const std::string& path, const Film& film, const ToneMapping& tone) {
    writePng(path, tonemapFilm(film, tone));
}

void writeAlbedo(const std::string& path, const Film& film, float stops) {
    Film colors;
    colors.width = film.width;
    colors.height = film.height;
    for (std::size_t i = 0; i < film.albedo.size(); i += 3)
        colors.rgba.insert(colors.rgba.end(), {film.albedo[i], film.albedo[i + 1], film.albedo[i + 2], 1});
    writeColors(path, colors, {stops});
}

/// Maps -1 to 1 to 0 to 255; 128 128 128 is the zero vector, no hit.
std::uint8_t directionByte(float component) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(127.5f * component + 127.5f, 0.0f, 255.0f)));
}

void writeNormals(const std::string& path, const Film& film) {
    std::vector<std::uint8_t> bytes(film.normal.size());
    std::transform(film.normal.begin(), film.normal.end(), bytes.begin(), directionByte);
    PngWriter writer(path, {film.width, film.height, 3, 8, false});
    writer.addRows(bytes);
    writer.finish();
}

void writeInstances(const std::string& path, const Film& film) {
    std::vector<std::uint16_t> numbers;
    for (const std::uint32_t id : film.instance_id) // at most 255 instances
        numbers.push_back(id < kMaxNumber ? static_cast<std::uint16_t>(id + 1) : std::uint16_t{0});
    writePng16(path, film.width, numbers);
}

std::uint64_t writeDepths(const std::string& path, const Film& film, const PinholeLens& lens, double unit) {
    std::vector<std::uint16_t> numbers;
    std::uint64_t farther = 0;
    for (std::uint32_t y = 0; y < film.height; ++y)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const float along_ray = film.depth[std::size_t{y} * film.width + x];
            numbers.push_back(depthNumber(along_ray, lens, x, y, unit));
            farther += numbers.back() == 0 && std::isfinite(along_ray) && along_ray > unit;
        }
    writePng16(path, film.width, numbers);
    return farther;
}

/// The folder and suffix of a layer, and its key in transforms.json.
struct LayerFile {
    bool CameraOutput::*member;
    const char *folder, *suffix, *key;
};
constexpr LayerFile kRgb{&CameraOutput::rgb, "rgb", ".png", "file_path"};
constexpr LayerFile kAlbedo{&CameraOutput::albedo, "albedo", ".png", "albedo_file_path"};
constexpr LayerFile kDepth{&CameraOutput::depth, "depth", ".png", "depth_file_path"};
constexpr LayerFile kNormal{&CameraOutput::normal, "normal", ".png", "normal_file_path"};
constexpr LayerFile kInstance{&CameraOutput::instance, "instance", ".png", "instance_file_path"};
constexpr LayerFile kExr{&CameraOutput::exr, "exr", ".exr", "exr_file_path"};
constexpr LayerFile kLayerFiles[] = {kRgb, kAlbedo, kDepth, kNormal, kInstance, kExr};

std::string pathOf(const LayerFile& layer, const std::string& name) {
    return std::string(layer.folder) + "/" + name + layer.suffix;
}

/// The path of a layer's file, in a folder that is created.
std::string readyPath(const CameraFiles& files, const LayerFile& layer, const std::string& name) {
    const fs::path path = fs::path(files.folder) / pathOf(layer, name);
    std::error_code failure;
    fs::create_directories(path.parent_path(), failure);
    if (failure) throw Error{ExitCode::kCannotWrite, path.parent_path().string() + ": " + failure.message()};
    return path.string();
}

} // namespace

std::uint16_t depthNumber(float along_ray, const PinholeLens& lens, std::uint32_t x, std::uint32_t y, double unit) {
    if (!std::isfinite(along_ray)) return 0;
    const double across = (x + 0.5 - lens.cx) / lens.fx, down = (y + 0.5 - lens.cy) / lens.fy;
    const double number = std::round(along_ray / std::sqrt(1 + across * across + down * down) / unit);
    return number <= kMaxNumber ? static_cast<std::uint16_t>(number) : std::uint16_t{0};
}

std::vector<std::pair<std::string, std::string>> fileNames(const CameraOutput& output, const std::string& name) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const LayerFile& layer : kLayerFiles) {
        if (!(output.*layer.member)) continue;
        // file_path is required: without rgb it names the first layer
        if (names.empty()) names.emplace_back(kRgb.key, pathOf(layer, name));
        if (layer.member != kRgb.member) names.emplace_back(layer.key, pathOf(layer, name));
    }
    return names;
}

std::uint64_t writeCameraFiles(const CameraFiles& files, const std::string& name, const PinholeLens& lens,
                               const Film& film) {
    const CameraOutput& output = files.output;
    std::uint64_t farther = 0;
    if (output.rgb) writeColors(readyPath(files, kRgb, name), film, files.tone);
    if (output.albedo) writeAlbedo(readyPath(files, kAlbedo, name), film, files.tone.stops);
    if (output.depth) farther = writeDepths(readyPath(files, kDepth, name), film, lens, files.depth_unit);
    if (output.normal) writeNormals(readyPath(files, kNormal, name), film);
    if (output.instance) writeInstances(readyPath(files, kInstance, name), film);
    if (output.exr) writeExr(readyPath(files, kExr, name), film);
    return farther;
}

} // namespace pointrt
