// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/formats.h"

namespace pointrt {

std::span<const InputFormat> inputFormats() {
#define POINTRT_FORMAT_ROW(reader, name, title, suffixes, content)                                                     \
    {readers::reader, name, title, suffixes, Content::content},
    static constexpr InputFormat kFormats[] = {POINTRT_INPUT_FORMATS(POINTRT_FORMAT_ROW)};
#undef POINTRT_FORMAT_ROW
    return kFormats;
}

void readSource(const InputFormat& format, const Source& source, Sink& sink) {
    if (sink.level && !format.reader.knows_levels) noteWithoutLevels(source, sink);
    format.reader.read(source, sink);
}

void noteWithoutLevels(const Source& source, Sink& sink) {
    addNote(sink.cloud, source.name, "has no levels of detail: it is read whole");
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
