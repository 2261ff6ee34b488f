// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <stdexcept>

#include "pointrt/measure.hpp"
#include "runtime/scene/section.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/studies/study_values.h"

namespace pointrt {
namespace {

SectionRequest requestOf(const std::string& text) {
    try {
        return parseSection(text);
    } catch (const std::invalid_argument& reason) {
        refuseUsage(reason.what());
    }
}

} // namespace

SectionPlane sectionPlane(const std::string& text, const Position& up) {
    const SectionRequest request = requestOf(text);
    if (request.thickness)
        refuseUsage(text + ": section lines cannot have a thickness (omit the part after the colon)");
    const Section section = makeSection(request, planFrame({}, up).up);
    // a tilted up is not in the plane, so it is projected onto the plane
    const Vec3 upwards = section.up - dot(section.up, section.side) * section.side;
    const Vec3 in_plane = normalize(upwards);
    return {arrayOf(std::get<ClipPlane>(section.clips.front().form).point), arrayOf(cross(in_plane, section.side)),
            arrayOf(in_plane)};
}

SectionPlane levelPlane(double height, const Position& up) {
    if (!std::isfinite(height)) refuseUsage("the height of a section must be finite");
    const PlanFrame frame = planFrame({}, up);
    return {arrayOf(height * frame.up), arrayOf(frame.east), arrayOf(frame.north)};
}

} // namespace pointrt
