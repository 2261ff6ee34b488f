// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find over points, with the parity that makes it orient normals.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace pointrt::surface {

/// Sets of points, each point knowing whether it is flipped against its set's root.
class ParitySets {
public:
    explicit ParitySets(std::size_t count);

    /// The root of a point's set, and whether the point is flipped against it.
    std::pair<std::uint32_t, bool> find(std::uint32_t point);
    /// Joins the sets of a and b so that b is flipped against a exactly when flipped says so; false, and nothing
    /// done, when they are in one set already.
    bool join(std::uint32_t a, std::uint32_t b, bool flipped);

private:
    std::vector<std::uint32_t> parent_; ///< of a root: itself
    std::vector<std::uint8_t> flipped_; ///< against the parent
    std::vector<std::uint8_t> rank_;
};

} // namespace pointrt::surface
