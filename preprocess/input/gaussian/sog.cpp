// SPDX-License-Identifier: GPL-3.0-or-later
// SOG, PlayCanvas' format of Gaussians: https://github.com/playcanvas/splat-transform
#include <algorithm>
#include <set>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/gaussian/gaussians.h"
#include "preprocess/input/gaussian/sog_files.h"
#include "preprocess/input/gaussian/sog_levels.h"
#include "preprocess/input/gaussian/sog_unit.h"

namespace pointrt {
namespace {

bool isSogStart(std::string_view bytes) { return isSogArchive(bytes) || isSogMeta(bytes) || isSogLevels(bytes); }

/// The frame of the PLY files that SOGs are converted from.
const Vec3d kSogUp = -Vec3d::UnitY();

/// A meta.json, and which of its Gaussians to read.
struct SogPart {
    std::string meta; ///< name of the meta.json, relative to the lod-meta.json
    std::vector<SogRange> ranges;

    SogUnit open(const SogFiles& files) const { return {files, files.open("", meta), SogFiles::folderOf(meta)}; }
};

std::vector<SogPart> partsOf(const SogLevels& levels) {
    std::vector<SogPart> parts;
    for (const SogLevelFile& file : levels.files) parts.push_back({file.name, file.ranges});
    if (levels.scene) parts.push_back({*levels.scene, {}}); // all of its Gaussians
    return parts;
}

/// Requires that files hold the Gaussians to be read from them, and that each file is named only once: otherwise a few
/// lines could request any amount of memory.
GaussianFile checkParts(const InputFile& input, const SogFiles& files, std::vector<SogPart>& parts) {
    GaussianFile all;
    all.up = kSogUp;
    std::set<std::string> names;
    for (SogPart& part : parts) {
        if (!names.insert(part.meta).second) refuse(input, fmt::format("names {} twice", inQuotes(part.meta)));
        const SogUnit unit = part.open(files);
        if (part.ranges.empty()) part.ranges.push_back({0, unit.count()});
        for (const SogRange& range : part.ranges) {
            if (range.first + range.count > unit.count())
                refuse(input, fmt::format("promises {} Gaussians from {} on, but {} has {}", range.count, range.first,
                                          inQuotes(part.meta), unit.count()));
            all.count += range.count;
        }
        all.degree = std::max(all.degree, unit.degree());
        files.checkPromise(all.count);
    }
    if (all.count == 0) refuse(input, "holds no points");
    return all;
}

void readLevels(const InputFile& input, const SogFiles& files, Sink& sink) {
    const SogLevels levels = parseSogLevels(files.meta(), sink.level);
    std::vector<SogPart> parts = partsOf(levels);
    const GaussianFile all = checkParts(files.meta(), files, parts);
    if (!sink.level)
        sink.note(input,
                  fmt::format("has {} levels of detail: the finest is read, --level chooses another", levels.count));
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (const SogPart& part : parts) {
            SogUnit unit = part.open(files);
            unit.decode();
            for (const SogRange& range : part.ranges)
                for (std::uint64_t i = 0; i < range.count; ++i) use(unit.at(range.first + i));
        }
    };
    readGaussians(input, all, each, sink);
}

void readSog(const InputFile& input, Sink& sink) {
    const SogFiles files(input);
    if (isSogLevels(files.meta().bytes)) return readLevels(input, files, sink);
    if (sink.level) noteWithoutLevels(input, sink);
    SogUnit unit(files, files.meta(), "");
    files.checkPromise(unit.count());
    unit.decode();
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (std::uint64_t i = 0; i < unit.count(); ++i) use(unit.at(i));
    };
    readGaussians(input, {unit.count(), kSogUp, unit.degree()}, each, sink);
}

} // namespace

const FormatReader readers::kSog{.isStart = isSogStart, .read = readSog, .has_levels = true};

} // namespace pointrt
