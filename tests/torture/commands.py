# SPDX-License-Identifier: Apache-2.0
"""The commands of torture.py: each function case_NAME is a command with inputs as small as possible.

Commands run in a folder with in/, out/, home/, tmp/ and cache/ ($XDG_CACHE_HOME), all of which are checked."""
import dataclasses
import json
import math
import shlex
import typing


def nothing(torture):
    pass


@dataclasses.dataclass
class Case:
    command: list
    prepare: typing.Callable = nothing  # creates the files before the run
    reports: tuple = ()   # JSON files with times, which differ between runs: they must be complete
    whole: tuple = ()     # folders that must be complete or missing
    stays: tuple = ()     # what a failed run may leave behind, to be resumed
    optional: tuple = ()  # files that no run fails for, such as caches
    is_window: bool = False  # reports failures and continues; never uses a file name twice
    environment: dict = dataclasses.field(default_factory=dict)
    most: int = 20        # number of runs of a group without --all


def case_of(name):
    return globals()["case_" + name]()


def names():
    return [name[len("case_"):] for name in globals() if name.startswith("case_") and name != "case_of"]


def of(text, **more):
    return Case(shlex.split(text), **more)


# As on a file system without unnamed files (O_TMPFILE): temporary files have names.
NAMED = {"NTH_CALL_NAMED": "1"}


def write_ball(path, count, offset=0.0):
    """Points spread evenly over a unit sphere."""
    with open(path, "w") as file:
        for i in range(count):
            z = 1 - (2 * i + 1) / count
            r, phi = math.sqrt(1 - z * z), i * 2.399963229728653  # the golden angle
            file.write(f"{offset + r * math.cos(phi):.6f} {r * math.sin(phi):.6f} {z:.6f}\n")


def write_hill(path, count, offset=0.0):
    with open(path, "w") as file:
        for i in range(count):
            x, y = 64 * (i * 0.7548776662466927 % 1), 64 * (i * 0.5698402909980532 % 1)  # Roberts' R2 sequence
            file.write(f"{offset + x:.4f} {y:.4f} {5 * math.sin(x / 9) * math.cos(y / 7):.4f}\n")


def ball(torture):
    write_ball(torture.folder / "in/ball.xyz", 1500)


def two_balls(torture):
    """The inputs, and the output and report of an earlier bake of the other one."""
    ball(torture)
    write_ball(torture.folder / "in/other.xyz", 1200, 3.0)
    torture.tool("pointrt-bake", "-q", "in/other.xyz", "-o", "out/a.pro", "--stats", "out/stats.json")


def case_bake_file():
    return of("pointrt-bake -q in/ball.xyz -o out/a.pro", prepare=ball)


def case_bake_file_named():
    return of("pointrt-bake -q in/ball.xyz -o out/a.pro", prepare=ball, environment=NAMED)


def case_bake_force():
    return of("pointrt-bake -q -f in/ball.xyz -o out/a.pro --stats out/stats.json", prepare=two_balls,
              reports=("out/stats.json",))


def case_bake_force_named():
    return of("pointrt-bake -q -f in/ball.xyz -o out/a.pro --stats out/stats.json", prepare=two_balls,
              reports=("out/stats.json",), environment=NAMED)


# Tile sets: an interrupted bake is resumed.
SET = "pointrt-bake -q in/a.xyz in/b.xyz -o out/site.proset --tile-splats 1000"
SET_PARTS = {"whole": ("out/site.proset",), "stays": ("out/site.proset.work",)}


def hills(torture, points=1500):
    """Two tiles and their parent."""
    write_hill(torture.folder / "in/a.xyz", points)
    write_hill(torture.folder / "in/b.xyz", points, 64.0)


def other_set(torture):
    hills(torture)
    torture.tool(*shlex.split(SET), "--compact")


def begun_set(torture):
    """An incomplete bake with other options."""
    hills(torture)
    for step in ("plan", "split", "block:0"):
        torture.tool(*shlex.split(SET), "--clean", "off", "--step", step)


def case_bake_set():
    return of(SET, prepare=hills, **SET_PARTS)


def case_bake_set_named():
    return of(SET, prepare=hills, environment=NAMED, **SET_PARTS)


def case_bake_set_force():
    return of(SET + " --force", prepare=other_set, **SET_PARTS)


def case_bake_set_anew():
    return of(SET + " --force", prepare=begun_set, **SET_PARTS)


def case_bake_set_steps():
    steps = ("plan", "split", "block:0", "block:1", "levels", "tile:0", "tile:1", "top")
    return Case(["sh", "-c", " && ".join(f"{SET} --step {step}" for step in steps)], most=12, **SET_PARTS,
                prepare=lambda torture: hills(torture, 2500))  # enough for two blocks


# Pictures. Normals replace light: the output has the same size, and a third of the time is spent building programs.
VIEW = "pointrt-view -q in/ball.pro --integrator normal --size 32x32 --spp 1 "
RESUME = "pointrt-view -q in/ball.pro --size 32x32 --integrator path --resume -o out/a.exr "


def ball_pro(torture):
    ball(torture)
    torture.tool("pointrt-bake", "-q", "in/ball.xyz", "-o", "in/ball.pro")


def film(torture):
    """A film with fewer samples than the command will render."""
    ball_pro(torture)
    torture.tool(*shlex.split(RESUME + "--spp 2"))


def three_cameras(torture):
    ball_pro(torture)
    frames = [{"file_path": f"in/{i}.jpg", "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3 + i], [0, 0, 0, 1]]}
              for i in range(2)]
    (torture.folder / "in/list.json").write_text(json.dumps({"w": 32, "h": 32, "fl_x": 30, "frames": frames}))


def two_views(torture):
    ball_pro(torture)
    views = "".join(f'[[view]]\nname = "{x}"\neye = [{x}, 0, 9]\n' for x in range(2))
    (torture.folder / "in/views.toml").write_text(views + '[[instance]]\nfile = "ball.pro"\n')


def bare_ball(torture):
    ball(torture)
    torture.tool("pointrt-bake", "-q", "--compact", "in/ball.xyz", "-o", "in/ball.pro")


def case_view_png():
    return of(VIEW + "-o out/a.png --stats out/stats.json", prepare=ball_pro, reports=("out/stats.json",), most=8)


def case_view_exr():
    return of(VIEW + "-o out/a.exr", prepare=ball_pro, most=8)


def case_view_named():
    return of(VIEW + "-o out/a.png", prepare=ball_pro, environment=NAMED, most=8)


def case_view_resume():
    return of(RESUME + "--spp 4", prepare=film, most=8)


def case_view_path():
    return of("pointrt-view -q in/views.toml --integrator normal --size 32x32 --spp 1 --path 2 -o out/%02d.png", prepare=two_views, most=8)


def case_view_turntable():
    return of(VIEW + "--turntable 2 -o out/%02d.png", prepare=ball_pro, most=8)


def case_view_cameras():
    return of(VIEW.replace("--size 32x32 ", "") + "--cameras in/list.json -o out/set", prepare=three_cameras, most=8)


# A picture, as PNG and film, and the scene.
USER = """pointrt-recording 1 window 64x48 scale 1
0 wait 1
1 key down F12
1 key up F12
2 key down Control
2 key down S
3 key up S
3 key up Control
4 quit
"""


def case_view_window():
    def prepare(torture):
        ball_pro(torture)
        (torture.folder / "in/user.txt").write_text(USER)
    return Case(["sh", "-c", "cd out && exec pointrt-view ../in/ball.pro --replay ../in/user.txt --offscreen --spp 1"],
                prepare=prepare, is_window=True, most=8)


def case_view_cache():
    return of(VIEW + "-o out/a.png", prepare=bare_ball, optional=("cache",), most=8)


# Exports of points.
def case_info_ply():
    return of("pointrt-info in/ball.pro --export out/a.ply", prepare=ball_pro)


def case_info_laz():
    return of("pointrt-info in/ball.pro --export out/a.laz", prepare=ball_pro)


def case_info_force():
    def prepare(torture):
        ball_pro(torture)
        (torture.folder / "out/a.las").write_text("what was there")
    return of("pointrt-info in/ball.pro --export out/a.las --force", prepare=prepare)


# Rays and studies.
def ball_rays(torture):
    ball_pro(torture)
    rays = [f"3 {i % 10 / 5 - 1:g} {i / 50 - 1:g} -1 0.1 0.05" for i in range(100)]
    (torture.folder / "in/rays.txt").write_text("\n".join(rays) + "\n")


def case_rays_npz():
    return of("pointrt-rays cast -q in/ball.pro --rays in/rays.txt -o out/a.npz --stats out/stats.json", prepare=ball_rays,
              reports=("out/stats.json",), most=8)


def case_rays_npy():
    return of("pointrt-rays cast -q in/ball.pro --rays in/rays.txt -o out/a.npy", prepare=ball_rays, most=8)


def case_rays_csv():
    return of("pointrt-rays cast -q in/ball.pro --rays in/rays.txt -o out/a.csv", prepare=ball_rays, most=8)


def case_rays_ply():
    return of("pointrt-rays cast -q in/ball.pro --rays in/rays.txt -o out/a.ply", prepare=ball_rays, most=8)


def case_rays_sun():
    return of("pointrt-rays sun -q in/ball.pro --at 47.37,8.54 --date 2026-06-21 --every 120 -o out/a.laz",
              prepare=ball_pro, most=8)


def case_rays_viewshed():
    return of("pointrt-rays viewshed -q in/ball.pro --from 3,0,1 -o out/a.pro", prepare=ball_pro, most=8)


def case_view_plan():
    return of("pointrt-view -q in/ball.pro --integrator normal --plan 0.05 -o out/a.png", prepare=ball_pro, most=8)


def case_view_plan_tiff():
    return of("pointrt-view -q in/ball.pro --integrator normal --plan 0.05 -o out/a.tif", prepare=ball_pro, most=8)


RIM = "'-1,-1,0 1,-1,0 1,1,0 -1,1,0'"


def case_rays_measure():
    return of(f"pointrt-rays measure -q in/ball.pro --kind volume --points {RIM} --cell 0.1 -o out/a.geojson",
              prepare=ball_pro, most=8)


def case_rays_contours():
    return of("pointrt-rays contours -q in/ball.pro --cell 0.05 -o out/a.svg", prepare=ball_pro, most=8)


def case_rays_profile():
    return of("pointrt-rays profile -q in/ball.pro --line '-1,0 1,0' --step 0.1 -o out/a.svg", prepare=ball_pro, most=8)


def case_rays_section():
    return of("pointrt-rays section -q in/ball.pro --height 0 --step 0.05 -o out/a.svg", prepare=ball_pro, most=8)


def case_rays_compare():
    return of("pointrt-rays compare -q in/ball.pro in/ball.pro -o out/a.ply --stats out/stats.json", prepare=ball_pro,
              reports=("out/stats.json",), most=8)


SENSOR = """[flash]
pixels = [16, 16]
field_of_view_deg = [60, 60]
frame_hz = 30
[range]
max_m = 60
noise_m = 0.02
[intensity]
reflectance = 0.5
"""


def case_rays_lidar():
    def prepare(torture):
        ball_pro(torture)
        (torture.folder / "in/flash.toml").write_text(SENSOR)
    return of("pointrt-rays lidar -q in/ball.pro --sensor in/flash.toml --pose -3,0,0 -o out/a.laz", prepare=prepare,
              most=8)
