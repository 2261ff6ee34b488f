// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the references that a leaf needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/octree/blend.h"
#include "preprocess/octree/octree.h"
#include "preprocess/octree/probe.h"

namespace pointrt {

/// Number of probes, and of those that saw the surface change.
struct Audit {
    std::uint64_t probes = 0, changes = 0;
};

/// Prunes single leaves; reuses its scratch arrays.
class LeafPruner {
public:
    explicit LeafPruner(const PackedSplats& splats);

    /// Sets the flags of the references to keep: those that cross the leaf, have a weight above cutoff in it, or are
    /// missed by probes. Flags already set stay.
    /// @param probes number of probes; fewer are sent if the discs hardly reach into the leaf
    /// @param kept one flag per reference of the leaf
    Audit run(const Octree& octree, const Leaf& leaf, float cutoff, ProbeSequence sequence, std::uint32_t probes,
              std::span<std::uint8_t> kept);

private:
    /// The first disc that a probe hits, and the side from which it is seen.
    struct FirstHit {
        Chord chord;
        std::size_t disc; ///< index in the list
        float t;          ///< along the chord
        float radius;
        Vec3f normal; ///< towards the viewer
        float front;  ///< sign that flips oriented normals to the viewer's side
    };
    /// The hit of a probe on the blended surface, and the field there.
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
    std::vector<std::uint32_t> splat_of_; ///< for each disc of the list
    float heaviest_ = 0;                  ///< largest weight of a dropped disc in blendsAlike, and its index
    std::size_t heaviest_dropped_ = 0;
    std::size_t members_ = 0;
    Box box_;
};

} // namespace pointrt
