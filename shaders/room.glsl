// SPDX-License-Identifier: Apache-2.0
// The box around the scene, the sky and the materials of both.

// Distance to the room's wall from inside; normal points into the room.
float hitRoom(vec3 origin, vec3 direction, out vec3 normal) {
    vec3 wall = mix(params.room_lo.xyz, params.room_hi.xyz, greaterThan(direction, vec3(0.0)));
    vec3 t = mix((wall - origin) / direction, vec3(1e30), equal(direction, vec3(0.0)));
    float nearest = max(min(t.x, min(t.y, t.z)), 0.0);
    bvec3 axis = lessThanEqual(t, vec3(nearest));
    normal = axis.x ? vec3(-sign(direction.x), 0.0, 0.0)
                    : (axis.y ? vec3(0.0, -sign(direction.y), 0.0) : vec3(0.0, 0.0, -sign(direction.z)));
    return nearest;
}

const vec3 kMatteWall = vec3(0.42, 0.42, 0.43);
// Silvered glass gives back nine tenths, a little less of the blue at every turn.
const vec3 kMirrorWall = vec3(0.90, 0.90, 0.88);

const vec3 kSkyZenith = vec3(SKY_ZENITH);
const vec3 kSkyHorizon = vec3(SKY_HORIZON);
const vec3 kSkyGround = vec3(SKY_GROUND);

// What a ray that leaves the scene sees, and the ambient light from its direction.
vec3 skyColor(vec3 direction) {
    float height = dot(direction, params.sky_up.xyz);
    return mix(kSkyHorizon, height > 0.0 ? kSkyZenith : kSkyGround, sqrt(abs(height)));
}
