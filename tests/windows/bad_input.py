#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gives bad input to the tools of this system and, in Wine, to those for Windows: both must refuse it with the same
message and exit code.
   bad_input.py BIN BUILD COUNT   BIN, BUILD: see lib.sh; run it in a folder with the files that bad_input.sh creates
Each case depends only on its number, so a larger COUNT includes the cases of a smaller one.
"""
import pathlib
import random
import re
import subprocess
import sys

BIN, BUILD, COUNT = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])

# There is no such device: if the input is valid enough to be traced, both tools end there with the same words.
STOP = ["--device", "99"]
CAST = ["pointrt-rays", "cast", "sphere.pro", "--rays", "rays.txt", "-o", "a.csv"]
LIDAR = ["pointrt-rays", "lidar", "sphere.pro", "--sensor", "sensor.toml", "--pose", "3,0,0", "-o", "a.csv"]
VIEW = ["pointrt-view", "sphere.pro", "-o", "a.png"]
BAKE = ["pointrt-bake", "sphere.xyz", "-q", "--force", "-o", "b.pro"]
WORDS = ["", "0", "-1", "nan", "inf", "1e999", "0x10", "word", "99999999999999999999", "1,2", "1;2", "on", "ü", "点", "😀",
         "none/a.json", "folder", '"', "[", "--", "-q", "%s%n", "a" * 300, " ", "\\", "NUL", "con"]
# Not valid as file names in Windows, or names of devices or of the root folder. Windows refuses them too, but not
# always with the same reason: docs/INSTALL.md.
NO_NAMES = {'"', "a" * 300, "con", "NUL", "\\"}
# options that give an answer without input, name this machine's devices, or open a window
LEFT_OUT = {"--help", "--version", "--generate", "--device", "--bake", "--record", "--replay", "--offscreen", "--quiet"}


def options_of(command):
    """The long options that --help lists."""
    text = subprocess.run([BIN / command[0], *command[1:], "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return sorted(set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.M)) - LEFT_OUT)


OPTIONS = {"info": options_of(["pointrt-info"]), "cast": options_of(["pointrt-rays", "cast"]),
           "lidar": options_of(["pointrt-rays", "lidar"]), "view": options_of(["pointrt-view"]),
           "bake": options_of(["pointrt-bake"])}


def changed_text(choose, source, target):
    """One line of the text `source` with a word replaced, dropped or doubled, or cut short."""
    lines = pathlib.Path(source).read_text().splitlines(keepends=True)
    at = choose.randrange(len(lines))
    words = re.split(r"(\W+)", lines[at])
    word = choose.randrange(len(words))
    words[word] = choose.choice(["", words[word] * 2, *WORDS])
    lines[at] = "".join(words)
    if choose.random() < 0.2:
        lines[at] = lines[at][:choose.randrange(len(lines[at]) + 1)]
    pathlib.Path(target).write_text("".join(lines))
    return target


def changed_bytes(choose, source, target, among):
    """`source` cut short, or with bytes replaced among its first `among`."""
    data = bytearray(pathlib.Path(source).read_bytes())
    if choose.random() < 0.3:
        del data[choose.randrange(len(data)):]
    else:
        for _ in range(choose.choice([1, 1, 2, 8])):
            data[choose.randrange(min(among, len(data)))] = choose.choice([0, 1, 127, 128, 255, choose.randrange(256)])
    pathlib.Path(target).write_bytes(data)
    return target


def options(choose):
    command, base = choose.choice([("info", ["pointrt-info", "sphere.pro"]), ("cast", CAST), ("lidar", LIDAR), ("view", VIEW),
                                   ("view", ["pointrt-view", "scene.toml", "-o", "a.exr"]), ("bake", BAKE), ("bake", BAKE)])
    stop = {"info": ["none.pro"], "bake": ["none.ply"]}.get(command, STOP)
    return base + [choose.choice(OPTIONS[command]), choose.choice(WORDS)] + stop


def misspelt(choose):
    command = list(choose.choice([["pointrt-info", "sphere.pro", "--verify"], CAST, LIDAR, VIEW, BAKE]))
    at = choose.randrange(1, len(command))
    command[at] = choose.choice([command[at][:-1], command[at] + "x", command[at].upper(), *WORDS])
    return command + {"pointrt-info": ["none.pro"], "pointrt-bake": ["none.ply"]}.get(command[0], STOP)


def scan(choose):
    header = 4096  # the header, the section table and the first sections
    file = changed_bytes(choose, "sphere.pro", "changed.pro", choose.choice([512, header, 1 << 30]))
    return choose.choice([["pointrt-info", file, "--verify"], ["pointrt-info", file, "--json"],
                          ["pointrt-info", file, "--export", "b.ply", "--force"],
                          ["pointrt-rays", "cast", file, "--rays", "rays.txt", "-o", "a.csv", *STOP]])


def cloud(choose):
    kind = choose.choice(["xyz", "ply", "pcd", "las"])
    source, target = f"sphere.{kind}", f"changed.{kind}"
    file = changed_text(choose, source, target) if kind == "xyz" else changed_bytes(choose, source, target, 400)
    return ["pointrt-bake", file, *BAKE[2:]]


def transform(choose):
    return [*BAKE, "--transform", changed_text(choose, "transform.txt", "changed_transform.txt")]


def rays(choose):
    file = changed_bytes(choose, "rays.npy", "changed.npy", 128) if choose.random() < 0.4 else \
        changed_text(choose, "rays.txt", "changed.txt")
    return ["pointrt-rays", "cast", "sphere.pro", "--rays", file, "-o", "a.csv", *STOP]


def scene(choose):
    return ["pointrt-view", changed_text(choose, "scene.toml", "changed.toml"), "-o", "a.png", *STOP]


def sensor(choose):
    return ["pointrt-rays", "lidar", "sphere.pro", "--sensor", changed_text(choose, "sensor.toml", "sensor_changed.toml"),
            "--pose", "3,0,0", "-o", "a.csv", *STOP]


def cameras(choose):
    return ["pointrt-view", "sphere.pro", "--cameras", changed_text(choose, "cameras.json", "changed.json"), "-o", "pictures",
            *STOP]


KINDS = [options, misspelt, scan, cloud, rays, scene, sensor, cameras, transform]


def answer(program, arguments):
    result = subprocess.run([*program, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            timeout=300, check=False)
    # Windows joins paths with \
    return result.returncode, result.stdout.replace(b"\\", b"/"), result.stderr.replace(b"\\", b"/")


def main():
    refused, differing = 0, []
    for number in range(COUNT):
        choose = random.Random(number)
        tool, *arguments = KINDS[number % len(KINDS)](choose)
        here = answer([BIN / tool], arguments)
        there = answer(["wine", BUILD / "bin" / f"{tool}.exe"], arguments)
        refused += here[0] in (1, 2, 3, 4)
        if here != there and not (NO_NAMES & set(arguments) and there[0] in (1, 2, 3, 4)):
            differing.append(f"case {number}: {tool} {arguments}\n  here:    {here}\n  Windows: {there}")
    print("\n".join(differing))
    print(f"{COUNT} cases, {refused} refused, {len(differing)} answered otherwise in Windows")
    sys.exit(bool(differing) or refused < 0.7 * COUNT)  # changed words may be valid; most are not


main()
