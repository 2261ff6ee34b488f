// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/detect.h"

#include <algorithm>

#include "preprocess/ingest/text.h"
#include "preprocess/input/foreign.h"

namespace pointrt {
namespace {

/// Bytes at the start of a file that decide its format; long comments may come first.
constexpr std::size_t kSniffed = 1 << 16;

/// The first format for which holds is true, or null.
template <typename Predicate>
const InputFormat* firstFormat(const Predicate& holds) {
    const auto formats = inputFormats();
    const auto found = std::find_if(formats.begin(), formats.end(), holds);
    return found == formats.end() ? nullptr : &*found;
}

const InputFormat* formatNamed(std::string_view name) {
    return firstFormat([&](const InputFormat& format) { return format.name == name; });
}

/// The suffix of a name in lower case, without ".gz".
std::string suffixOf(std::string name) {
    name = lowerCase(name);
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    const std::size_t dot = name.find_last_of("./");
    return dot == std::string::npos || name[dot] != '.' ? std::string() : name.substr(dot + 1);
}

const InputFormat* formatOfSuffix(std::string_view suffix) {
    return firstFormat([&](const InputFormat& format) {
        bool is_one = false;
        forSuffixes(format, [&](std::string_view each) { is_one = is_one || each == suffix; });
        return is_one && format.content != Content::kColumns; // any text matches it
    });
}

bool looksLikeText(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char letter) {
        return (letter >= 0 && letter < ' ' && !isSpace(letter)) || letter == '\x7f';
    });
}

const InputFormat* formatOfStart(std::string_view bytes) {
    return firstFormat([&](const InputFormat& each) { return each.reader.isStart && each.reader.isStart(bytes); });
}

const InputFormat* formatOfLines(std::string_view bytes) {
    std::string_view line;
    bool first = true;
    while (nextLine(bytes, line)) {
        std::string_view words = line;
        const std::string_view word = nextWord(words);
        if (word.empty() || word[0] == '#') continue;
        const InputFormat* const format =
            firstFormat([&](const InputFormat& each) { return each.reader.isLine && each.reader.isLine(line, first); });
        if (format) return format;
        first = false;
    }
    return nullptr;
}

const InputFormat* formatOfContent(std::string_view bytes) {
    if (const InputFormat* const format = formatOfStart(bytes)) return format;
    const std::string_view sniffed = bytes.substr(0, kSniffed);
    const InputFormat* const format = formatOfLines(sniffed);
    return format && (format->content == Content::kAny || looksLikeText(sniffed)) ? format : nullptr;
}

const InputFormat* formatOfPlainText(std::string_view bytes) {
    if (!looksLikeText(bytes.substr(0, kSniffed))) return nullptr;
    return firstFormat([](const InputFormat& format) { return format.content == Content::kColumns; });
}

} // namespace

SuffixOf suffixKind(const std::string& name) {
    const std::string suffix = suffixOf(name);
    for (const std::string_view shared : {"txt", "csv", "bin", "tif", "tiff"})
        if (suffix == shared) return SuffixOf::kText;
    bool known = false;
    for (const InputFormat& format : inputFormats())
        forSuffixes(format, [&](std::string_view each) { known = known || each == suffix; });
    return known ? SuffixOf::kScan : SuffixOf::kOther;
}

const InputFormat& formatOf(const InputFile& input, std::string_view name) {
    const InputFormat* const named = formatNamed(name);
    if (!name.empty() && !named)
        throw Error(ExitCode::kBadUsage, fmt::format("unknown input format {}", inQuotes(name)));
    if (!formatOfStart(input.bytes)) refuseForeignStart(input);
    if (named) return *named;
    if (const InputFormat* const format = formatOfContent(input.bytes)) return *format;
    if (const InputFormat* const format = formatOfSuffix(suffixOf(input.name))) return *format;
    refuseForeignSuffix(input, suffixOf(input.name));
    if (const InputFormat* const format = formatOfPlainText(input.bytes)) return *format;
    refuse(input, fmt::format("has an unknown format; this build reads {}", readableFormats()));
}

} // namespace pointrt
