"""Provides the scenes that the tests share, as files and as Python objects."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

LEAVES = np.array(
    [
        [[0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.0]],
        [[0.0, 0.4, 0.0], [0.0, 0.4, 1.0], [1.0, 0.4, 0.0]],
        [[0.3, 0.2, 0.3], [0.3, 0.7, 0.6], [0.7, 0.3, 0.4]],
    ]
)

OBJ = (
    "".join(f"v {x} {y} {z}\n" for x, y, z in LEAVES.reshape(-1, 3))
    + "usemtl leaf\nf 1 2 3\nf 4 5 6\nusemtl stem\nf 7 8 9\n"
)

TABLES = {
    "title": "three leaves",
    "plot": {"size": [1.0, 1.0]},
    "sun": {"elevation": 50.0, "azimuth": 130.0},
    "sky": {"model": "cie-overcast"},
    "band": [{"name": "PAR", "direct": 100.0, "diffuse": 20.0}, {"name": "NIR", "direct": 80.0, "diffuse": 5.0}],
    "soil": {"reflectance": {"PAR": 0.15, "NIR": 0.3}, "patch": 0.25},
    "optics": {
        "leaf": {"reflectance": {"PAR": 0.1, "NIR": 0.4}, "transmittance": {"PAR": 0.05, "NIR": 0.45}},
        "stem": {"reflectance": 0.3},
    },
    "output": {"layers": 4},
    "plane": [{"height": 0.5, "cells": [3, 2]}],
    "sensor": [{"name": "probe", "from": [0.5, 0.3, 0.5], "to": [0.5, 0.9, 0.5], "points": 3}],
}

WORK = {"grid": 0.02, "passes": 8, "device": "cpu"}
OPTIONS = ["--grid", "0.02", "--passes", "8"]


def with_file(tables=TABLES):
    return {**tables, "geometry": [{"file": "leaves.obj"}]}


def with_arrays(tables=TABLES, **more):
    return {**tables, "geometry": [{"vertices": LEAVES, "optics": ["leaf", "leaf", "stem"], **more}]}


@pytest.fixture
def scene_file(tmp_path):
    import tomli_w

    (tmp_path / "leaves.obj").write_text(OBJ)
    file = tmp_path / "scene.toml"
    file.write_text(tomli_w.dumps(with_file()))
    return file


def program(*arguments, status=0):
    """Runs the program."""
    outcome = subprocess.run([os.environ["SUNFLECK_PROGRAM"], *map(str, arguments)], capture_output=True, text=True)
    assert outcome.returncode == status, outcome.stderr
    return outcome


def files_of(folder):
    return {file.name: file.read_bytes() for file in pathlib.Path(folder).iterdir() if file.is_file()}


def body(text):
    """Returns a table without its `#` lines."""
    return "\n".join(line for line in text.splitlines() if not line.startswith("#"))


SOURCE = pathlib.Path(os.environ["SUNFLECK_SOURCE"])
