// SPDX-License-Identifier: Apache-2.0
// Reads the vertices of a PLY file in sequence, in any of the three encodings.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/pointio/ply_header.h"

namespace pointrt::format {

class PlyBody {
public:
    /// @param path for messages
    /// @param file, header must outlive this
    PlyBody(std::string path, std::string_view file, const PlyHeader& header);

    /// Reads the next vertex, a number for each property; doubles hold all types of PLY exactly. Throws Error kBadInput
    /// "PATH:LINE: reason" for text that is not a number of the type, and at the end of the file.
    void next(std::span<double> numbers);

private:
    void nextOfText(std::span<double> numbers);
    std::string_view nextWord();
    double numberOf(std::string_view word, std::uint32_t type) const;

    std::string path_;
    std::string_view rest_;
    const PlyHeader* header_;
    std::size_t line_;
};

} // namespace pointrt::format
