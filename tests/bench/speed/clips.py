#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The cost of clips: the minimum processor time of 20 frames of 256x256 pixels, one sample, with shadows. Each round
has four runs: an earlier pointrt-view, and the current one without a clip, with a box around everything, and with a box
that removes the front half. Prints the median of each, and the median of its ratio to the earlier one in the same
round.

usage: clips.py FORMER_VIEW VIEW ROUNDS SCAN EYE TARGET BOX_AROUND BOX_BEHIND"""
import json
import statistics
import subprocess
import sys


def least_cpu_ms(view, options):
    command = [view, *options, "-q", "--size", "256x256", "--spp", "1", "--bench", "20"]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)["frame_cpu_ms"]["min"]


def main():
    former, view, rounds, scan, eye, target, around, behind = sys.argv[1:]
    scene = [scan, "--eye=" + eye, "--target=" + target]
    runs = {"former": (former, scene), "no clip": (view, scene), "box around": (view, [*scene, "--clip=" + around]),
            "box behind": (view, [*scene, "--clip=" + behind])}
    times = {name: [] for name in runs}
    for _ in range(int(rounds)):
        for name, (program, options) in runs.items():
            times[name].append(least_cpu_ms(program, options))
    for name, each in times.items():
        quotients = [now / before for now, before in zip(each, times["former"])]
        print(f"{name}: {statistics.median(each):.1f} ms, {statistics.median(quotients):.3f} of the former", flush=True)


main()
