# SPDX-License-Identifier: Apache-2.0
"""The scenes of all renderers. The world has y up; colours are linear. Quad lamps emit light to the side of u x v. Their
other side may emit light, too: nothing sees it, as walls end below the lamps.

A scene is a dict:
  camera     eye, target, up, fov (vertical, degrees)
  materials  by name: kind (matte, mirror, metal, glass), color, roughness, index
  instances  mesh (of meshes.MAKERS), material, translate, scale
  shapes     quads: center, u, v (half edges), material
  lights     quad: center, u, v, radiance; sphere: center, radius, radiance
  sky        radiance from all around
  exposure   what the linear picture is multiplied by before it is encoded
  caustic    the picture has only the light that mirrors and glass focus onto the floor
  size       pixels of a side, instead of the option's
"""

BOUNCES = 16  # beyond which less than 1 in 1000 of the light is left in each of these scenes

CAMERA = {"eye": [0.3, 2.6, 7.2], "target": [0.1, 0.95, 0], "up": [0, 1, 0], "fov": 36}

WHITE = {"kind": "matte", "color": [0.73, 0.73, 0.73]}
RED = {"kind": "matte", "color": [0.63, 0.07, 0.05]}
GREEN = {"kind": "matte", "color": [0.12, 0.45, 0.12]}
BLUE = {"kind": "matte", "color": [0.15, 0.28, 0.65]}
WALLS = {"white": WHITE, "red": RED, "green": GREEN}


def quad(center, u, v, material):
    return {"type": "quad", "center": center, "u": u, "v": v, "material": material}


FLOOR = quad([0, 0, 0], [6, 0, 0], [0, 0, -8], "white")
ROOM = [
    FLOOR,
    quad([0, 2.4, -3], [6, 0, 0], [0, 2.4, 0], "white"),
    quad([-3.2, 2.4, 0], [0, 0, -8], [0, 2.4, 0], "red"),
    quad([3.2, 2.4, 0], [0, 0, -8], [0, 2.4, 0], "green"),
]

QUAD_LAMP = {"type": "quad", "center": [0.5, 5.2, 1], "u": [1.2, 0, 0], "v": [0, 0, 1.2], "radiance": [14, 13, 11.5]}
# Large and low: only paths that hit the lamp by chance find the light that glass focuses.
BROAD_LAMP = {"type": "quad", "center": [0.5, 5, 0.5], "u": [2, 0, 0], "v": [0, 0, 2], "radiance": [5, 4.8, 4.4]}
BALL_LAMP = {"type": "sphere", "center": [-2.4, 4.6, 2.6], "radius": 0.6, "radiance": [42, 40, 36]}


def pair(first, first_material, second_material):
    """A knot or blob at the left and a sphere at the right, both standing on the floor."""
    return [
        {"mesh": first, "material": first_material, "translate": [-1.05, 1.13, -0.2], "scale": 1},
        {"mesh": "sphere", "material": second_material, "translate": [1.25, 0.851, 0.3], "scale": 0.85},
    ]


def scene(materials, instances, shapes, lights, sky=(0, 0, 0), exposure=1, camera=CAMERA):
    return {
        "camera": camera,
        "materials": materials,
        "instances": instances,
        "shapes": shapes,
        "lights": lights,
        "sky": list(sky),
        "exposure": exposure,
        "bounces": BOUNCES,
    }


# So dark that it reflects next to no light to the bodies.
DARK = {"kind": "matte", "color": [0.02, 0.02, 0.02]}
GLASS = {"kind": "glass", "color": [1, 1, 1], "index": 1.5}
SMALL_LAMP = {"type": "sphere", "radius": 0.25, "radiance": [1000, 1000, 1000]}


def causticScene(bodies, material, lamp, eye, target, fov, exposure):
    """Bodies (instances, shapes) over a dark floor and a small lamp; the camera looks at the floor."""
    instances, shapes = bodies
    camera = {"eye": eye, "target": target, "up": [0, 0, -1], "fov": fov}
    light = SMALL_LAMP | {"center": lamp}
    common = scene({"white": DARK, **material}, instances, [FLOOR, *shapes], [light], (0, 0, 0), exposure, camera)
    return common | {"caustic": True, "size": 256}


def causticBall(bodies):
    """The floor is beyond the ball's focus."""
    return causticScene(bodies, {"glass": GLASS}, [-3, 4.2, 0], [5.5, 3, 0], [1.2, 0, 0], 17, BALL_EXPOSURE)


BALL_EXPOSURE, RING_EXPOSURE = 0.9, 3  # the brightest pixels come to about 1
BALL = {"mesh": "sphere", "material": "glass", "translate": [0, 1.3, 0], "scale": 0.85}
EXACT_BALL = {"type": "sphere", "center": BALL["translate"], "radius": BALL["scale"], "material": "glass"}
RING = {"mesh": "ring", "material": "mirror", "translate": [0, 0, 0], "scale": 1}

SCENES = {
    "diffuse": scene(
        {**WALLS, "orange": {"kind": "matte", "color": [0.75, 0.32, 0.08]}, "blue": BLUE},
        pair("knot", "orange", "blue"), ROOM, [QUAD_LAMP],
    ),
    "mirror": scene(
        {**WALLS, "mirror": {"kind": "mirror", "color": [0.9, 0.9, 0.9]}},
        pair("knot", "mirror", "mirror"), ROOM, [QUAD_LAMP], sky=(0.35, 0.42, 0.55),
    ),
    "metal": scene(
        {**WALLS, "gold": {"kind": "metal", "color": [1, 0.71, 0.29], "roughness": 0.3},
         "steel": {"kind": "metal", "color": [0.56, 0.57, 0.58], "roughness": 0.5}},
        pair("knot", "gold", "steel"), ROOM, [QUAD_LAMP], sky=(0.35, 0.42, 0.55),
    ),
    "glass": scene(
        {**WALLS, "glass": GLASS},
        pair("blob", "glass", "glass"), ROOM, [BROAD_LAMP], sky=(0.25, 0.3, 0.4), exposure=0.6,
    ),
    "soft-shadow": scene(
        {"white": WHITE, "orange": {"kind": "matte", "color": [0.75, 0.32, 0.08]}, "blue": BLUE},
        pair("knot", "orange", "blue"), [FLOOR], [BALL_LAMP],
    ),
    "sky": scene(
        {"white": WHITE, "orange": {"kind": "matte", "color": [0.75, 0.32, 0.08]}, "blue": BLUE},
        pair("knot", "orange", "blue"), [FLOOR], [], sky=(0.8, 0.9, 1),
    ),
    "caustic-glass": causticBall(([BALL], [])),
    "caustic-exact-glass": causticBall(([], [EXACT_BALL])),
    "caustic-ring": causticScene(
        ([RING], []), {"mirror": {"kind": "mirror", "color": [0.9, 0.9, 0.9]}},
        [4, 2.4, 0], [-0.45, 7, 0], [-0.45, 0, 0], 11.5, RING_EXPOSURE,
    ),
}
