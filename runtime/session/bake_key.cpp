// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/bake_key.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

#include "format/base/error.h"
#include "format/os/folder.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// Change this if bakes by earlier programs must no longer be used.
constexpr std::uint64_t kKeyVersion = 1;

/// As deep as pointrt-bake searches folders.
constexpr int kDeepest = 16;

/// Formats whose files hold the whole scan.
constexpr std::array<std::string_view, 24> kSelfContained = {
    ".las", ".laz", ".e57", ".pcd", ".ptx", ".xyz", ".pts", ".asc",  ".txt", ".csv", ".off", ".stl",
    ".vtk", ".vtp", ".vtu", ".drc", ".glb", ".npy", ".npz", ".mcap", ".bag", ".spz", ".sog", ".splat"};

struct Cancelled {};

class Hash {
public:
    explicit Hash(const std::function<bool()>& cancelled) : state_(XXH3_createState()), cancelled_(cancelled) {
        XXH3_128bits_reset(state_.get());
    }

    void addNumber(std::uint64_t number) { addBytes(&number, sizeof number); }
    void addText(const std::string& text) {
        addNumber(text.size());
        addBytes(text.data(), text.size());
    }

    void addFile(const std::string& path) {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
        if (!file) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
        std::uint64_t size = 0;
        while (const std::size_t count = std::fread(buffer_.data(), 1, buffer_.size(), file.get())) {
            if (cancelled_()) throw Cancelled{};
            addBytes(buffer_.data(), count);
            size += count;
        }
        if (std::ferror(file.get())) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
        addNumber(size);
    }

    /// Adds properties that change when a file does, without reading it.
    void addStamp(const fs::path& path) {
        std::error_code unknown;
        addNumber(fs::file_size(path, unknown));
        addNumber(static_cast<std::uint64_t>(fs::last_write_time(path, unknown).time_since_epoch().count()));
    }

    std::string digits() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        std::array<char, 40> text{};
        std::snprintf(text.data(), text.size(), "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
        return text.data();
    }

private:
    void addBytes(const void* bytes, std::size_t count) { XXH3_128bits_update(state_.get(), bytes, count); }

    struct FreeState {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, FreeState> state_;
    const std::function<bool()>& cancelled_;
    std::vector<char> buffer_ = std::vector<char>(std::size_t{1} << 20); // large enough for the disk's full speed
};

std::string lowerSuffix(const fs::path& path) {
    std::string suffix = path.extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suffix;
}

/// Whether a file was written by pointrt itself, beside scans or anywhere else.
bool isOurs(const fs::path& path) {
    const std::string suffix = lowerSuffix(path);
    return suffix == ".pro" || suffix == ".proset" || suffix == ".toml" || suffix == ".exr";
}

/// Files in folder and, up to depth, in its subfolders, without hidden ones, in a fixed order.
void listFiles(const fs::path& folder, int depth, std::vector<fs::path>& files) {
    std::error_code error;
    for (const fs::path path : listFolder(folder.string(), error)) {
        std::error_code gone;
        if (path.filename().string().starts_with('.') || isOurs(path)) continue;
        if (fs::is_regular_file(path, gone)) files.push_back(path);
        if (depth > 0 && fs::symlink_status(path, gone).type() == fs::file_type::directory)
            listFiles(path, depth - 1, files);
    }
    if (error) throw Error{ExitCode::kBadInput, folder.string() + ": " + error.message()};
    std::sort(files.begin(), files.end());
}

/// Whether the texts of a PLY may name textures: only "comment TextureFile" lines refer to files.
bool namesTextures(const std::string& path) {
    constexpr std::size_t kHeader = 4096; // comments are in the first lines
    std::string header(kHeader, '\0');
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (file) header.resize(std::fread(header.data(), 1, header.size(), file.get()));
    return header.find("TextureFile") != std::string::npos;
}

bool isSelfContained(const std::string& path) {
    const std::string suffix = lowerSuffix(path);
    if (suffix == ".ply") return !namesTextures(path);
    return std::find(kSelfContained.begin(), kSelfContained.end(), suffix) != kSelfContained.end();
}

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void addSurroundings(Hash& hash, const fs::path& file) {
    const fs::path folder = folderOf(file);
    std::vector<fs::path> files;
    listFiles(folder, 1, files);
    for (const fs::path& each : files) {
        hash.addText(each.lexically_relative(folder).string());
        hash.addStamp(each);
    }
}

void addScan(Hash& hash, const std::string& scan) {
    std::error_code error;
    const fs::file_status status = fs::status(scan, error);
    if (!fs::exists(status)) throw Error{ExitCode::kBadInput, scan + ": No such file or directory"};
    hash.addText(fs::path(scan).filename().string());
    if (!fs::is_directory(status)) {
        if (!fs::is_regular_file(status)) throw Error{ExitCode::kBadInput, scan + ": not a regular file"};
        hash.addFile(scan);
        return isSelfContained(scan) ? void() : addSurroundings(hash, scan);
    }
    std::vector<fs::path> files;
    listFiles(scan, kDeepest, files);
    for (const fs::path& file : files) {
        hash.addText(file.lexically_relative(scan).string());
        hash.addFile(file.string());
    }
}

/// Total sizes of the scans' files and of those that they may refer to.
struct ScanBytes {
    double packed = 0; ///< bytes in LAZ files
    double others = 0;
};

ScanBytes scanBytes(const std::vector<std::string>& scans) {
    ScanBytes bytes;
    std::error_code unknown;
    for (const std::string& scan : scans) {
        const bool is_folder = fs::is_directory(scan, unknown);
        std::vector<fs::path> files{scan};
        if (is_folder || !isSelfContained(scan)) {
            files.clear();
            listFiles(is_folder ? fs::path(scan) : folderOf(scan), is_folder ? kDeepest : 1, files);
        }
        for (const fs::path& file : files) {
            const std::uintmax_t size = fs::file_size(file, unknown);
            if (!unknown) (lowerSuffix(file) == ".laz" ? bytes.packed : bytes.others) += static_cast<double>(size);
        }
    }
    return bytes;
}

void addOption(Hash& hash, const std::string& option) {
    std::error_code ignored;
    hash.addText(option);
    const std::string value = option.starts_with("--") ? option.substr(option.find('=') + 1) : option;
    if (fs::is_regular_file(value, ignored)) hash.addFile(value);
}

} // namespace

std::optional<ScanBake> quickBake(const ScanBake& bake) {
    constexpr double kSmall = 256 << 10; // about 50,000 points in LAZ
    // bytes per point: 5 in LAZ, 34 in LAS, 12 to 40 in text
    constexpr double kBytesPerPackedPoint = 5, kBytesPerPoint = 10;
    constexpr double kPoints = 50'000, kFewest = 10;
    constexpr double kUnpacked = 2e6; // bytes read in half a second, on two cores
    const ScanBytes bytes = scanBytes(bake.scans);
    if (bytes.packed + bytes.others < kSmall) return std::nullopt;
    const double packed = bytes.packed / kBytesPerPackedPoint;
    const double share = std::min(1.0, kUnpacked / std::max(packed, 1.0));
    const double points = share * packed + bytes.others / kBytesPerPoint;
    const auto every = static_cast<std::uint64_t>(std::max(kFewest, points / kPoints));
    ScanBake quick{bake.scans, {"--every", std::to_string(every), "--clean", "off", "--prune", "off"}};
    if (share < 1) quick.options.insert(quick.options.end(), {"--skim", plainText(share)});
    quick.options.insert(quick.options.end(), bake.options.begin(), bake.options.end());
    return quick;
}

std::string bakeKey(const ScanBake& bake, const std::string& tool, const std::function<bool()>& cancelled) {
    try {
        Hash hash(cancelled);
        hash.addNumber(kKeyVersion);
        hash.addStamp(tool);
        hash.addNumber(bake.scans.size());
        for (const std::string& scan : bake.scans) addScan(hash, scan);
        for (const std::string& option : bake.options) addOption(hash, option);
        return hash.digits();
    } catch (const Cancelled&) {
        return {};
    }
}

} // namespace pointrt
