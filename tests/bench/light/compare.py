# SPDX-License-Identifier: Apache-2.0
"""Compares a picture with its reference: compare.py SCENE.json REFERENCE.exr TEST.exr OUT [--first-hits HITS.exr]

Both are multiplied by the scene's exposure, clipped and sRGB encoded. Writes OUT.json and the pictures
OUT.reference.png, OUT.test.png, OUT.flip.png (FLIP: black equal, yellow far off) and OUT.difference.png (grey equal, 4
times test minus reference), and prints a row of a Markdown table; --heading prints the table's head instead. With the
reference's first hits, FLIP is also given by part: each instance, outlines (2 pixels wide), the rest. For scenes with
"caustic" only the layer caustic of the test is compared, or its whole picture if it has none, on the floor only (needs
first hits); then the parts are bright (encoded reference above half of white), faint (above a tenth) and dark.
"""

import argparse
import json
import pathlib

import flip_evaluator
import numpy as np

import pictures
from compare_first_hits import nextTo

HEADING = """| picture | FLIP | 99% of pixels below | RMSE | light, test/reference | shift (px) | by part |
|---|---|---|---|---|---|---|"""
DIFFERENCE_GAIN = 4


def flip(reference, test):
    """FLIP of each pixel of two encoded pictures (Andersson et al. 2020), at its standard 67 pixels a degree."""
    as_float = (np.ascontiguousarray(picture, np.float32) for picture in (reference, test))
    errors, _, _ = flip_evaluator.evaluate(*as_float, "LDR", applyMagma=False)
    return errors[..., 0]


def shift(reference, test):
    """The displacement of test in pixels (right, down): one step of Lucas and Kanade over the whole picture."""
    reference, test = reference.mean(axis=2), test.mean(axis=2)
    down, right = np.gradient(reference)
    slopes = np.stack([right.ravel(), down.ravel()], axis=1)
    moved, *_ = np.linalg.lstsq(slopes, (reference - test).ravel(), rcond=None)
    return moved.tolist()


def outlines(number):
    """Pixels whose neighbour in x or y shows another object."""
    edge = np.zeros(number.shape, bool)
    across, down = number[:, 1:] != number[:, :-1], number[1:] != number[:-1]
    edge[:, 1:] |= across
    edge[:, :-1] |= across
    edge[1:] |= down
    edge[:-1] |= down
    return edge


def parts(scene, first_hits):
    """Masks by name."""
    number = pictures.readChannels(first_hits, ["ID"])[..., 0]
    edge = outlines(number)
    masks = {item["mesh"]: (number == i + 1) & ~edge for i, item in enumerate(scene["instances"])}
    return masks | {"outlines": edge, "rest": (number == 0) & ~edge}


def onFloor(first_hits):
    """Pixels of the floor y = 0 that are at least 2 pixels from other objects."""
    up = pictures.readChannels(first_hits, ["N.Y"])[..., 0] > 0.999
    bodies = pictures.readChannels(first_hits, ["ID"])[..., 0] > 0
    return ~nextTo(nextTo(bodies | ~up))


def brightnessParts(encoded, floor):
    brightness = encoded.mean(axis=2)
    return {"bright": floor & (brightness > 0.5), "faint": floor & (brightness > 0.1) & (brightness <= 0.5),
            "dark": floor & (brightness <= 0.1)}


def read(scene, path):
    """The light of the picture that is compared."""
    layer = "caustic." if "caustic" in scene and pictures.hasChannel(path, "caustic.R") else ""
    return pictures.readLight(path, layer)


def measure(reference, test, exposure):
    """Figures, and the FLIP of each pixel."""
    encoded, encoded_test = pictures.encode(reference, exposure), pictures.encode(test, exposure)
    errors = flip(encoded, encoded_test)
    figures = {
        "flip": float(errors.mean()),
        "flip_99": float(np.quantile(errors, 0.99)),
        "rmse": float(np.sqrt(np.mean((encoded_test - encoded) ** 2))),
        "light": float(test.mean() / reference.mean()),
        "shift_px": shift(encoded, encoded_test),
        "exposure": exposure,
        "not_finite": int(np.count_nonzero(~np.isfinite(test))),
    }
    return figures, errors


def writePictures(out, reference, test, errors, exposure):
    encoded, encoded_test = pictures.encode(reference, exposure), pictures.encode(test, exposure)
    pictures.writePng(f"{out}.reference.png", encoded)
    pictures.writePng(f"{out}.test.png", encoded_test)
    pictures.writePng(f"{out}.difference.png", 0.5 + DIFFERENCE_GAIN / 2 * (encoded_test - encoded))
    pictures.writePng(f"{out}.flip.png", heat(errors))


def heat(errors):
    """A colour map from black over red to yellow with increasing brightness."""
    return np.stack([np.clip(2 * errors, 0, 1), np.clip(2 * errors - 0.6, 0, 1), np.clip(4 * errors - 3, 0, 1)], axis=2)


def row(name, figures):
    by_part = ", ".join(f"{part} {value:.3f}" for part, value in figures.get("flip_by_part", {}).items())
    right, down = figures["shift_px"]
    return (f"| {name} | {figures['flip']:.4f} | {figures['flip_99']:.3f} | {figures['rmse']:.4f} | "
            f"{figures['light']:.4f} | {right:+.2f}, {down:+.2f} | {by_part} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path, nargs="?")
    parser.add_argument("reference", nargs="?")
    parser.add_argument("test", nargs="?")
    parser.add_argument("out", type=pathlib.Path, nargs="?")
    parser.add_argument("--first-hits")
    parser.add_argument("--heading", action="store_true")
    options = parser.parse_args()
    if options.heading:
        print(HEADING)
        return
    if not options.out:
        parser.error("SCENE.json REFERENCE.exr TEST.exr OUT are needed")
    scene = json.loads(options.scene.read_text())
    if "caustic" in scene and not options.first_hits:
        parser.error(f"{options.scene}: a caustic alone needs --first-hits")
    reference, test = read(scene, options.reference), read(scene, options.test)
    if reference.shape != test.shape:
        raise SystemExit(f"{options.test}: {test.shape[:2]} pixels, the reference has {reference.shape[:2]}")
    if "caustic" in scene:
        floor = onFloor(options.first_hits)
        reference, test = reference * floor[..., None], test * floor[..., None]
    figures, errors = measure(reference, test, scene["exposure"])
    if options.first_hits:
        masks = (brightnessParts(pictures.encode(reference, scene["exposure"]), floor) if "caustic" in scene
                 else parts(scene, options.first_hits))
        figures["flip_by_part"] = {name: float(errors[mask].mean()) for name, mask in masks.items() if mask.any()}
    writePictures(options.out, reference, test, errors, scene["exposure"])
    pathlib.Path(f"{options.out}.json").write_text(json.dumps(figures, indent=1) + "\n")
    print(row(options.out.name, figures))


if __name__ == "__main__":
    main()
