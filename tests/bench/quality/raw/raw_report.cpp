// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/raw/raw_report.h"

#include <fmt/format.h>

namespace pointrt::quality {

namespace {

using Json = nlohmann::ordered_json;

double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Format of a figure: title, factor, digits.
struct Column {
    const char *key, *title;
    double factor;
    int digits;
};
constexpr Column kColumns[] = {{"outline_iou", "IoU", 1, 4},         {"normal_mean", "normal", 1, 2},
                               {"normal_p99", "p99", 1, 1},          {"depth_off", "depth%", 100, 2},
                               {"holes_per_million", "holes", 1, 0}, {"false_surface", "false%", 100, 3},
                               {"floating", "float%", 100, 3}};

std::string cellsOf(const Json& figures) {
    std::string cells;
    for (const Column& column : kColumns)
        cells += fmt::format(" {:>7.{}f}", column.factor * figures.at(column.key).get<double>(), column.digits);
    return cells;
}

} // namespace

Json figuresOf(const PictureErrors& errors) {
    const Summary normals = summarize(errors.normal_degrees);
    return {{"outline_iou", ratio(errors.both, errors.either)},
            {"normal_mean", normals.mean},
            {"normal_p99", normals.p99},
            {"depth_off", ratio(errors.depth_off, errors.both)},
            {"holes_per_million", 1e6 * ratio(errors.holes, errors.inside)},
            {"false_surface", ratio(errors.false_surface, errors.picture)},
            {"floating", ratio(errors.floating, errors.picture)}};
}

Json meanOf(const std::vector<Json>& figures) {
    Json mean = figures.front();
    for (auto& [key, value] : mean.items()) {
        double sum = 0;
        for (const Json& one : figures) sum += one.at(key).get<double>();
        value = sum / static_cast<double>(figures.size());
    }
    return mean;
}

std::string lineOf(const std::string& name, const Json& all, const Json& seen) {
    return fmt::format("{:<24}{}  |{}\n", name, cellsOf(all), cellsOf(seen));
}

std::string titleLine() {
    std::string titles;
    for (const Column& column : kColumns) titles += fmt::format(" {:>7}", column.title);
    return fmt::format("{:<24}{}  |{}  (of what was seen)\n", "", titles, titles);
}

} // namespace pointrt::quality
