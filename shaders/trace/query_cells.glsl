// SPDX-License-Identifier: Apache-2.0
// Hardware traversal of one instance: instead of the steps of the walk, ray queries find the boxes of its filled cells,
// in any order. As in the walk, testCell finds the hit in a cell.
#ifndef POINTRT_SHADERS_QUERY_CELLS_GLSL
#define POINTRT_SHADERS_QUERY_CELLS_GLSL
#extension GL_EXT_ray_query : require

layout(set = SET_PAGES, binding = BINDING_CELL_TREE) uniform accelerationStructureEXT cell_tree;
// By cell: its centre and its edge.
layout(std430, set = SET_PAGES, binding = BINDING_CELL_BOXES) restrict readonly buffer CellBoxes { vec4 cell_boxes[]; };

#ifdef ANY_HIT
const uint kQueryFlags = gl_RayFlagsTerminateOnFirstHitEXT;
#else
const uint kQueryFlags = gl_RayFlagsNoneEXT;
#endif

// A candidate of the query as a visit of the walk. Moves the walk to where the ray enters the cell.
Visit visitOf(uint cell, inout Walk walk) {
    vec4 box = cell_boxes[cell];
    vec3 t_planes = (box.xyz + (walk.entry - 0.5) * box.w - walk.origin) * walk.inverse;
    vec3 t_far = t_planes + box.w * walk.pace;
    walk.t = max(max(t_planes.x, t_planes.y), max(t_planes.z, 0.0));
    float t_out = min(t_far.x, min(t_far.y, t_far.z));
    return Visit(entersSlab(walk, loadSlab(cell), box.xyz, box.w, t_out) ? cell : NO_INDEX, box.xyz, box.w);
}

// Updates hit with the nearest hit before t_end; with ANY_HIT, with some hit. The walk does not visit cells that the
// ray enters behind a hit, although their lists may hold a nearer disc, rounded differently. To make the result
// independent of the order of visits, a hit in front of its cell is treated as lying where the ray enters the cell.
void queryCells(Walk walk, TraceRay ray, float t_start, float t_end, inout TraceHit hit) {
    if (!(t_end > 0.0)) return; // an invalid ray, or an empty interval
    float t_limit = hit.t;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, cell_tree, kQueryFlags, 0xFFu, walk.origin, 0.0, walk.direction, t_end);
    while (rayQueryProceedEXT(query)) {
        Visit visit = visitOf(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), walk);
        if (visit.cell == NO_INDEX || walk.t >= t_limit) continue;
        TraceHit found = TraceHit(t_limit, NO_INDEX, NO_INDEX);
        testCell(walk, visit, ray, t_start, found);
        if (found.disc == NO_INDEX) continue;
        hit = found;
        t_limit = max(found.t, walk.t);
        rayQueryGenerateIntersectionEXT(query, min(t_limit, t_end)); // cells extend beyond the end of the walk
    }
}

#endif
