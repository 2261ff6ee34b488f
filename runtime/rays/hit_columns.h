// SPDX-License-Identifier: Apache-2.0
// What is told of hits, column by column: the one list that all outputs are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// A few numbers of one type for each ray.
struct HitColumn {
    std::string name;
    std::uint32_t type = 0;          ///< PRO_TYPE_*
    std::uint32_t components = 1;    ///< numbers of a ray
    bool is_flag = false;            ///< a byte, 0 or 1
    bool is_attribute = false;       ///< of the scan, by its name there
    std::vector<std::byte> values{}; ///< of a block's rays

    std::size_t rowBytes() const;
    /// For count rays.
    void resize(std::size_t count) { values.resize(count * rowBytes()); }
    template <typename Number>
    std::span<Number> as() {
        return {reinterpret_cast<Number*>(values.data()), values.size() / sizeof(Number)};
    }
    template <typename Number>
    std::span<const Number> as() const {
        return {reinterpret_cast<const Number*>(values.data()), values.size() / sizeof(Number)};
    }
};

/// t_hit, splat_ids, instance_ids, where the scene has sets tile_ids, normals, positions, then the scene's attributes
/// of these names. Throws Error kBadUsage where it has none of a name.
std::vector<HitColumn> hitColumns(const TraceScene& scene, const std::vector<std::string>& attributes);
/// hit alone.
std::vector<HitColumn> anyColumns();

const HitColumn& columnNamed(std::span<const HitColumn> columns, const std::string& name);

/// The column's name as other programs' headers take it: attributes' may hold anything.
std::string headerName(const HitColumn& column);

/// Fills columns, as hitColumns or anyColumns made them, with what becomes of the rays. Returns how many hit. Throws
/// TraceError.
std::size_t fillColumns(const TraceScene& scene, const RayRows& rays, const RayLimits& limits,
                        std::span<HitColumn> columns);

} // namespace pointrt
