// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are read. To add one: its file, which defines an InputFormat, here its name, and CMakeLists.txt.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "preprocess/input/source/sink.h"

namespace pointrt {

/// What the bytes of a file may be.
enum class Content {
    kAny,     ///< text or binary, told by its start or by a line of a header
    kText,    ///< nothing but text, told by a line
    kColumns, ///< text that no other format knows
};

/// All that is known of a format: option, help, messages and detection come from here.
struct InputFormat {
    std::string_view name;     ///< of --input-format
    std::string_view title;    ///< for people, in messages and help
    std::string_view suffixes; ///< of files, in lower case, a blank between two
    Content content;
    /// Whether a file's first bytes are those of the format; null where they do not tell.
    bool (*isStart)(std::string_view bytes) = nullptr;
    /// Whether a line of text tells the format; comments are left out. first: of the file. Null where no line does.
    bool (*isLine)(std::string_view line, bool first) = nullptr;
    /// Throws Error with "FILE[:PLACE]: reason" when the source is malformed.
    void (*read)(const Source& source, Sink& sink);
};

/// The one list. A file defines "const InputFormat formats::kName{...}", which does not compile for a name that is not
/// in it; a name that no file defines does not link.
#define POINTRT_INPUT_FORMATS(FORMAT)                                                                                  \
    FORMAT(kPly) FORMAT(kPcd) FORMAT(kXyz) FORMAT(kObj) FORMAT(kOff) FORMAT(kDraco) FORMAT(kConf)

namespace formats {
#define POINTRT_DECLARE_FORMAT(format) extern const InputFormat format;
POINTRT_INPUT_FORMATS(POINTRT_DECLARE_FORMAT)
#undef POINTRT_DECLARE_FORMAT
} // namespace formats

/// In the order of the list.
std::span<const InputFormat* const> inputFormats();

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
