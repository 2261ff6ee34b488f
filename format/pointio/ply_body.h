// SPDX-License-Identifier: Apache-2.0
// The vertices of a PLY file one after the other, in any of its three encodings.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/pointio/ply_header.h"

namespace pointrt::format {

class PlyBody {
public:
    /// @param path for messages
    /// @param header, file live as long as this
    PlyBody(std::string path, std::string_view file, const PlyHeader& header);

    /// The next vertex, a number for each property. All numbers of PLY are exact as doubles. Throws Error kBadInput
    /// "PATH:LINE: reason" where text is no number of the property's type, and where the file ends.
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
