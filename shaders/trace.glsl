// SPDX-License-Identifier: Apache-2.0
// Stackless traversal. A grid of entry points stands for the octree's upper levels: an empty cell says for each
// direction octant how many cells can be skipped, a filled one names its node. From the node down the tree is walked
// by the bits of the position. Positions are carried as 21-bit integers, and a step sets the coordinate of the axis it
// leaves by to the neighbour's exactly: no epsilon, no cell visited twice, none jumped over.
//
// Loops are written as while over state declared before them: lavapipe's do-while loses values (see tests), and an
// inner loop per phase keeps lanes that wait from costing a turn of the other phase.

struct TraceHit {
    float t;    // along the ray; unchanged when nothing is hit
    uint leaf;  // whose list the hit's surroundings are in, NO_INDEX when nothing is hit
    uint splat;
};

// A ray and what its own surface is: hits nearer than own_t on discs facing like own_normal are ignored.
struct TraceRay {
    vec3 origin;
    vec3 direction;
    float t_max;
    vec3 own_normal;
    float own_t;
};

const int kFullDepth = int(PRO_POSITION_BITS);
const int kLastCell = int(PRO_POSITION_MASK);

// Distance to the disc along the ray, or t_limit where it is missed, not nearer, or the ray's own surface.
float hitSplat(uvec4 words, vec3 origin, TraceRay ray, float own_t, float t_min, float t_limit) {
    vec3 normal = splatDirection(words);
    vec3 to_center = splatPosition(words) - origin;
    float t = dot(normal, to_center) / dot(normal, ray.direction);
    vec3 offset = ray.direction * t - to_center;
    float radius = splatRadius(words);
    float facing = dot(normal, ray.own_normal);
    bool own = t < own_t && facing * facing > 0.25 * dot(normal, normal);
    return dot(offset, offset) < radius * radius && t >= t_min && t < t_limit && !own ? t : t_limit;
}

// Cells to skip from an empty grid cell: the nibble of the ray's direction octant.
int skipCells(uint word, uint octant) { return int((word >> (4u * octant)) & 15u); }

TraceHit trace(TraceRay ray) {
    vec3 direction = mix(ray.direction, vec3(1e-20), equal(ray.direction, vec3(0.0)));
    vec3 inverse = 1.0 / direction;
    ivec3 forward = ivec3(greaterThan(direction, vec3(0.0)));
    uint octant = uint(forward.x | forward.y << 1 | forward.z << 2);
    int grid_bits = int(params.grid.x);

    // Start at the cube's border: from a distant eye t would leave too few bits for the splat test.
    vec3 near = (vec3(1 - forward) - ray.origin) * inverse;
    vec3 far = (vec3(forward) - ray.origin) * inverse;
    float t_start = max(max(near.x, near.y), max(near.z, 0.0));
    float t_end = min(min(far.x, far.y), far.z);
    vec3 origin = ray.origin + ray.direction * t_start;
    float own_t = ray.own_t - t_start;

    TraceHit hit = TraceHit(ray.t_max - t_start, NO_INDEX, NO_INDEX);
    bool inside = t_start <= t_end && hit.t > 0.0;
    ivec3 position = clamp(ivec3(origin * PRO_POSITION_STEPS), ivec3(0), ivec3(kLastCell));
    uint last_leaf = NO_INDEX;
    float t = 0.0;

    while (inside) {
        uint leaf_index = NO_INDEX;
        while (inside && leaf_index == NO_INDEX) {
            int shift = kFullDepth - grid_bits;
            ivec3 cell = position >> shift;
            uint word = loadGrid(((cell.z << grid_bits) | cell.y) << grid_bits | cell.x);
            int skip = skipCells(word, octant);
            bool filled = (word & 15u) == 0u;
            // exit planes of the box from here to the end of the skipped cells
            ivec3 plane = (cell + (filled ? forward : forward * (2 * skip - 1) - (skip - 1))) << shift;
            if (filled) {
                uint node = loadNode(word >> 4);
                while ((node & PRO_NODE_INNER) != 0u && shift > 0) {
                    shift--;
                    ivec3 bits = (position >> shift) & 1;
                    node = loadNode((node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE +
                                    uint(bits.x | bits.y << 1 | bits.z << 2));
                }
                plane = ((position >> shift) + forward) << shift;
                leaf_index = node - 1u; // an empty leaf becomes NO_INDEX
            }
            vec3 t_planes = (vec3(plane) * PRO_POSITION_STEP - origin) * inverse;
            float t_exit = max(min(t_planes.x, min(t_planes.y, t_planes.z)), t);
            bvec3 leaving = lessThanEqual(t_planes, vec3(t_exit));
            // where the ray leaves, kept on this side on the axes it does not leave by
            ivec3 exit_cell = ivec3((origin + direction * t_exit) * PRO_POSITION_STEPS);
            ivec3 limit = plane - forward;
            ivec3 ahead = mix(max(exit_cell, position), min(exit_cell, position), equal(forward, ivec3(0)));
            ahead = mix(min(ahead, limit), max(ahead, limit), equal(forward, ivec3(0)));
            position = mix(ahead, plane + forward - 1, leaving);
            t = t_exit;
            inside = all(greaterThanEqual(position, ivec3(0))) && all(lessThanEqual(position, ivec3(kLastCell))) &&
                     (t < hit.t || leaf_index != NO_INDEX);
        }
        uvec4 leaf = leaf_index == NO_INDEX ? uvec4(0u) : loadLeaf(leaf_index);
        last_leaf = leaf_index == NO_INDEX ? last_leaf : leaf_index;
        uint count = listLength(leaf);
        uint k = 0u;
        while (k < count) {
            uint splat = listedSplat(leaf, k);
            float t_hit = hitSplat(loadSplat(splat), origin, ray, own_t, -t_start, hit.t);
            if (t_hit < hit.t) {
                hit.t = t_hit;
                hit.splat = splat;
#ifdef ANY_HIT
                inside = false;
                count = 0u;
#endif
            }
            k++;
        }
        inside = inside && t < hit.t;
    }
    hit.leaf = hit.splat == NO_INDEX ? NO_INDEX : last_leaf;
    hit.t += t_start;
    return hit;
}
