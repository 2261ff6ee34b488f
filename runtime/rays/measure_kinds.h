// SPDX-License-Identifier: Apache-2.0
// The kinds of measurements of pointrt-rays measure, and their results.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pointrt/measure.hpp"
#include "runtime/measure/dxf.h"
#include "runtime/measure/geojson.h"
#include "runtime/rays/result_numbers.h"
#include "runtime/util/names.h"

namespace pointrt {

enum class MeasureKind { kDistance, kHeight, kAngle, kPolyline, kArea, kVolume, kCircle, kSphere };
inline constexpr std::array kMeasureKindNames = {
    Name{"distance", MeasureKind::kDistance}, Name{"height", MeasureKind::kHeight},
    Name{"angle", MeasureKind::kAngle},       Name{"polyline", MeasureKind::kPolyline},
    Name{"area", MeasureKind::kArea},         Name{"volume", MeasureKind::kVolume},
    Name{"circle", MeasureKind::kCircle},     Name{"sphere", MeasureKind::kSphere}};

struct Measured {
    std::vector<ResultNumber> numbers;
    std::vector<Position> points;    ///< as measured
    std::vector<Position> outline;   ///< drawn in place of points unless empty: a circle, or the centre of a sphere
    GeoKind drawn = GeoKind::kPoint; ///< the geometry of points or outline
};

/// All kinds but volumes, which need the scene. Throws Error kBadUsage for a wrong number of points, and TraceError as
/// measurePath and fits do.
Measured measurePoints(MeasureKind kind, const std::vector<Position>& points, const Position& up);

Measured measuredVolume(const Volume& volume, const std::vector<Position>& rim);

/// The contents of output files.
std::string measuredGeoJson(const Measured& measured, const SceneUnits& units);
std::string measuredDxf(const Measured& measured, MeasureKind kind, const SceneUnits& units);

} // namespace pointrt
