// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/input_formats.h"

namespace pointrt {

std::span<const InputFormat> inputFormats() {
#define POINTRT_FORMAT_ROW(reader, name, title, suffixes, content)                                                     \
    {readers::reader, name, title, suffixes, Content::content},
    static constexpr InputFormat kFormats[] = {POINTRT_INPUT_FORMATS(POINTRT_FORMAT_ROW)};
#undef POINTRT_FORMAT_ROW
    return kFormats;
}

void readInput(const InputFormat& format, const InputFile& input, Sink& sink) {
    if (sink.level && !format.reader.has_levels) noteWithoutLevels(input, sink);
    format.reader.read(input, sink);
}

std::string readableFormats() {
    const auto formats = inputFormats();
    std::string list;
    for (std::size_t i = 0; i < formats.size(); ++i) {
        if (i != 0) list += i + 1 < formats.size() ? ", " : " and ";
        list += formats[i].title;
    }
    return list;
}

} // namespace pointrt
