// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/given_positions.h"

#include <cmath>

#include "format/base/error.h"
#include "runtime/rays/ray_source.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

const RowKind kPositions{"point", "points", {3}, "3: x, y, z", "(N, 3): positions", {"x", "y", "z"}};
const RowKind kPlanePositions{"point",        "points", {2, 3}, "2: x, y, or 3: x, y, z", "(N, 2) or (N, 3): positions",
                              {"x", "y", "z"}};

/// Whether text is a list of numbers rather than the name of a file.
bool isList(const std::string& text) {
    return text != "-" && text.find(',') != text.npos && text.find_first_not_of("0123456789+-.eE, ;\t\n") == text.npos;
}

std::vector<std::string> splitAt(const std::string& text, const char* separators) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return parts;
}

[[noreturn]] void refusePoint(const std::string& option, const std::string& word, bool plane) {
    throw Error(ExitCode::kBadUsage, option + ": \"" + word + "\" is not " + (plane ? "x,y or x,y,z" : "x,y,z") +
                                         "; separate points by spaces");
}

GivenPositions listedPositions(const std::string& text, const std::string& option, bool plane) {
    GivenPositions given;
    std::size_t width = 0;
    for (const std::string& word : splitAt(text, " ;\t\n")) {
        const std::vector<std::string> numbers = splitAt(word, ",");
        const bool fits = numbers.size() == 3 || (plane && numbers.size() == 2);
        if (width == 0) width = numbers.size();
        Position position{};
        if (!fits || numbers.size() != width) refusePoint(option, word, plane);
        for (std::size_t axis = 0; axis < width; ++axis)
            if (!parseNumber(numbers[axis], position[axis])) refusePoint(option, word, plane);
        given.positions.push_back(position);
    }
    given.has_z = width == 3;
    return given;
}

GivenPositions filePositions(const std::string& file, bool plane) {
    const std::unique_ptr<RaySource> rows = openRays(file, plane ? kPlanePositions : kPositions);
    GivenPositions given;
    RayBlock block;
    const auto take = [&](const auto& numbers) {
        const std::size_t width = rows->width();
        for (std::size_t at = 0; at + width <= numbers.size(); at += width) {
            Position position{};
            for (std::size_t axis = 0; axis < width; ++axis) {
                position[axis] = static_cast<double>(numbers[at + axis]);
                if (!std::isfinite(position[axis]))
                    throw Error(ExitCode::kBadInput, rows->placeOf(block, at / width) + ": not finite");
            }
            given.positions.push_back(position);
        }
        given.has_z = width == 3;
    };
    while (rows->next(block)) {
        if (!block.doubles.empty()) take(block.doubles);
        if (!block.floats.empty()) take(block.floats);
    }
    return given;
}

} // namespace

GivenPositions givenPositions(const std::string& text, const std::string& option, bool plane) {
    return isList(text) ? listedPositions(text, option, plane) : filePositions(text, plane);
}

} // namespace pointrt
