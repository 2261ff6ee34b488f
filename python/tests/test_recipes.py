# SPDX-License-Identifier: Apache-2.0
"""Runs the commands and snippets of docs/RECIPES.md on a small scan of the same name."""
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import pointrt

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the recipes are commands of a Unix shell")

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
SECTIONS = dict(re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", (DOCS / "RECIPES.md").read_text("utf-8"), re.M | re.S))
CODE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)

#: Checks of the snippets' results.
CHECKS = {
    "Solar study of a roof": lambda it: it["hours"][it["high"]].mean() > it["hours"][~it["high"]].mean() > 0,
    "Shadows of a day": lambda it: it["pictures"][0].mean() > it["pictures"][1].mean() > 0,
    "Line of sight from a tower": lambda it: 0.05 < it["seen"].mean() < 0.95,
    "Simulated lidar of a street": lambda it: it["hits_per_splat"].sum() == len(it["points"]["ranges"]) >
                                              len(it["first_light_sample"]) > 1000,
    "Plan, profile and volume of a stadium": lambda it: np.nanmax(it["bowl"]["heights"]) > 480 and
                                                       it["field"]["fill"] > 5 * it["field"]["covered"] * 0.6,
    "Synthetic training data": lambda it: 0.2 < np.isfinite(it["picture"]["depth"]).mean() <= 1,
}


def stadium_points():
    """Level ground with a ring of blocks at the place of the stadium, [N, 5]: x, y, z, class, intensity."""
    x, y = np.meshgrid(np.arange(636850.0, 637980, 14), np.arange(851370.0, 852560, 14))
    away = np.hypot(x - 637430, y - 851960)
    raised = (away > 250) & (away < 400)
    columns = x, y, np.where(raised, 500.0, 420.0), np.where(raised, 6, 2), np.full(x.shape, 200)
    return np.column_stack([each.ravel() for each in columns])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the inputs of the recipes: stadium.laz, and the sensors of the docs."""
    tool = os.environ.get("POINTRT_BAKE")
    if not tool:
        pytest.skip("POINTRT_BAKE does not name the tools")
    at = tmp_path_factory.mktemp("recipes")
    np.savetxt(at / "made.csv", stadium_points(), "%.2f,%.2f,%.2f,%d,%d",
               header="x,y,z,classification,intensity", comments="")
    pointrt.bake(at / "made.csv", output=at / "made.pro", clean="off", up="z")
    subprocess.run([pathlib.Path(tool).parent / "pointrt-info", at / "made.pro", "--export", at / "made.las"], check=True)
    (at / "made.las").rename(at / "stadium.laz")  # the content decides the format
    (at / "docs").symlink_to(DOCS)
    return at


@pytest.mark.parametrize("title", SECTIONS)
def test_a_recipe_runs(title, folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("PATH", f"{pathlib.Path(os.environ['POINTRT_BAKE']).parent}:{os.environ['PATH']}")
    parts = CODE.findall(SECTIONS[title])
    assert [kind for kind, _ in parts].count("python") >= 1
    names = {}
    for kind, text in parts:
        if kind == "python":
            exec(compile(text, title, "exec"), names)  # trusted: from the docs
        else:
            done = subprocess.run(["bash", "-e"], input=text, text=True, capture_output=True)
            assert done.returncode == 0, done.stderr
    assert CHECKS[title](names)
    for picture in re.findall(r"-o (\S+\.png)", SECTIONS[title]):
        made = list(folder.glob(re.sub(r"\$\w+", "*", picture)))  # a name may hold a variable of the shell
        assert made and all(each.read_bytes().startswith(b"\x89PNG") for each in made)
