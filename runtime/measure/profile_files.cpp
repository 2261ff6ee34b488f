// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/profile_files.h"

#include <algorithm>

#include "runtime/measure/decimal_text.h"
#include "runtime/measure/dxf.h"
#include "runtime/measure/profile_runs.h"

namespace pointrt {
namespace {

constexpr const char* kProfileLayer = "profile";

std::string csvRow(const ProfileDrawing& profile, const ProfilePoint& point, bool has_layers) {
    const auto number = [&](double value) { return "," + decimalText(value, profile.decimals); };
    const auto height = [&](double value) { return point.hit ? number(value) : std::string(","); };
    std::string row = decimalText(point.station, profile.decimals) + number(point.position[0]) +
                      number(point.position[1]) + height(point.position[2]) + height(point.height);
    if (has_layers) row += "," + (point.hit ? std::to_string(point.layer) : "");
    if (profile.has_band) row += height(point.low) + height(point.high);
    return row + "\n";
}

} // namespace

bool hasLayers(const std::vector<ProfilePoint>& points) {
    return std::ranges::any_of(points, [](const ProfilePoint& point) { return point.layer > 0; });
}

std::vector<std::vector<ProfilePoint>> profileRuns(const std::vector<ProfilePoint>& points) {
    std::vector<std::vector<ProfilePoint>> runs;
    bool is_open = false;
    for (const ProfilePoint& point : points) {
        if (point.hit && !is_open) runs.emplace_back();
        if (point.hit) runs.back().push_back(point);
        is_open = point.hit;
    }
    return runs;
}

std::string profileCsv(const ProfileDrawing& profile) {
    const bool has_layers = hasLayers(profile.points);
    std::string text = "station,x,y,z,height";
    text += has_layers ? ",layer" : "";
    text += profile.has_band ? ",low,high\n" : "\n";
    for (const ProfilePoint& point : profile.points) text += csvRow(profile, point, has_layers);
    return text;
}

std::string profileDxf(const ProfileDrawing& profile) {
    const bool has_layers = hasLayers(profile.points);
    std::vector<DxfEntity> entities;
    for (const std::vector<ProfilePoint>& run : profileRuns(profile.points)) {
        const bool is_line = !has_layers && run.size() > 1;
        entities.push_back({is_line ? DxfEntity::Kind::kPolyline : DxfEntity::Kind::kPoints, kProfileLayer, {}});
        for (const ProfilePoint& point : run) entities.back().positions.push_back(point.position);
    }
    return dxfText(entities, profile.decimals);
}

} // namespace pointrt
