// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/geo_reference.h"

#include <charconv>
#include <filesystem>

namespace pointrt {
namespace {

/// The shortest text that gives the same number.
std::string line(double number) {
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, number).ptr) + "\n";
}

} // namespace

std::string worldFileText(const GeoReference& place) {
    return line(place.pixel) + line(0) + line(0) + line(-place.pixel) + line(place.west + place.pixel / 2) +
           line(place.north - place.pixel / 2);
}

std::string worldFilePath(const std::string& png_path) {
    return std::filesystem::path(png_path).replace_extension(".pgw").string();
}

} // namespace pointrt
