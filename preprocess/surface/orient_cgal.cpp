// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/orient_tree.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/mst_orient_normals.h>
#include <numeric>

namespace pointrt::surface {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

// Property maps from a point's index to its values. CGAL copies and reorders the indices, not the points.

struct PointMap {
    using key_type = std::uint32_t;
    using value_type = Kernel::Point_3;
    using reference = value_type;
    using category = boost::readable_property_map_tag;
    const PointSet* points;

    friend reference get(const PointMap& map, key_type i) {
        const Vec3f& p = map.points->positions[i];
        return {p.x(), p.y(), p.z()};
    }
};

struct NormalMap {
    using key_type = std::uint32_t;
    using value_type = Kernel::Vector_3;
    using reference = value_type;
    using category = boost::read_write_property_map_tag;
    PointSet* points;

    friend reference get(const NormalMap& map, key_type i) {
        const Vec3f& n = map.points->normals[i];
        return {n.x(), n.y(), n.z()};
    }
    friend void put(const NormalMap& map, key_type i, const value_type& normal) {
        map.points->normals[i] = {float(normal.x()), float(normal.y()), float(normal.z())};
    }
};

struct SourceMap {
    using key_type = std::uint32_t;
    using value_type = bool;
    using reference = bool;
    using category = boost::readable_property_map_tag;
    const std::vector<std::uint8_t>* sources;

    friend reference get(const SourceMap& map, key_type i) { return (*map.sources)[i] != 0; }
};

} // namespace

void orientByCgal(PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources) {
    std::vector<std::uint32_t> indices(points.size());
    std::iota(indices.begin(), indices.end(), 0u);
    CGAL::mst_orient_normals(indices, unsigned(lists.k),
                             CGAL::parameters::point_map(PointMap{&points})
                                 .normal_map(NormalMap{&points})
                                 .point_is_constrained_map(SourceMap{&sources})
                                 .geom_traits(Kernel{}));
}

} // namespace pointrt::surface
