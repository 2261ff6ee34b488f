// SPDX-License-Identifier: Apache-2.0
// The Gaussians of several instances that wait to be composited along a ray, nearest first.
#ifndef POINTRT_SHADERS_WAITING_GAUSSIANS_GLSL
#define POINTRT_SHADERS_WAITING_GAUSSIANS_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/trace/gaussian_end.glsl"

uint placeOf(WaitingGaussian waiting) { return waiting.instance & 0xFFFFu; }

// Whether a comes before b along the ray; for coinciding peaks, in the order of instances and of their Gaussians.
bool isBefore(WaitingGaussian a, WaitingGaussian b) {
    uint place_a = placeOf(a), place_b = placeOf(b);
    bool is_lower = place_a != place_b ? place_a < place_b : a.gaussian < b.gaussian;
    return a.t < b.t || (a.t == b.t && is_lower);
}

void startRounds(uint path) {
    waiting_gaussians[path].last_t = 0.0;
    waiting_gaussians[path].last_instance = 0xFFFFu; // peaks at the origin of the ray do not count
    waiting_gaussians[path].last_gaussian = NO_INDEX;
}

// The last Gaussian composited, with only the values that determine its place in the order.
WaitingGaussian lastComposited(uint path) {
    return WaitingGaussian(waiting_gaussians[path].last_t, waiting_gaussians[path].last_gaussian,
                           waiting_gaussians[path].last_instance, 0u, 0u, 0u);
}

void setLastComposited(uint path, WaitingGaussian last) {
    waiting_gaussians[path].last_t = last.t;
    waiting_gaussians[path].last_instance = placeOf(last);
    waiting_gaussians[path].last_gaussian = last.gaussian;
}

// Inserts a Gaussian if it is among the nearest. Returns the t beyond which none can be inserted.
float insertWaiting(uint path, WaitingGaussian added, bool waits, inout uint count) {
    const uint last = WAITING_GAUSSIANS - 1u;
    bool full = count > last;
    waits = waits && !(full && isBefore(waiting_gaussians[path].each[last], added));
    uint place = full ? last : count;
    bool moves;
    do {
        uint before = max(place, 1u) - 1u;
        WaitingGaussian other = waiting_gaussians[path].each[before];
        moves = waits && place > 0u && isBefore(added, other);
        if (moves) waiting_gaussians[path].each[place] = other;
        place = moves ? before : place;
    } while (moves);
    if (waits) waiting_gaussians[path].each[place] = added;
    count += waits && !full ? 1u : 0u;
    return count > last ? waiting_gaussians[path].each[last].t : kWalkEnded;
}

#endif
