// SPDX-License-Identifier: Apache-2.0
// One interface to Embree 3 and 4, whose calls differ in their arguments besides the rays.
#pragma once

#if POINTRT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace pointrt::embree {

enum class Coherence { kNone, kCoherent };

#if POINTRT_EMBREE_MAJOR >= 4

constexpr RTCRayQueryFlags flagsFor(Coherence coherence) {
    return coherence == Coherence::kCoherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
}

/// Context shared by the calls of a thread.
struct IntersectOptions {
    RTCIntersectArguments arguments;
    explicit IntersectOptions(Coherence coherence) {
        rtcInitIntersectArguments(&arguments);
        arguments.flags = flagsFor(coherence);
    }
};
struct OccludedOptions {
    RTCOccludedArguments arguments;
    explicit OccludedOptions(Coherence coherence) {
        rtcInitOccludedArguments(&arguments);
        arguments.flags = flagsFor(coherence);
    }
};

inline void intersect1(RTCScene scene, IntersectOptions& options, RTCRayHit& query) {
    rtcIntersect1(scene, &query, &options.arguments);
}
inline void intersect8(const int* valid, RTCScene scene, IntersectOptions& options, RTCRayHit8& query) {
    rtcIntersect8(valid, scene, &query, &options.arguments);
}
inline void occluded1(RTCScene scene, OccludedOptions& options, RTCRay& query) {
    rtcOccluded1(scene, &query, &options.arguments);
}
inline void occluded8(const int* valid, RTCScene scene, OccludedOptions& options, RTCRay8& query) {
    rtcOccluded8(valid, scene, &query, &options.arguments);
}

#else

/// Context shared by the calls of a thread.
struct IntersectOptions {
    RTCIntersectContext context;
    explicit IntersectOptions(Coherence coherence) {
        rtcInitIntersectContext(&context);
        if (coherence == Coherence::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
};
using OccludedOptions = IntersectOptions;

inline void intersect1(RTCScene scene, IntersectOptions& options, RTCRayHit& query) {
    rtcIntersect1(scene, &options.context, &query);
}
inline void intersect8(const int* valid, RTCScene scene, IntersectOptions& options, RTCRayHit8& query) {
    rtcIntersect8(valid, scene, &options.context, &query);
}
inline void occluded1(RTCScene scene, OccludedOptions& options, RTCRay& query) {
    rtcOccluded1(scene, &options.context, &query);
}
inline void occluded8(const int* valid, RTCScene scene, OccludedOptions& options, RTCRay8& query) {
    rtcOccluded8(valid, scene, &options.context, &query);
}

#endif

} // namespace pointrt::embree
