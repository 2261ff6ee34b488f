// SPDX-License-Identifier: Apache-2.0
#include "format/base/require_pro.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "format/base/error.h"
#include "pointrt/pro_layout.h"

namespace pointrt {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

/// A kind of file that users may pass in place of a .pro file.
struct Kind {
    std::string_view signature, title; ///< first bytes, or suffix
    bool can_bake = true;              ///< advise pointrt-bake, which decides what it can read
};
constexpr std::array kFirstBytes = {Kind{"ply\n"sv, "PLY"},
                                    Kind{"ply\r"sv, "PLY"},
                                    Kind{"# .PCD"sv, "PCD"},
                                    Kind{"VERSION "sv, "PCD"},
                                    Kind{"LASF"sv, "LAS or LAZ"},
                                    Kind{"ASTM-E57"sv, "E57"},
                                    Kind{"DRACO"sv, "Draco"},
                                    Kind{"OFF"sv, "OFF"},
                                    Kind{"\x1f\x8b"sv, "gzip"},
                                    Kind{"glTF"sv, "glTF", false},
                                    Kind{"\x89PNG"sv, "a PNG picture", false},
                                    Kind{"\x76\x2f\x31\x01"sv, "an EXR picture", false},
                                    Kind{"\xff\xd8\xff"sv, "a JPEG picture", false},
                                    Kind{"#?RADIANCE"sv, "a Radiance picture", false},
                                    Kind{"PK\x03\x04"sv, "a ZIP archive", false}};
constexpr std::array kSuffixes = {Kind{".xyz"sv, "points as text"},
                                  Kind{".pts"sv, "points as text"},
                                  Kind{".asc"sv, "points as text"},
                                  Kind{".txt"sv, "text"},
                                  Kind{".csv"sv, "text"},
                                  Kind{".obj"sv, "OBJ"},
                                  Kind{".stl"sv, "STL"},
                                  Kind{".conf"sv, "a set of scans"},
                                  Kind{".toml"sv, "a scene file, which pointrt-view takes", false}};

std::string firstBytes(const std::string& path) {
    std::array<char, 16> bytes{}; // the longest signature has 10
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

bool isProStart(const std::string& bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data(), std::min(sizeof word, bytes.size()));
    return word == PRO_MAGIC_WORD0;
}

std::string lowerSuffix(const fs::path& path) {
    std::string suffix = path.extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suffix;
}

/// Null if unknown.
const Kind* kindOf(const std::string& path, const std::string& bytes) {
    const std::string suffix = lowerSuffix(path);
    const auto first = std::find_if(kFirstBytes.begin(), kFirstBytes.end(),
                                    [&](const Kind& kind) { return bytes.starts_with(kind.signature); });
    if (first != kFirstBytes.end()) return &*first;
    const auto second =
        std::find_if(kSuffixes.begin(), kSuffixes.end(), [&](const Kind& kind) { return suffix == kind.signature; });
    return second == kSuffixes.end() ? nullptr : &*second;
}

/// The .pro name for a scan; "" if it is named .pro already.
std::string proBeside(fs::path path) {
    if (lowerSuffix(path) == ".gz") path.replace_extension();
    if (lowerSuffix(path) == ".pro") return {};
    return path.replace_extension(".pro").string();
}

/// Quoted for a shell; "" if it has control characters or quotes.
std::string shellWord(const std::string& path) {
    constexpr std::string_view kPlain = "_./-+,:@%=";
    const auto plain = [&](unsigned char c) {
        return std::isalnum(c) || c >= 0x80 || kPlain.find(char(c)) != kPlain.npos;
    };
    if (std::any_of(path.begin(), path.end(), [](unsigned char c) { return std::iscntrl(c) || c == '\''; })) return {};
    const std::string word = path.starts_with('-') ? "./" + path : path;
    return std::all_of(word.begin(), word.end(), plain) ? word : "'" + word + "'";
}

std::string bakeCommand(const std::string& path) {
    const std::string scan = shellWord(path), output = shellWord(proBeside(path));
    return "pointrt-bake " + (scan.empty() ? "SCAN" : scan) + " -o " +
           (scan.empty() || output.empty() ? "SCENE.pro" : output);
}

std::string advice(const std::string& path, const Kind* kind, const std::string& aside) {
    if (kind && !kind->can_bake) return {};
    const std::string baked = proBeside(path);
    if (!baked.empty() && beginsAsPro(baked)) return "; did you mean " + baked + "?";
    return std::string(kind ? "; " : "; if it is a scan, ") + "bake it first" + aside + ": " + bakeCommand(path);
}

} // namespace

bool beginsAsPro(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) &&
           isProStart(firstBytes(path)); // opening a pipe would wait for its writer
}

void requirePro(const std::string& path, const std::string& aside) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) throw Error{ExitCode::kBadInput, path + ": is a folder, not a .pro file"};
    if (!fs::is_regular_file(path, ignored) || std::ifstream(path).fail()) return;
    const std::string bytes = firstBytes(path);
    if (isProStart(bytes)) return;
    const Kind* kind = kindOf(path, bytes);
    if (!kind && lowerSuffix(path) == ".pro") return;
    throw Error{ExitCode::kBadInput, path + ": not a .pro file" + (kind ? " but " + std::string(kind->title) : "") +
                                         advice(path, kind, aside)};
}

} // namespace pointrt
