// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/csv_rays.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/util/words.h"

namespace pointrt {
namespace {

constexpr std::size_t kNumbersMost = 6;      // largest number of numbers in a row
constexpr std::size_t kReadBytes = 1u << 20; // bytes per read, so that reading takes little time compared with parsing
constexpr std::size_t kLongestLine = 1u << 16; // longer lines mean that the input is not a list of rays

/// The numbers of a line.
struct Parsed {
    std::array<double, kNumbersMost> numbers{};
    std::size_t count = 0;  ///< of all numbers, even those beyond the array
    std::string_view error; ///< the first word that is not a number, or empty
};

Parsed parse(std::string_view line) {
    Parsed parsed;
    while (true) {
        const std::size_t start = line.find_first_not_of(kBetweenWords);
        if (start == line.npos) return parsed;
        line.remove_prefix(line[start] == '+' ? start + 1 : start);
        double number = 0;
        const auto [rest, failure] = std::from_chars(line.data(), line.data() + line.size(), number);
        const auto length = static_cast<std::size_t>(rest - line.data());
        if (failure != std::errc() ||
            (length < line.size() && kBetweenWords.find(line[length]) == kBetweenWords.npos)) {
            parsed.error = line.substr(0, line.find_first_of(kBetweenWords));
            return parsed;
        }
        if (parsed.count < kNumbersMost) parsed.numbers[parsed.count] = number;
        ++parsed.count;
        line.remove_prefix(length);
    }
}

bool isWord(std::string_view text, std::string_view lower) {
    return std::equal(text.begin(), text.end(), lower.begin(), lower.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

class CsvRays final : public RaySource {
public:
    CsvRays(std::unique_ptr<ByteInput> input, const RowKind& kind) : input_(std::move(input)), kind_(kind) {}

    std::size_t width() const override { return width_ > 0 ? width_ : kind_.widths[0]; }

    bool next(RayBlock& block) override {
        block.first = done_;
        block.doubles.clear();
        block.lines.clear();
        std::string_view line;
        while (block.lines.size() < RayBlock::kRays && nextLine(line)) addLine(line, block);
        done_ += block.lines.size();
        return !block.lines.empty();
    }

    std::optional<std::uint64_t> count() const override { return {}; }

    std::string placeOf(const RayBlock& block, std::size_t ray) const override {
        return input_->name() + ":" + std::to_string(block.lines.at(ray));
    }

private:
    [[noreturn]] void fail(const std::string& reason) const {
        throw Error(ExitCode::kBadInput, input_->name() + ":" + std::to_string(line_) + ": " + reason);
    }

    void addLine(std::string_view line, RayBlock& block) {
        const std::size_t start = line.find_first_not_of(kBetweenWords);
        if (start == line.npos || line[start] == '#') return;
        const bool may_name_columns = !std::exchange(has_first_line_, true);
        const Parsed parsed = parse(line);
        if (!parsed.error.empty() && may_name_columns && parsed.count == 0) return requireNames(line);
        if (!parsed.error.empty()) fail("\"" + printable(parsed.error) + "\" is not a number");
        requireWidth(parsed.count);
        block.doubles.insert(block.doubles.end(), parsed.numbers.begin(),
                             parsed.numbers.begin() + static_cast<std::ptrdiff_t>(width_));
        block.lines.push_back(line_);
    }

    /// The first row sets the width of all rows.
    void requireWidth(std::size_t count) {
        const auto& widths = kind_.widths;
        if (std::find(widths.begin(), widths.end(), count) == widths.end())
            fail(std::to_string(count) + " numbers, but a " + kind_.row + " has " + kind_.numbers);
        if (width_ == 0) width_ = count;
        if (width_ != count)
            fail(std::to_string(count) + " numbers, but the first " + kind_.row + " has " + std::to_string(width_));
    }

    void requireNames(std::string_view line) const {
        const std::vector<std::string_view> words = wordsOf(line);
        const auto named = [&](std::size_t count) {
            return words.size() == count && std::equal(words.begin(), words.end(), kind_.names.begin(), isWord);
        };
        if (kind_.names.empty() || std::any_of(kind_.widths.begin(), kind_.widths.end(), named)) return;
        std::string expected;
        for (const std::size_t width : kind_.widths) {
            expected += expected.empty() ? "" : ", or ";
            for (std::size_t k = 0; k < width; ++k) expected += (k > 0 ? "," : "") + kind_.names[k];
        }
        fail("the columns must be " + expected);
    }

    /// Reads the next line, which is valid until the next call. False at the end.
    bool nextLine(std::string_view& line) {
        ++line_;
        std::size_t end = text_.find('\n', at_);
        if (end == text_.npos && more()) end = text_.find('\n', at_);
        if (end == text_.npos && text_.size() - at_ > kLongestLine) fail("line too long: not a list of " + kind_.rows);
        if (end == text_.npos && at_ == text_.size()) return false;
        if (end == text_.npos) end = text_.size();
        line = std::string_view(text_).substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        return true;
    }

    /// Keeps the unfinished line and reads more text. False at the end of the input.
    bool more() {
        text_.erase(0, at_);
        at_ = 0;
        const std::size_t kept = text_.size();
        text_.resize(kept + kReadBytes);
        const std::size_t got = input_->read(text_.data() + kept, kReadBytes);
        text_.resize(kept + got);
        return got > 0;
    }

    std::unique_ptr<ByteInput> input_;
    const RowKind& kind_;
    std::size_t width_ = 0;
    std::string text_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 0, done_ = 0;
    bool has_first_line_ = false;
};

} // namespace

std::unique_ptr<RaySource> csvRays(std::unique_ptr<ByteInput> input, const RowKind& kind) {
    return std::make_unique<CsvRays>(std::move(input), kind);
}

} // namespace pointrt
