// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a SOG: those of a folder, or the members of a zip archive.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/zip.h"

namespace pointrt {

inline constexpr std::string_view kSogMeta = "meta.json", kSogLevels = "lod-meta.json";

/// Whether the text is a meta.json of a SOG, or a lod-meta.json, by the names of its members.
bool isSogMeta(std::string_view text);
bool isSogLevels(std::string_view text);

/// Whether the archive holds a SOG or, if it is truncated, begins as one.
bool isSogArchive(std::string_view bytes);

class SogFiles {
public:
    /// The input is an archive, or a meta.json or lod-meta.json beside the files that it names.
    explicit SogFiles(const InputFile& input);

    /// The meta.json, or the lod-meta.json if there is one.
    const InputFile& meta() const { return meta_; }

    /// Opens a file that another one names, relative to that one's folder. Throws Error if it is outside the folder of
    /// the meta.json, or cannot be read.
    /// @param named_in the folder of the other file, relative to that of meta(): "" or as folderOf gives it
    InputFile open(const std::string& named_in, const std::string& name) const;

    /// Throws Error if this many Gaussians are implausible for the size of the files opened so far: a lossless image of
    /// one colour takes a few bytes whatever its size.
    void checkPromise(std::uint64_t gaussians) const;

    /// The folder of a file, with a slash at its end, or "".
    static std::string folderOf(const std::string& name);

private:
    const ZipMember* memberNamed(std::string_view name) const;
    const ZipMember* metaMember() const;

    const InputFile& input_;
    std::vector<ZipMember> members_; ///< of an archive
    std::string base_;               ///< the folder of the meta.json, in an archive
    InputFile meta_;
    mutable std::map<std::string, std::uint64_t> opened_; ///< sizes of the files of a folder, by name
};

} // namespace pointrt
