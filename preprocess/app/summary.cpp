// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "format/base/up_text.h"

namespace pointrt {
namespace {

using Counts = std::vector<std::pair<std::uint64_t, const char*>>;

/// "1 not finite, 2 outliers" of the counts above 0.
std::string listOf(const Counts& counts) {
    std::string text;
    for (const auto& [count, what] : counts)
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    return text;
}

std::uint64_t sumOf(const Counts& counts) {
    std::uint64_t sum = 0;
    for (const auto& [count, what] : counts) sum += count;
    return sum;
}

Counts leftOut(const BakeReport& report) {
    return {{report.points_non_finite, "not finite"},
            {report.points_unused, "not used by a face"},
            {report.points_filtered, "filtered out"},
            {report.points_no_data, "without data"},
            {report.points_withheld, "withheld"},
            {report.surface.duplicates_removed + report.merged, "duplicates"},
            {report.surface.outliers_removed, "outliers"},
            {report.surface.clean_dropped, "off the surface"}};
}

/// The number of points before any was left out, as far as they were counted.
std::uint64_t pointsBefore(const BakeReport& report) {
    return report.input_points + (report.points_sampled > 0 ? report.points_unused : 0);
}

/// " (--clean off and --outliers keep turn this off)", with the options that apply.
std::string adviceOn(const BakeReport& report) {
    const bool cleaned = report.surface.clean_dropped + report.surface.clean_moved + report.filled > 0;
    const bool stray = report.surface.outliers_removed > 0;
    if (cleaned && stray) return "; to leave points as they are, use --clean off and --outliers keep";
    if (cleaned) return "; --clean off leaves points as they are";
    return stray ? "; use --outliers keep to keep the outliers" : "";
}

/// "12.3 MB"; thousands of bytes below 1 MB.
std::string sizeText(std::uint64_t bytes) {
    const auto size = static_cast<double>(bytes);
    return bytes < 1'000'000 ? fmt::format("{:.1f} kB", size / 1e3) : fmt::format("{:.1f} MB", size / 1e6);
}

std::string formatsOf(const BakeReport& report) {
    std::vector<std::string> formats;
    for (const FileReport& file : report.files)
        if (std::find(formats.begin(), formats.end(), file.format) == formats.end()) formats.push_back(file.format);
    return fmt::format("{}", fmt::join(formats, ", "));
}

/// A warning if pruning exceeds --prune-harm, or nothing.
std::string pruningWarning(const BakeReport& report) {
    const PruneReport& pruning = report.pruning;
    if (pruning.harm_bound <= report.harm_allowed) return {};
    return fmt::format(
        "; pruning may change {:.2g} of the hits, more than the allowed {:.2g} (--prune off disables it)",
        pruning.harm_bound, report.harm_allowed);
}

} // namespace

std::string inputLine(const BakeReport& report) {
    if (report.files.size() == 1) return fileLine(report.files.front());
    FileReport all{fmt::format("{} files", report.files.size()), formatsOf(report)};
    for (const FileReport& file : report.files) {
        all.points += file.points;
        all.kept += file.kept;
        all.scans += file.scans;
        all.sampled += file.sampled;
        all.seconds += file.seconds;
    }
    return fileLine(all);
}

std::string changesLine(const BakeReport& report) {
    const Counts left_out = leftOut(report);
    std::vector<std::string> changes;
    if (const std::uint64_t count = sumOf(left_out))
        changes.push_back(fmt::format("left out {} of {} points ({})", count, pointsBefore(report), listOf(left_out)));
    if (const std::size_t count = report.surface.clean_moved)
        changes.push_back(fmt::format("moved {} to smooth noise", count));
    if (report.filled > 0) changes.push_back(fmt::format("added {} splats to close gaps", report.filled));
    if (const std::size_t count = report.surface.seen_through)
        changes.push_back(fmt::format("shrank {} discs through which a scanner saw farther points", count));
    if (report.balls > 0)
        changes.push_back(fmt::format("turned {} points that lie on no surface into balls", report.balls));
    if (changes.empty()) return "every point became a splat: none was left out, moved or added";
    return fmt::format("{}{}", fmt::join(changes, "; "), adviceOn(report));
}

std::string summaryLine(const BakeReport& report) {
    const Vec3d& up = report.world.up;
    const std::string up_text = upText({up.x(), up.y(), up.z()}, report.up_from, report.up_reason);
    return fmt::format("{} splats, {}, {:.2f} s", report.splats, sizeText(report.octree.file_bytes),
                       report.seconds_total) +
           (up_text.empty() ? "" : "; " + up_text) + pruningWarning(report);
}

std::string octreeLine(const BakeReport& report) {
    const auto per_splat = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(report.splats); };
    return fmt::format("{} filled leaves, references per splat {:.2f} -> {:.2f}, {} bytes ({:.1f} per splat)",
                       report.octree.filled_leaves, per_splat(report.references_unpruned),
                       per_splat(report.octree.references), report.octree.file_bytes,
                       per_splat(report.octree.file_bytes));
}

} // namespace pointrt
