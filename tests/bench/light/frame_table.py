# SPDX-License-Identifier: Apache-2.0
"""Compares frame times with Mitsuba and Cycles: frame_table.py BIN_DIR FOLDER, called by frames.sh in FOLDER's Python.

The programs run alternately on the same cores. Prints Markdown: milliseconds for the same samples, their noise, the time
for equal noise, and frame times relative to the times that trace_speed needs for the same rays.

Noise is the variance between seeds, averaged over the pixels, which equals the mean squared error relative to a converged
picture; light is clipped at white. The time for equal noise is time times variance.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

import pictures

HERE = pathlib.Path(__file__).resolve().parent
# The kind of trace_speed's rays that is most like a scene's secondary rays.
FURTHER = {"room": "diffuse", "studio": "diffuse", "mirrors": "mirror", "glass": "mirror"}
SEEDS = 2  # one degree of freedom in each of 262,144 pixels


def command(options, program, scene):
    """The command that renders a scene, without options for frames or pictures."""
    json_path = str(options.folder / f"{scene}.json")
    if program == "ours":
        integrator = json.loads(pathlib.Path(json_path).read_text())["integrator"]
        return [str(options.bin / "pointrt-view"), str(options.folder / f"{scene}.toml"), "--integrator", integrator,
                "--spp", str(options.spp), "--caustics", "off", "--denoise", "off", "--quiet"]
    return [sys.executable, str(HERE / f"frame_{program}.py"), json_path, "--spp", str(options.spp)]


def run(words):
    """The standard output of a command."""
    done = subprocess.run(words, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: exit code {done.returncode}")
    return done.stdout


def turn(options, program, scene):
    """Medians of one run."""
    words = command(options, program, scene)
    text = run(words + ["--bench" if program == "ours" else "--frames", str(options.frames)])
    values = json.loads(text[text.index("{"):])
    if program == "ours":
        return {"ms": values["frame_ms"]["median"], "cpu_ms": values["frame_cpu_ms"]["median"],
                **{key: values[key] for key in ("rays", "device", "splats")}}
    return {key: statistics.median(values[key]) for key in ("ms", "cpu_ms")}


def renderPictures(options, program, scene):
    prefix = str(options.folder / f"{scene}.{program}.")
    words = command(options, program, scene)
    if program == "ours":
        for seed in range(SEEDS):
            run(words + ["--seed", str(seed), "-o", f"{prefix}{seed}.exr"])
    else:
        run(words + ["--pictures", prefix, "--seeds", str(SEEDS)])
    return np.stack([pictures.readLight(f"{prefix}{seed}.exr") for seed in range(SEEDS)])


def measure(options, scene):
    """For each program: times of all runs, variance and mean light."""
    found = {program: {"ms": [], "cpu_ms": []} for program in options.programs}
    for _ in range(options.turns):
        for program, times in found.items():
            taken = turn(options, program, scene)
            for key in ("ms", "cpu_ms"):
                times[key].append(taken.pop(key))
            times |= taken
    for program, values in found.items():
        light = renderPictures(options, program, scene)
        values["variance"] = float(np.clip(light, 0, 1).var(axis=0, ddof=1).mean())
        values["light"] = float(np.clip(light.mean(axis=0), 0, 1).mean())
    return found


def spread(values):
    return f"{statistics.median(values):.0f} ({min(values):.0f} to {max(values):.0f})"


def rowsOf(scene, found):
    ours = found["ours"]
    for program, values in found.items():
        wall, cpu = statistics.median(values["ms"]), statistics.median(values["cpu_ms"])
        same_samples = wall / statistics.median(ours["ms"])
        same_noise = same_samples * values["variance"] / ours["variance"]
        same_work = cpu * values["variance"] / (statistics.median(ours["cpu_ms"]) * ours["variance"])
        yield (f"| {scene} | {program} | {spread(values['ms'])} | {spread(values['cpu_ms'])} | {same_samples:.2f} | "
               f"{1e3 * values['variance']:.3f} | {same_noise:.2f} | {same_work:.2f} | "
               f"{values['light'] / ours['light']:.4f} |")


def printFrames(options, all_found):
    print("Ratios are theirs to ours: above 1 we are faster.\n")
    print("| scene | program | ms a frame (spread of turns) | processor ms | same samples | variance x 1000 | same noise | "
          "same noise, processor | light |\n|---|---|---|---|---|---|---|---|---|")
    for scene, found in all_found.items():
        print("\n".join(rowsOf(scene, found)))


def raySpeeds(options):
    """Million rays per second by kind, without and with blended surfaces."""
    text = run([str(options.bin / "trace_speed"), str(options.folder / "mesh.pro"), "--json", "--size",
                   str(options.size), "--runs", str(options.turns)])
    return {row["rays"]: (row["mrays_per_second"], row["ratio_blended"] * row["embree_mrays_per_second"])
            for row in json.loads(text)}


def printFactors(all_found, speeds):
    print("\nA frame beside the sum of its rays' own times, by trace_speed on the scan alone:\n")
    print("| scene | rays (camera / shadow / further), M | frame, ms | their own time, ms | factor | blended, ms | factor |")
    print("|---|---|---|---|---|---|---|")
    for scene, found in all_found.items():
        rays = found["ours"]["rays"]
        kinds = {"primary": rays["primary"], "shadow": rays["shadow"]}
        kinds[FURTHER[scene]] = rays["secondary"]
        frame = statistics.median(found["ours"]["ms"])
        plain, blended = (sum(count / speeds[kind][i] / 1e3 for kind, count in kinds.items()) for i in range(2))
        counts = " / ".join(f"{count / 1e6:.1f}" for count in rays.values())
        print(f"| {scene} | {counts} | {frame:.0f} | {plain:.0f} | {frame / plain:.2f} | {blended:.0f} | "
              f"{frame / blended:.2f} |")


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "an unnamed processor"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scenes", nargs="+", default=list(FURTHER), choices=list(FURTHER))
    parser.add_argument("--programs", nargs="+", default=["ours", "mitsuba", "cycles"])
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--frames", type=int, default=1, help="of a turn, after one that is not counted")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--size", type=int, default=512)
    options = parser.parse_args()
    os.environ["LP_NUM_THREADS"] = str(len(os.sched_getaffinity(0)))  # lavapipe ignores affinity
    began = time.monotonic()
    all_found = {scene: measure(options, scene) for scene in options.scenes}
    (options.folder / "frames.json").write_text(json.dumps(all_found, indent=1))
    ours = next(iter(all_found.values()))["ours"]
    print(f"{len(os.sched_getaffinity(0))} cores of {processor()}, {ours['device']}; {options.size} x {options.size}, "
          f"{options.spp} samples; {ours['splats']:,} splats beside the mesh they were sampled from; "
          f"{options.turns} turns, {time.monotonic() - began:.0f} s.\n")
    printFrames(options, all_found)
    printFactors(all_found, raySpeeds(options))


if __name__ == "__main__":
    main()
