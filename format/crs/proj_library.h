// SPDX-License-Identifier: Apache-2.0
// Uses PROJ without linking to it: the tools run where it is not installed, and load it only to interpret a coordinate
// system.
#pragma once

#include <proj.h>
#include <proj_experimental.h> // creates systems from their parts; GDAL depends on it, too

namespace pointrt {

/// Every function of PROJ 9 that is called; to use another one, add its name here.
#define POINTRT_PROJ_FUNCTIONS(X)                                                                                      \
    X(proj_context_create)                                                                                             \
    X(proj_context_destroy)                                                                                            \
    X(proj_context_get_database_path)                                                                                  \
    X(proj_context_set_enable_network)                                                                                 \
    X(proj_create_cartesian_2D_cs)                                                                                     \
    X(proj_create_crs_to_crs_from_pj)                                                                                  \
    X(proj_create_from_database)                                                                                       \
    X(proj_create_from_wkt)                                                                                            \
    X(proj_create_projected_crs)                                                                                       \
    X(proj_crs_get_coordinate_system)                                                                                  \
    X(proj_crs_get_coordoperation)                                                                                     \
    X(proj_crs_get_sub_crs)                                                                                            \
    X(proj_cs_get_axis_info)                                                                                           \
    X(proj_destroy)                                                                                                    \
    X(proj_factors)                                                                                                    \
    X(proj_get_area_of_use)                                                                                            \
    X(proj_get_id_auth_name)                                                                                           \
    X(proj_get_id_code)                                                                                                \
    X(proj_get_name)                                                                                                   \
    X(proj_get_prime_meridian)                                                                                         \
    X(proj_get_source_crs)                                                                                             \
    X(proj_get_type)                                                                                                   \
    X(proj_log_level)                                                                                                  \
    X(proj_prime_meridian_get_parameters)                                                                              \
    X(proj_trans)

struct ProjLibrary {
#define POINTRT_DECLARE_PROJ(name) decltype(&::name) name = nullptr;
    POINTRT_PROJ_FUNCTIONS(POINTRT_DECLARE_PROJ)
#undef POINTRT_DECLARE_PROJ
};

/// Opens libproj.so.25 (PROJ 9) on the first call; nullptr if it is not installed.
const ProjLibrary* projLibrary();

} // namespace pointrt
