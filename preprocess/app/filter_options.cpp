// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/filter_options.h"

#include <charconv>
#include <cmath>

#include "format/base/axis_name.h"
#include "format/base/error.h"
#include "preprocess/app/options.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

/// Calls use(part) for each part between commas.
template <typename Use>
void eachPart(const std::string& text, const Use& use) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        use(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
    }
}

/// Sets the flags of a part, which is one class, or a range FIRST-LAST.
void markClasses(const std::string& option, std::string_view part, std::vector<bool>& classes) {
    const std::size_t dash = part.find('-');
    double first = 0, last = 0;
    const bool numbers = wholeNumber(part.substr(0, dash), first) &&
                         wholeNumber(dash == std::string_view::npos ? part : part.substr(dash + 1), last);
    if (!numbers || first != std::floor(first) || last != std::floor(last) || first < 0 || last > 255 || first > last)
        refuseUsage(fmt::format("{}: {} is not a class from 0 to 255 or a range such as 3-5", option, inQuotes(part)));
    for (auto each = static_cast<std::size_t>(first); each <= static_cast<std::size_t>(last); ++each)
        classes[each] = true;
}

} // namespace

Eigen::AlignedBox3d parseBounds(const std::string& text) {
    std::vector<double> values;
    eachPart(text, [&](std::string_view part) {
        double value = 0;
        if (!wholeNumber(part, value) || std::isnan(value))
            refuseUsage(fmt::format("--bounds: {} is not a number", inQuotes(part)));
        values.push_back(value);
    });
    if (values.size() != 6)
        refuseUsage(fmt::format("--bounds: needs 6 numbers (MINX,MINY,MINZ,MAXX,MAXY,MAXZ), not {}", values.size()));
    const Eigen::Vector3d low(values[0], values[1], values[2]), high(values[3], values[4], values[5]);
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] > high[axis])
            refuseUsage(fmt::format("--bounds: in {} the minimum {:g} is above the maximum {:g}", "xyz"[axis],
                                    low[axis], high[axis]));
    return {low, high};
}

std::vector<bool> parseClasses(const std::string& option, const std::string& text) {
    std::vector<bool> classes(256);
    eachPart(text, [&](std::string_view part) { markClasses(option, part, classes); });
    return classes;
}

AttributeChoice parseAttributes(const std::string& text) {
    AttributeChoice choice{text == "auto", {}};
    if (choice.all || text == "none") return choice;
    eachPart(text, [&](std::string_view part) {
        if (part.empty()) refuseUsage("--attributes: '" + text + "' has an empty name");
        choice.names.emplace_back(part);
    });
    return choice;
}

Eigen::Affine3d readTransform(const std::string& path) {
    const InputFile source = openInputFile(path);
    std::string_view rest = source.bytes;
    std::vector<double> values;
    while (true) {
        while (!rest.empty() && (isSpace(rest.front()) || rest.front() == ',')) rest.remove_prefix(1);
        if (rest.empty()) break;
        double value = 0;
        const char* const stop = parseNumber(rest.data(), rest.data() + rest.size(), value);
        if (!stop || !std::isfinite(value)) refuseLine(source, rest.data(), "is not a number");
        values.push_back(value);
        rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
        if (values.size() > 16) break;
    }
    if (values.size() != 16) refuse(source, "is not a 4x4 matrix: it needs 16 numbers, row by row");
    Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) refuse(source, "the last row of the matrix is not 0 0 0 1");
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    // the largest determinant for columns of these lengths; less than 1e-12 of it is rounding
    const double largest = linear.colwise().norm().prod();
    if (!(std::abs(linear.determinant()) > 1e-12 * largest)) refuse(source, "the matrix is singular");
    return Eigen::Affine3d(matrix);
}

Eigen::Vector3d parseUp(const std::string& text) {
    if (text == "auto") return Eigen::Vector3d::Zero();
    const auto axis = directionNamed(text);
    if (!axis) refuseUsage("--up: '" + text + "' is not one of auto|x|y|z|-x|-y|-z");
    return Eigen::Vector3d(axis->data());
}

double parseClean(const std::string& text) {
    if (text == "auto") return 1;
    if (text == "off") return 0;
    double strength = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), strength);
    constexpr double kLeast = 0.1, kMost = 10; // from a fraction of the point spacing to more than any feature
    if (error != std::errc() || end != text.data() + text.size() || !(strength >= kLeast && strength <= kMost))
        refuseUsage("--clean: '" + text + "' is not auto, off or a number from 0.1 to 10");
    return strength;
}

} // namespace pointrt
