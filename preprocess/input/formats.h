// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are read. To add one: its file, which defines a FormatReader, here its row, and CMakeLists.txt.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "preprocess/input/sink.h"

namespace pointrt {

/// What the bytes of a file may be.
enum class Content {
    kAny,     ///< text or binary, told by its start or by a line of a header
    kText,    ///< nothing but text, told by a line
    kColumns, ///< text that no other format knows
};

/// What the code of a format does.
struct FormatReader {
    /// Whether a file's first bytes are those of the format; null where they do not tell.
    bool (*isStart)(std::string_view bytes) = nullptr;
    /// Whether a line of text tells the format; comments are left out. first: of the file. Null where no line does.
    bool (*isLine)(std::string_view line, bool first) = nullptr;
    /// Throws Error with "FILE[:PLACE]: reason" when the source is malformed.
    void (*read)(const Source& source, Sink& sink);
    /// Whether read goes on with points handed on in batches: no faces, no grid, nothing that looks at all of them.
    /// Null where it never does.
    bool (*readsInBatches)(const Source& source) = nullptr;
    /// Whether a file may have levels of detail: read minds Sink::level, and notes where a file has none.
    bool knows_levels = false;
};

/// FormatReader::readsInBatches of formats whose files always are.
inline bool alwaysInBatches(const Source&) { return true; }

/// The one list: reader, name of --input-format, title for people, suffixes in lower case, content. Option, help,
/// messages and detection come from here. A file defines "const FormatReader readers::kName{...}", which does not
/// compile for a name that is not in it; a name that no file defines does not link.
// clang-format off
#define POINTRT_INPUT_FORMATS(FORMAT)                                                                                  \
    FORMAT(kPly, "ply", "PLY", "ply", kAny)                                                                            \
    FORMAT(kPcd, "pcd", "PCD", "pcd", kAny)                                                                            \
    FORMAT(kLas, "las", "LAS/LAZ", "las laz", kAny)                                                                    \
    FORMAT(kE57, "e57", "E57", "e57", kAny)                                                                            \
    FORMAT(kPtx, "ptx", "PTX", "ptx", kText)                                                                           \
    FORMAT(kXyz, "xyz", "XYZ/PTS/ASC/TXT/CSV", "xyz pts asc txt csv", kColumns)                                        \
    FORMAT(kObj, "obj", "OBJ", "obj", kText)                                                                           \
    FORMAT(kOff, "off", "OFF", "off", kText)                                                                           \
    FORMAT(kDraco, "drc", "Draco", "drc", kAny)                                                                        \
    FORMAT(kSplat, "splat", "SPLAT", "splat", kAny)                                                                    \
    FORMAT(kSpz, "spz", "SPZ", "spz", kAny)                                                                            \
    FORMAT(kConf, "conf", "Stanford .conf", "conf", kText)
// clang-format on

namespace readers {
#define POINTRT_DECLARE_READER(reader, ...) extern const FormatReader reader;
POINTRT_INPUT_FORMATS(POINTRT_DECLARE_READER)
#undef POINTRT_DECLARE_READER
} // namespace readers

/// A row of the list.
struct InputFormat {
    const FormatReader& reader;
    std::string_view name, title, suffixes; ///< suffixes: a blank between two
    Content content;
};

/// Reads by the format's code, and notes what was asked for that the format does not have.
void readSource(const InputFormat& format, const Source& source, Sink& sink);

/// Notes that a file has no levels of detail, of which some were asked for.
void noteWithoutLevels(const Source& source, Sink& sink);

/// In the order of the list.
std::span<const InputFormat> inputFormats();

/// Their titles, for messages: "PLY, PCD and OBJ".
std::string readableFormats();

/// Calls use(suffix) for each suffix of a format.
template <typename Use>
void forSuffixes(const InputFormat& format, const Use& use) {
    for (std::string_view rest = format.suffixes; !rest.empty();) {
        const std::size_t length = rest.find(' ');
        use(rest.substr(0, length));
        rest.remove_prefix(length == std::string_view::npos ? rest.size() : length + 1);
    }
}

} // namespace pointrt
