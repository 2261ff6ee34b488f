// SPDX-License-Identifier: GPL-3.0-or-later
// The list of formats with its readers, for detection and messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "preprocess/ingest/formats.h"

namespace pointrt {

/// A row of the list.
struct InputFormat {
    const FormatReader& reader;
    std::string_view name, title, suffixes; ///< suffixes: separated by blanks
    Content content;
};

/// Reads a file, and adds a note if levels of detail are requested and the format has none.
void readInput(const InputFormat& format, const InputFile& input, Sink& sink);

/// All formats, in the order of the list.
std::span<const InputFormat> inputFormats();

/// Titles of all formats, for messages: "PLY, PCD and OBJ".
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
