// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/xyz_columns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string_view>

namespace pointrt {
namespace {

/// Components with three decimals give a unit vector's length to 0.001; with two, to 0.01.
constexpr double kUnitTolerance = 0.01;

/// Seconds: of Unix and of adjusted GPS time, beyond any coordinate in metres or feet; and of a GPS week.
constexpr double kLeastTime = 1e8, kWeek = 604800;
/// Metres of UTM: eastings are 100,000 to 900,000, northings north of 9 degrees a million to ten million.
constexpr double kLeastEasting = 1e5, kMostEasting = 1e6, kMostNorthing = 1e7;

bool isUnit(const double* v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return std::abs(length - 1) <= kUnitTolerance;
}

/// Whether v marks a missing normal: zeros, or NaN.
bool isMissing(const double* v) {
    return (v[0] == 0 && v[1] == 0 && v[2] == 0) || std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2]);
}

bool within(const ColumnStatistics& statistics, std::size_t first, double most) {
    for (std::size_t i = first; i < first + 3; ++i)
        if (!(statistics.least[i] >= 0 && statistics.most[i] <= most)) return false;
    return true;
}

bool wholeNumbers(const ColumnStatistics& statistics, std::size_t first) {
    return statistics.whole[first] && statistics.whole[first + 1] && statistics.whole[first + 2];
}

bool colorLike(const ColumnStatistics& statistics, std::size_t first) {
    return (wholeNumbers(statistics, first) && within(statistics, first, 65535)) || within(statistics, first, 1);
}

bool isConstant(const ColumnStatistics& statistics, std::size_t column) {
    return statistics.least[column] == statistics.most[column];
}

/// Whether a column can be the alpha of opaque points: always 255, or always 1.
bool isOpaque(const ColumnStatistics& statistics, std::size_t column) {
    return isConstant(statistics, column) && (statistics.most[column] == 255 || statistics.most[column] == 1);
}

std::optional<std::size_t> findNormals(const ColumnStatistics& statistics, std::size_t extras) {
    for (std::size_t first = 0; first + 3 <= extras; ++first)
        if (statistics.unit[first] && statistics.directed[first]) return first;
    return std::nullopt;
}

/// Other facts about the list: whether it is a .pts file, and whether normals were found.
struct Others {
    bool is_pts, normals;
};

/// Three colour columns, and whether the choice is ambiguous.
struct ColorPlace {
    std::size_t first;
    bool doubtful = false;
    bool label = false; ///< the column beside them is a class number
};

/// Which of the integer columns a, b, c and d is an intensity: 'a', 'd', or 0 if undecided. b and c are colours in
/// either case. If all three colours exceed a byte, or none does, the intensity is the end that differs from b and c.
char intensityByWidth(const ColumnStatistics& statistics, std::size_t a) {
    const auto wide = [&](std::size_t i) { return statistics.most[a + i] > 255; };
    if (wide(1) != wide(2) || wide(0) == wide(3)) return 0;
    return wide(0) == wide(1) ? 'd' : 'a';
}

/// Pearson's correlation of a column with the next; 0 if one of them is constant.
double correlation(const ColumnStatistics& statistics, std::size_t column) {
    const auto rows = static_cast<double>(statistics.rows);
    const auto variance = [&](std::size_t i) {
        return statistics.squares[i] - statistics.sum[i] * statistics.sum[i] / rows;
    };
    const double both = variance(column) * variance(column + 1);
    if (isConstant(statistics, column) || isConstant(statistics, column + 1) || !(both > 0)) return 0;
    return (statistics.products[column] - statistics.sum[column] * statistics.sum[column + 1] / rows) / std::sqrt(both);
}

/// Whether three columns of colours exceed half of a byte's range, but not a byte.
bool areBright(const ColumnStatistics& statistics, std::size_t colors) {
    const auto most = std::max({statistics.most[colors], statistics.most[colors + 1], statistics.most[colors + 2]});
    return most >= 128 && most <= 255;
}

/// Whether a column of integers beside three colours is a class number: its values are small, those of the colours are
/// not.
bool isLabel(const ColumnStatistics& statistics, std::size_t column, std::size_t colors) {
    constexpr double kMostLabels = 64;
    return statistics.whole[column] && statistics.least[column] >= 0 && statistics.most[column] < kMostLabels &&
           !isConstant(statistics, column) && areBright(statistics, colors);
}

/// Which of the integer columns a, b, c and d is an intensity or a label: 'a', 'd', or 0 if undecided. A label is
/// small. Channels of a colour resemble each other more than an intensity does.
char otherByValues(const ColumnStatistics& statistics, std::size_t a) {
    constexpr double kClear = 0.2; // between channels of photographs 0.9, to an intensity 0.3 to 0.6
    constexpr std::uint64_t kLeastRows = 50;
    const bool label_last = isLabel(statistics, a + 3, a), label_first = isLabel(statistics, a, a + 1);
    if (label_last != label_first) return label_last ? 'd' : 'a';
    if (statistics.rows < kLeastRows) return 0;
    const double first = correlation(statistics, a), last = correlation(statistics, a + 2);
    return std::abs(first - last) < kClear ? char{0} : first > last ? 'd' : 'a';
}

/// Which of the columns a, b, c and d are colours. a, b and c if d is an alpha or, except in .pts files, constant;
/// otherwise all but the intensity, which is a or d. If the values fit both, the intensity is d in lists with normals
/// and a in others, as programs write them.
std::optional<ColorPlace> colorsOfFour(const ColumnStatistics& statistics, std::size_t a, const Others& others) {
    const bool first = colorLike(statistics, a), second = colorLike(statistics, a + 1);
    if (!first && !second) return std::nullopt;
    if (!first || !second) return ColorPlace{first ? a : a + 1};
    const bool varied = !isConstant(statistics, a) && !isConstant(statistics, a + 1) && !isConstant(statistics, a + 2);
    if (isOpaque(statistics, a + 3) || (isConstant(statistics, a + 3) && varied && !others.is_pts))
        return ColorPlace{a};
    const bool whole = wholeNumbers(statistics, a) && wholeNumbers(statistics, a + 1);
    if (const char intensity = whole ? intensityByWidth(statistics, a) : char{0})
        return ColorPlace{intensity == 'd' ? a : a + 1};
    if (const char other = whole && !others.is_pts ? otherByValues(statistics, a) : char{0}) {
        const bool last = other == 'd';
        const bool label = isLabel(statistics, last ? a + 3 : a, last ? a : a + 1);
        return ColorPlace{last ? a : a + 1, !label, label};
    }
    const bool unused_first = isConstant(statistics, a) && !isConstant(statistics, a + 3);
    return ColorPlace{others.normals ? a : a + 1, !others.is_pts && !(unused_first && !others.normals)};
}

/// Finds the colours among the columns [begin, end).
std::optional<ColorPlace> colorsOfRun(const ColumnStatistics& statistics, std::size_t begin, std::size_t end,
                                      const Others& others) {
    if (end - begin == 4) return colorsOfFour(statistics, begin, others);
    for (std::size_t first = begin; first + 3 <= end; ++first)
        if (colorLike(statistics, first)) return ColorPlace{first, end - begin > 4};
    return std::nullopt;
}

std::optional<ColorPlace> findColors(const ColumnStatistics& statistics, std::size_t extras,
                                     std::optional<std::size_t> normals, bool is_pts) {
    if (!normals) return colorsOfRun(statistics, 0, extras, {is_pts, false});
    const Others others{is_pts, true};
    const auto before = colorsOfRun(statistics, 0, *normals, others);
    return before ? before : colorsOfRun(statistics, *normals + 3, extras, others);
}

constexpr std::string_view kAdvice = "add a header line such as '//X Y Z R G B I' to name";

/// has_label: one column is read as a label; unread: number of columns that are not read
std::string doubtOf(const std::optional<ColorPlace>& colors, bool normals, bool has_label, std::size_t unread,
                    std::size_t before) {
    if (colors && colors->doubtful)
        return fmt::format("has no header: columns {} to {} are read as red, green and blue, the others are not "
                           "read; {} them",
                           before + colors->first + 4, before + colors->first + 6, kAdvice);
    if (has_label)
        return fmt::format("has no header: columns {} to {} are read as red, green and blue, {} as 'label'{}; {} them",
                           before + colors->first + 4, before + colors->first + 6,
                           colors->label ? "the one beside them" : "the last",
                           unread > 0 ? ", the last is not read" : "", kAdvice);
    if (unread == 0) return {};
    const bool one = unread == 1;
    return fmt::format(
        "has no header, and {} column{} after x, y, z{} that look{} like neither colours nor normals {} not "
        "read; {} {}",
        unread, one ? "" : "s", normals ? " and normals" : "", one ? "s" : "", one ? "is" : "are", kAdvice,
        one ? "it" : "them");
}

/// Reads the column beside colours as a label or an intensity, unless it is an alpha or in doubt.
void takeBeside(const ColumnStatistics& statistics, const ColorPlace& colors, std::size_t column, ColumnGuess& guess) {
    if (colors.label)
        guess.label = column;
    else if (!isOpaque(statistics, column - 3) && !colors.doubtful)
        guess.intensity = column;
}

void assign(std::vector<Dimension>& dimensions, std::size_t first, Dimension dimension) {
    for (int i = 0; i < 3; ++i) dimensions[first + i] = static_cast<Dimension>(dimension + i);
}

} // namespace

ColumnStatistics::ColumnStatistics() {
    whole.fill(true);
    unit.fill(true);
    directed.fill(false);
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
}

void observe(ColumnStatistics& statistics, const double* extras, std::size_t count) {
    count = std::min(count, ColumnStatistics::kMax);
    ++statistics.rows;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = extras[i];
        statistics.whole[i] = statistics.whole[i] && value == std::trunc(value);
        statistics.least[i] = std::min(statistics.least[i], value);
        statistics.most[i] = std::max(statistics.most[i], value);
        statistics.sum[i] += value;
        statistics.squares[i] += value * value;
        if (i + 1 < count) statistics.products[i] += value * extras[i + 1];
        const bool direction = i + 3 <= count && isUnit(extras + i);
        statistics.directed[i] = statistics.directed[i] || direction;
        statistics.unit[i] = statistics.unit[i] && (direction || (i + 3 <= count && isMissing(extras + i)));
    }
}

LeadStatistics::LeadStatistics() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    all_whole.fill(true);
}

void observe(LeadStatistics& statistics, const double* values) {
    if (statistics.rows++ > 0) {
        const double step = values[0] - statistics.last;
        statistics.strictly = statistics.strictly && step > 0;
        statistics.ascends = step > 0 || (step == 0 && values[0] >= kLeastTime);
        statistics.counts = statistics.counts && step == 1;
    }
    statistics.last = values[0];
    for (std::size_t i = 0; i < 4; ++i) {
        statistics.least[i] = std::min(statistics.least[i], values[i]);
        statistics.most[i] = std::max(statistics.most[i], values[i]);
        statistics.all_whole[i] = statistics.all_whole[i] && values[i] == std::trunc(values[i]);
    }
}

Lead leadOf(const LeadStatistics& statistics, bool described) {
    // Fewer rows may ascend by chance; words after them are descriptions, which lists of numbered points have.
    const std::uint64_t fewest = described ? 2 : 8;
    const auto varies = [&](std::size_t i) { return statistics.least[i] < statistics.most[i]; };
    if (!statistics.ascends || statistics.rows < fewest) return Lead::kNone;
    if (statistics.least[0] >= kLeastTime) return Lead::kTime;
    if (!statistics.strictly || !varies(1) || !varies(2)) return Lead::kNone;
    const bool fractions = !statistics.all_whole[1] && !statistics.all_whole[2];
    if (statistics.all_whole[0] && statistics.least[0] >= 0 && (statistics.counts || fractions)) return Lead::kNumber;
    const bool on_map = statistics.least[1] >= kLeastEasting && statistics.least[2] >= kLeastEasting;
    return statistics.least[0] >= 0 && statistics.most[0] <= kWeek && on_map ? Lead::kTime : Lead::kNone;
}

bool isNorthFirst(const LeadStatistics& statistics) {
    return statistics.least[1] >= kMostEasting && statistics.most[1] <= kMostNorthing &&
           statistics.least[2] >= kLeastEasting && statistics.most[2] < kMostEasting;
}

ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count, bool is_pts,
                         std::size_t before) {
    ColumnGuess guess;
    guess.dimensions.assign(column_count, kIgnored);
    assign(guess.dimensions, 0, kX);
    const std::size_t extras = column_count - 3;
    if (is_pts && extras == 1) guess.intensity = 3;
    if (column_count < 6 || column_count > 10) {
        guess.doubt = doubtOf(std::nullopt, false, false, guess.intensity ? 0 : extras, before);
        return guess;
    }
    const auto normals = findNormals(statistics, extras);
    // With five columns, the last is a class or an object number; the others are colours and an intensity or a class.
    const bool five = extras == 5 && !normals;
    auto colors = findColors(statistics, five ? 4 : extras, normals, is_pts);
    if (five && colors && !areBright(statistics, colors->first)) colors.reset();
    if (normals) assign(guess.dimensions, 3 + *normals, kNormalX);
    if (colors) {
        assign(guess.dimensions, 3 + colors->first, kRed);
        guess.real_colors = !wholeNumbers(statistics, colors->first);
    }
    const auto left = std::find(guess.dimensions.begin() + 3, guess.dimensions.end(), kIgnored);
    auto unread = static_cast<std::size_t>(std::count(left, guess.dimensions.end(), kIgnored));
    if (colors && unread == (five ? 2 : 1)) {
        takeBeside(statistics, *colors, static_cast<std::size_t>(left - guess.dimensions.begin()), guess);
        --unread;
    }
    if (five && colors && !guess.label && isLabel(statistics, 4, colors->first)) {
        guess.label = column_count - 1;
        --unread;
    }
    guess.doubt = doubtOf(colors, normals.has_value(), guess.label.has_value(), unread, before);
    return guess;
}

} // namespace pointrt
