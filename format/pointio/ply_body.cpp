// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/ply_body.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "format/base/error.h"
#include "format/base/number_type.h"
#include "format/base/printable.h"

namespace pointrt::format {
namespace {

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

template <typename Number>
double loadNumber(const char* from, bool swaps) {
    std::array<char, sizeof(Number)> bytes;
    std::copy_n(from, bytes.size(), bytes.begin());
    if (swaps) std::reverse(bytes.begin(), bytes.end());
    Number number;
    std::memcpy(&number, bytes.data(), sizeof number);
    return static_cast<double>(number);
}

/// Whether the type holds this number; floats round.
bool fits(double value, std::uint32_t type) {
    return withType(type, [&](auto number) {
        using Limits = std::numeric_limits<decltype(number)>;
        if constexpr (std::is_floating_point_v<decltype(number)>)
            return !std::isfinite(value) || std::abs(value) <= static_cast<double>(Limits::max());
        return value == std::trunc(value) && value >= static_cast<double>(Limits::lowest()) &&
               value <= static_cast<double>(Limits::max());
    });
}

} // namespace

PlyBody::PlyBody(std::string path, std::string_view file, const PlyHeader& header)
    : path_(std::move(path)), rest_(file.substr(header.bytes)), header_(&header), line_(header.lines + 1) {}

void PlyBody::next(std::span<double> numbers) {
    if (header_->encoding == PlyEncoding::kText) return nextOfText(numbers);
    const bool swaps = header_->encoding == PlyEncoding::kBigEndian;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const std::uint32_t type = header_->properties[k].type;
        numbers[k] = withType(type, [&](auto number) { return loadNumber<decltype(number)>(rest_.data(), swaps); });
        rest_.remove_prefix(pro_type_bytes(type));
    }
}

void PlyBody::nextOfText(std::span<double> numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = numberOf(nextWord(), header_->properties[k].type);
}

std::string_view PlyBody::nextWord() {
    while (!rest_.empty() && isBlank(rest_.front())) {
        line_ += rest_.front() == '\n';
        rest_.remove_prefix(1);
    }
    const auto end = std::find_if(rest_.begin(), rest_.end(), isBlank);
    const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    if (word.empty()) throw Error(ExitCode::kBadInput, path_ + ": ends before the last of its vertices");
    rest_.remove_prefix(word.size());
    return word;
}

double PlyBody::numberOf(std::string_view word, std::uint32_t type) const {
    const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* const end = word.data() + word.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc() && stop == end && fits(value, type)) return value;
    throw Error(ExitCode::kBadInput, path_ + ":" + std::to_string(line_) + ": \"" +
                                         printable(std::string(word.substr(0, 40))) + "\" is not a number of type " +
                                         typeName(type));
}

} // namespace pointrt::format
