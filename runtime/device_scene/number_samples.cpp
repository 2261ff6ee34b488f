// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/number_samples.h"

#include <set>

#include "runtime/device_scene/color_choice.h"

namespace pointrt {
namespace {

constexpr std::size_t kSampled = std::size_t{1} << 18;
/// Limit for listing integers as choices; if there are more, they form a range. LAS files of all vendors have fewer
/// classes.
constexpr std::size_t kMostValues = 32;

/// What a first pass over the numbers finds, before the histogram.
struct NumberSurvey {
    std::optional<ValueRange> range;
    std::set<double> integers; ///< stops at one more than kMostValues
    bool only_integers = true;
};

void add(NumberSurvey& survey, double number) {
    if (!survey.range) survey.range = {number, number};
    survey.range->low = std::min(survey.range->low, number);
    survey.range->high = std::max(survey.range->high, number);
    survey.only_integers = survey.only_integers && number == std::round(number);
    if (survey.only_integers && survey.integers.size() <= kMostValues) survey.integers.insert(number);
}

/// Calls visit(number) for all numbers that word names, not for a sample: a rare class must not be missed.
template <typename Visit>
void visitAll(const std::vector<PlacedScan>& scans, const std::string& word, Vec3 up, const Visit& visit) {
    for (const PlacedScan& scan : scans)
        if (const auto source = numbersFor(scan, word, up)) visitNumbers(scan, *source, 1, visit);
}

} // namespace

std::vector<PlacedScan> representativesOf(const std::vector<PlacedScan>& scans) {
    std::vector<PlacedScan> representatives;
    for (PlacedScan scan : scans) {
        if (scan.root) scan.file = scan.root;
        if (!scan.root || representatives.empty() || representatives.back().instance != scan.instance)
            representatives.push_back(scan);
    }
    return representatives;
}

std::size_t stepThrough(const std::vector<PlacedScan>& scans) {
    std::size_t count = 0;
    for (const PlacedScan& scan : scans) count += scan.file->info.splat_count;
    return std::max<std::size_t>(1, count / kSampled);
}

NumberHistogram histogramOf(const std::vector<PlacedScan>& scans, const std::string& word, Vec3 up) {
    const std::vector<PlacedScan> representatives = representativesOf(scans);
    NumberSurvey survey;
    visitAll(representatives, word, up, [&](double number) { add(survey, number); });
    if (!survey.range) return {};
    NumberHistogram histogram{*survey.range, std::vector<float>(kHistogramBins), {}};
    if (survey.only_integers && survey.integers.size() <= kMostValues)
        histogram.values.assign(survey.integers.begin(), survey.integers.end());
    const double low = survey.range->low, width = std::max(survey.range->high - low, 1e-300), bins = kHistogramBins;
    visitAll(representatives, word, up, [&](double number) {
        histogram.shares[static_cast<std::size_t>(std::min((number - low) / width * bins, bins - 1))] += 1;
    });
    const float most = *std::max_element(histogram.shares.begin(), histogram.shares.end());
    for (float& share : histogram.shares) share /= most;
    return histogram;
}

} // namespace pointrt
