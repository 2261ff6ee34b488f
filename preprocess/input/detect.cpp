// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/detect.h"

#include <algorithm>
#include <cctype>

#include "preprocess/input/formats/readers.h"
#include "preprocess/input/source/text.h"

namespace pointrt {
namespace {

struct Named {
    std::string_view name; ///< as an option and as a suffix
    Reader reader;
};

constexpr Named kReaders[] = {
    {"ply", readPly}, {"pcd", readPcd}, {"obj", readObj}, {"off", readOff}, {"drc", readDraco}, {"conf", readConf},
    {"xyz", readXyz}, {"pts", readXyz}, {"asc", readXyz}, {"txt", readXyz}, {"csv", readXyz},
};

struct Foreign {
    std::string_view magic;
    std::string_view reason;
};

constexpr Foreign kForeign[] = {
    {"LASF", "is a LAS or LAZ scan"},
    {"ASTM-E57", "is an E57 scan"},
    {"PK\x03\x04", "is a zip archive, unpack it first"},
    {"NGSP", "is an SPZ file of Gaussian splats"},
    {"glTF", "is a glTF model"},
    {"\x89HDF", "is an HDF5 file"},
    {"[Expe/PointSet", "is an Expe point set"},
};

/// The bytes in which the kind of a file shows; long comments may stand before it.
constexpr std::size_t kSniffed = 1 << 16;

Reader readerOfName(std::string_view name) {
    for (const Named& named : kReaders)
        if (named.name == name) return named.reader;
    return nullptr;
}

void refuseForeign(const Source& source) {
    if (source.bytes.starts_with("version https://git-lfs"))
        refuse(source, "is a Git LFS pointer, not the data itself: fetch it with 'git lfs pull'");
    for (const Foreign& foreign : kForeign)
        if (source.bytes.starts_with(foreign.magic))
            refuse(source, fmt::format("{}; this build reads {}", foreign.reason, kReadableFormats));
}

/// The lower-case suffix of a name, ".gz" left out.
std::string suffixOf(std::string name) {
    for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    const std::size_t dot = name.find_last_of("./");
    return dot == std::string::npos || name[dot] != '.' ? std::string() : name.substr(dot + 1);
}

bool looksLikeText(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char letter) {
        return (letter >= 0 && letter < ' ' && !isSpace(letter)) || letter == '\x7f';
    });
}

bool isOffKeyword(std::string_view word) {
    // The longest is ST, C, N, 4 and n before it.
    return word.ends_with("OFF") && word.size() <= 9;
}

/// Tells by the first words of lines; comments say nothing, but for the one that PCD files start with.
Reader readerOfText(std::string_view bytes) {
    if (bytes.starts_with("# .PCD")) return readPcd;
    std::string_view line;
    bool first = true;
    while (nextLine(bytes, line)) {
        const std::string_view word = nextWord(line);
        if (word.empty() || word[0] == '#') continue;
        if (first && isOffKeyword(word)) return readOff;
        if (first && (word == "VERSION" || word == "FIELDS" || word == "COLUMNS")) return readPcd;
        if (word == "bmesh") return readConf;
        double value = 0;
        if ((word == "v" || word == "vn") && wholeNumber(nextWord(line), value)) return readObj;
        first = false;
    }
    return nullptr;
}

Reader readerOfContent(std::string_view bytes) {
    const std::string_view sniffed = bytes.substr(0, kSniffed);
    if (bytes.starts_with("DRACO")) return readDraco;
    if (bytes.starts_with("ply") && bytes.size() > 3 && isSpace(bytes[3])) return readPly;
    // Binary PCD has a header of text.
    if (const Reader reader = readerOfText(sniffed))
        return reader == readPcd || looksLikeText(sniffed) ? reader : nullptr;
    return nullptr;
}

} // namespace

Reader chooseReader(const Source& source, const std::string& format) {
    const Reader forced = readerOfName(format);
    if (!format.empty() && !forced)
        throw Error(ExitCode::kBadUsage, fmt::format("unknown input format {}", quoted(format)));
    refuseForeign(source);
    if (forced) return forced;
    if (const Reader reader = readerOfContent(source.bytes)) return reader;
    if (const Reader reader = readerOfName(suffixOf(source.name)); reader && reader != readXyz) return reader;
    if (looksLikeText(source.bytes.substr(0, kSniffed))) return readXyz;
    refuse(source, fmt::format("is of no known format; this build reads {}", kReadableFormats));
}

} // namespace pointrt
