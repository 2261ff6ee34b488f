// SPDX-License-Identifier: GPL-3.0-or-later
// Which references does one leaf need?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/octree/blend.h"
#include "preprocess/octree/octree.h"
#include "preprocess/octree/probe.h"

namespace pointrt {

/// Probes sent, and how many of them saw the surface change.
struct Audit {
    std::uint64_t probes = 0, changes = 0;
};

/// Prunes leaf by leaf; keeps its scratch arrays from one to the next.
class LeafPruner {
public:
    explicit LeafPruner(const PackedSplats& splats);

    /// kept has one flag for each of the leaf's references; those that are 1 stay, and it sets more: those that cross
    /// the leaf or weigh more than cutoff in it, and what the probes miss.
    /// Sends so many probes, or fewer where hardly anything lies in the leaf.
    Audit run(const Octree& octree, const Leaf& leaf, float cutoff, ProbeSequence sequence, std::uint32_t probes,
              std::span<std::uint8_t> kept);

private:
    /// The first disc that a probe hits, and the side it is seen from.
    struct FirstHit {
        Chord chord;
        std::size_t disc; ///< of the list
        float t;          ///< along the chord
        float radius;
        Vec3f normal; ///< towards the viewer
        float front;  ///< turns oriented normals to the viewer's side
    };
    /// Where the probe meets the blended surface, and the field there.
    struct Blended {
        float t; ///< along the chord
        FieldSums field;
    };

    void gather(const Octree& octree, const Leaf& leaf, std::span<const std::uint8_t> kept);
    void keepNeeded(float cutoff);
    Audit audit(ProbeSequence& sequence, std::uint32_t probes);
    bool probe(const Chord& chord);
    bool blendsAlike(const FirstHit& hit);
    bool weighDropped(const FirstHit& hit, float t);
    FieldSums fieldAround(const FirstHit& hit, bool only_kept) const;
    Blended blend(const FirstHit& hit, bool only_kept);

    const PackedSplats& splats_;
    DiscList list_;                       ///< members first, then references
    std::vector<std::uint32_t> splat_of_; ///< of each disc of the list
    float heaviest_ = 0;                  ///< largest weight of a dropped disc seen by blendsAlike, and whose it is
    std::size_t heaviest_dropped_ = 0;
    std::size_t members_ = 0;
    Box box_;
};

} // namespace pointrt
