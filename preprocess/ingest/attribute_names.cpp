// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/attribute_names.h"

#include <algorithm>
#include <cctype>

namespace pointrt {
namespace {

constexpr std::size_t kLongestName = 31; // PRO_ATTRIBUTE_NAME_MAX of the format

/// Spelling in lower case without underscores and blanks, and the attribute's name.
struct Spelling {
    std::string_view letters, name;
};

constexpr Spelling kSpellings[] = {
    {"intensity", "intensity"},
    {"returnnumber", "return_number"},
    {"returnnum", "return_number"},
    {"numberofreturns", "number_of_returns"},
    {"numreturns", "number_of_returns"},
    {"scandirectionflag", "scan_direction_flag"},
    {"scandirection", "scan_direction_flag"},
    {"edgeofflightline", "edge_of_flight_line"},
    {"classification", "classification"},
    {"class", "classification"},
    {"synthetic", "synthetic"},
    {"keypoint", "key_point"},
    {"withheld", "withheld"},
    {"overlap", "overlap"},
    {"scannerchannel", "scanner_channel"},
    {"scanchannel", "scanner_channel"},
    {"scananglerank", "scan_angle_rank"},
    {"scanangle", "scan_angle"},
    {"userdata", "user_data"},
    {"pointsourceid", "point_source_id"},
    {"gpstime", "gps_time"},
    {"nir", "nir"},
    {"scan", "scan"},
    {"row", "row"},
    {"column", "column"},
    {"opacity", "opacity"},
    {"confidence", "confidence"},
    {"quality", "quality"},
};

std::string lettersOf(std::string_view written) {
    std::string letters;
    for (const char letter : written)
        if (letter != '_' && letter != ' ')
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return letters;
}

constexpr std::string_view kPrefix = "scalar_"; // of CloudCompare

bool hasPrefix(std::string_view written) {
    if (written.size() < kPrefix.size()) return false;
    return std::equal(kPrefix.begin(), kPrefix.end(), written.begin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

/// Length in bytes of the UTF-8 character at the start of text; 0 if it is invalid or a control character.
std::size_t characterSize(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return first >= ' ' && first != 0x7f;
    const std::size_t size = first >= 0xf0 && first <= 0xf4  ? 4
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xc2 && first < 0xe0 ? 2
                                                             : 0;
    if (size == 0 || size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    // Overlong encodings, surrogates, beyond the last code point: RFC 3629.
    const bool bad = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0) ||
                     (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90);
    return bad ? 0 : size;
}

/// Replaces each byte that is not UTF-8 by a question mark.
std::string cleaned(std::string_view written) {
    std::string name;
    while (!written.empty()) {
        const std::size_t size = characterSize(written);
        const std::string_view character = size == 0 ? std::string_view("?") : written.substr(0, size);
        if (name.size() + character.size() > kLongestName) break;
        name += character;
        written.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return name;
}

} // namespace

std::string attributeName(std::string_view written) {
    const std::string letters = lettersOf(hasPrefix(written) ? written.substr(kPrefix.size()) : written);
    for (const Spelling& spelling : kSpellings)
        if (spelling.letters == letters) return std::string(spelling.name);
    return cleaned(written);
}

std::optional<std::string> AttributeNames::take(std::string_view written) {
    const auto isTaken = [&](const std::string& name) {
        return name.empty() || std::find(taken_.begin(), taken_.end(), name) != taken_.end();
    };
    for (const std::string& name : {attributeName(written), cleaned(written)}) {
        if (isTaken(name)) continue;
        taken_.push_back(name);
        return name;
    }
    return std::nullopt;
}

} // namespace pointrt
