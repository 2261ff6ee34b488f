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

std::optional<ViewCamera> cameraForAction(Action action, const ViewCamera& camera, const ViewCamera& home,
                                          ViewSize size) {
    switch (action) {
    case Action::kHome:
        return home;
    case Action::kFrontView:
        return fittedView(standardView(camera, StandardView::kFront), size);
    case Action::kRightView:
        return fittedView(standardView(camera, StandardView::kRight), size);
    case Action::kTopView:
        return fittedView(standardView(camera, StandardView::kTop), size);
    case Action::kOppositeView:
        return fittedView(oppositeView(camera), size);
    case Action::kOrthographic:
        return orthoToggled(camera);
    default:
        return std::nullopt;
    }
}

} // namespace pointrt
