// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/camera_commands.h"

namespace pointrt {

std::optional<ViewCamera> cameraAfter(const Command& command, const ViewCamera& camera, ViewSize size) {
    if (const auto* c = std::get_if<OrbitCommand>(&command)) return orbited(camera, size, c->dx, c->dy);
    if (const auto* c = std::get_if<LookCommand>(&command)) return looked(camera, size, c->dx, c->dy);
    if (const auto* c = std::get_if<PanCommand>(&command)) return panned(camera, size, c->dx, c->dy);
    if (const auto* c = std::get_if<ZoomCommand>(&command)) return zoomed(camera, size, c->steps, c->x, c->y);
    return std::nullopt;
}

std::optional<ViewCamera> cameraForAction(Action action, const ViewCamera& camera, const ViewCamera& home) {
    switch (action) {
    case Action::kHome:
        return home;
    case Action::kFrontView:
        return standardView(camera, StandardView::kFront);
    case Action::kRightView:
        return standardView(camera, StandardView::kRight);
    case Action::kTopView:
        return standardView(camera, StandardView::kTop);
    case Action::kOppositeView:
        return oppositeView(camera);
    case Action::kOrthographic:
        return orthoToggled(camera);
    default:
        return std::nullopt;
    }
}

} // namespace pointrt
