// SPDX-License-Identifier: Apache-2.0
// Enumerates the Gaussians along a ray in the order of their peaks, one per call.
//
// A node's list is tested when the walk enters the node, so the peaks of large Gaussians are known long before the ray
// gets there: they wait in a short sorted list. If this list overflows, the farthest hits are dropped, and another walk
// starts from the first dropped hit.
#ifndef POINTRT_SHADERS_GAUSSIAN_HITS_GLSL
#define POINTRT_SHADERS_GAUSSIAN_HITS_GLSL
#include "shaders/trace/gaussian_walk.glsl"

#define FOR_WAITING(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)
#define WAITING 16

struct GaussianHit {
    float t;       // from the start of the GaussianRay
    uint gaussian; // NO_INDEX: none
    float distance_squared;
};

const GaussianHit kNoGaussianHit = GaussianHit(kWalkEnded, NO_INDEX, 0.0);

struct GaussianHits {
    GaussianRay ray;
    GaussianWalk walk;
    uint listed, listed_end; // the rest of the node's list
    float t_in, t_out;       // the part of the ray inside the node
    GaussianHit last;        // the last hit returned
    GaussianHit lost;        // the first hit that was dropped
    GaussianHit waiting[WAITING];
};

bool isBefore(GaussianHit a, GaussianHit b) { return a.t < b.t || (a.t == b.t && a.gaussian < b.gaussian); }

void openList(inout GaussianHits hits, bool opens) {
    bool at_root = hits.walk.number == 0u;
    vec3 exits = exitDistances(hits.walk, hits.ray.origin);
    hits.listed = opens ? hits.walk.node.y : hits.listed;
    hits.listed_end = opens ? hits.walk.node.y + hits.walk.node.z : hits.listed_end;
    // the list of the root also contains the Gaussians that extend out of the cube
    hits.t_in = opens ? (at_root ? -kWalkEnded : hits.walk.t) : hits.t_in;
    hits.t_out = opens ? (at_root ? kWalkEnded : leastOf(exits)) : hits.t_out;
}

// Starts again with the hits after `last`; does not enter nodes that the ray leaves before `last`.
void restart(inout GaussianHits hits, bool enters) {
    hits.walk = startGaussianWalk(hits.ray);
    openList(hits, true);
    float from = max(hits.last.t, 0.0);
    bool inside = enters && from <= leastOf(exitDistances(hits.walk, hits.ray.origin));
    hits.walk.t = inside ? from : kWalkEnded;
    hits.lost = kNoGaussianHit;
#define CLEAR(k) hits.waiting[k] = kNoGaussianHit;
    FOR_WAITING(CLEAR)
}

// Begins with the hit after `last`.
GaussianHits resumeGaussianHits(GaussianRay ray, bool enters, GaussianHit last) {
    GaussianHits hits;
    hits.ray = ray;
    hits.last = last;
    restart(hits, enters);
    return hits;
}

GaussianHits startGaussianHits(GaussianRay ray, bool enters) {
    return resumeGaussianHits(ray, enters, GaussianHit(ray.t_min, NO_INDEX, 0.0));
}

// Hits at or beyond this t are unknown.
float endOf(GaussianHits hits) { return hits.lost.t < hits.ray.t_max ? hits.lost.t : hits.ray.t_max; }

// Whether the walk is over and no list is left to test, so that all hits up to the end are known.
bool hasWalked(GaussianHits hits) { return hits.listed == hits.listed_end && !(hits.walk.t <= endOf(hits)); }

// Walks to the next node with a list.
void nextList(inout GaussianHits hits, bool going) {
    float t_end = endOf(hits);
    bool walks, found = false;
    do {
        walks = going && !found && hits.listed == hits.listed_end && hits.walk.t <= t_end;
        bool enters = moveWalk(hits.walk, hits.ray.origin, walks);
        found = found || (enters && hits.walk.node.z > 0u);
    } while (walks && !found);
    openList(hits, found);
}

// The next peak in the rest of the list, if nearer than the first dropped hit.
GaussianHit nextPeak(inout GaussianHits hits, bool going) {
    GaussianHit found = kNoGaussianHit;
    bool tests = going && hits.listed < hits.listed_end;
    do {
        uint gaussian = loadGaussianListed(tests ? hits.listed : 0u);
        GaussianPeak peak = gaussianPeak(gaussian, hits.ray);
        GaussianHit hit = GaussianHit(peak.t, gaussian, peak.distance_squared);
        bool counts = tests && peak.distance_squared <= 1.0 && peak.t >= hits.t_in && peak.t < hits.t_out &&
                      peak.t < hits.ray.t_max && isBefore(hits.last, hit) && isBefore(hit, hits.lost);
        if (counts) found = hit;
        hits.listed += tests ? 1u : 0u;
        tests = tests && !counts && hits.listed < hits.listed_end;
    } while (tests);
    return found;
}

// Compares all places in parallel: in a chain of comparisons, each would wait for the one before.
void insertHit(inout GaussianHits hits, GaussianHit hit) {
    bool is_nearer[WAITING];
#define COMPARE(k) is_nearer[k] = isBefore(hit, hits.waiting[k]);
    FOR_WAITING(COMPARE)
    GaussianHit dropped = hit;
    if (is_nearer[WAITING - 1]) dropped = hits.waiting[WAITING - 1];
    if (isBefore(dropped, hits.lost)) hits.lost = dropped;
#define PLACE(k)                                                                                                       \
    {                                                                                                                  \
        const int from = WAITING - 1 - (k), before = max(from, 1) - 1;                                                 \
        GaussianHit moved = hit;                                                                                       \
        if (from > 0 && is_nearer[before]) moved = hits.waiting[before];                                               \
        if (is_nearer[from]) hits.waiting[from] = moved;                                                               \
    }
    FOR_WAITING(PLACE)
}

// The first waiting hit if no nearer hit can follow, else none.
GaussianHit takeHit(inout GaussianHits hits, bool going) {
    GaussianHit first = hits.waiting[0];
    bool complete = hits.listed == hits.listed_end;
    float known = complete ? hits.walk.t : hits.t_in; // hits before this are all known
    bool takes = going && first.gaussian != NO_INDEX && first.t < known;
#define SHIFT(k)                                                                                                       \
    if (takes) hits.waiting[k] = (k) + 1 < WAITING ? hits.waiting[min((k) + 1, WAITING - 1)] : kNoGaussianHit;
    FOR_WAITING(SHIFT)
    if (!takes) first = kNoGaussianHit;
    if (takes) hits.last = first;
    return first;
}

// Whether this pass may find more hits.
bool mayContinue(GaussianHits hits) { return !hasWalked(hits) || hits.waiting[0].t < endOf(hits); }

// Returns the next hit along the ray, or kNoGaussianHit if it is not known yet: call again while mayContinue is true.
GaussianHit nextHit(inout GaussianHits hits, bool going) {
    nextList(hits, going);
    insertHit(hits, nextPeak(hits, going));
    if (hasWalked(hits)) hits.walk.t = kWalkEnded;
    return takeHit(hits, going);
}

// Returns whether hits were dropped; if so, starts another pass after the last hit returned.
bool restartIfLost(inout GaussianHits hits, bool enters, bool going) {
    bool again = going && hits.lost.gaussian != NO_INDEX;
    if (again) restart(hits, enters);
    return again;
}

#endif
