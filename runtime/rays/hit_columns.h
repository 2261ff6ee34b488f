// SPDX-License-Identifier: Apache-2.0
// Hits as columns, from which every output format is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// One or several numbers of one type for each ray.
struct HitColumn {
    std::string name;
    std::uint32_t type = 0;          ///< PRO_TYPE_*
    std::uint32_t components = 1;    ///< numbers per ray
    bool is_flag = false;            ///< a byte, 0 or 1
    bool is_attribute = false;       ///< an attribute of the scan, with the scan's name for it
    std::vector<std::byte> values{}; ///< of all rays of a block

    std::size_t rowBytes() const;
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

/// t_hit, splat_ids, instance_ids, tile_ids (scenes with tile sets only), normals, positions, then these attributes of
/// the scene. Throws Error kBadUsage for unknown attributes.
std::vector<HitColumn> hitColumns(const TraceScene& scene, const std::vector<std::string>& attributes);
/// The one column of --any: hit.
std::vector<HitColumn> occlusionColumns();

const HitColumn& columnNamed(std::span<const HitColumn> columns, const std::string& name);

/// The message for a name that is not among `all`.
std::string unknownAttribute(const std::string& name, const std::vector<SceneAttribute>& all);

/// The column's name with _ in place of characters that file headers do not allow; attributes may have any name.
std::string headerName(const HitColumn& column);

/// Casts rays and fills the columns, which come from hitColumns or occlusionColumns. Returns the number of hits. Throws
/// TraceError.
std::size_t fillColumns(const TraceScene& scene, const RayRows& rays, const RayLimits& limits,
                        std::span<HitColumn> columns);

} // namespace pointrt
