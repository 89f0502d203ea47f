"""Tests arrays, which are views of the result's memory, xarray, folders, and memory use."""

import ctypes
import gc
import os
import pickle
import sys

import numpy as np
import pytest
import sunfleck
from conftest import TABLES, WORK, files_of, with_arrays


@pytest.fixture(scope="module")
def result():
    return sunfleck.run(with_arrays(), **WORK)


def test_columns_are_views(result):
    first, second = result._outcome.triangles(), result._outcome.triangles()
    for name, column in first.items():
        if isinstance(column, np.ndarray):
            assert np.shares_memory(column, second[name]), name
            assert not column.flags.writeable
            assert column.shape == (3,)


def test_views_outlive_their_result():
    column = sunfleck.run(with_arrays(), **WORK)["PAR_absorbed"]
    expected = column.copy()
    gc.collect()
    junk = [np.full(3, i, dtype=float) for i in range(10000)]
    assert np.array_equal(column, expected) and len(junk) == 10000


def test_xarray(result):
    data = result.to_xarray()
    assert data.sizes == {"triangle": 3, "vertex": 3, "plane_height": 5, "band": 2, "sensor_point": 3, "sensor": 1}
    assert np.array_equal(data["NIR_absorbed"], result["NIR_absorbed"])
    assert data["NIR_absorbed"].attrs["units"] == "W m-2"
    corners = [data[f"corner_{axis}"].transpose("triangle", "vertex") for axis in "xyz"]
    assert np.array_equal(np.stack(corners, axis=2), result.corners)
    assert float(data["absorbed_soil"].sel(band="PAR")) == result.bands["PAR"]["absorbed_soil"]
    assert np.array_equal(data["PAR_down"], result.profile["PAR_down"])
    assert "absorbed" not in data and "sunlit_leaf_fraction" not in data


def test_sensors_of_netcdf_are_those_of_xarray(result, tmp_path):
    xarray = pytest.importorskip("xarray")
    result.save(tmp_path / "out", export=["nc"])
    data = result.to_xarray()
    with xarray.open_dataset(tmp_path / "out" / "results.nc") as stored:
        names = {name for name in stored.variables if name.startswith("sensor_")}
        assert names == {name for name in data.variables if name.startswith("sensor_")}
        for name in names - {"sensor_name", "sensor_point_name"}:
            assert np.array_equal(stored[name], data[name]), name
            assert stored[name].attrs["units"] == data[name].attrs["units"], name
        assert stored["sensor_point_name"].values.tolist() == data["sensor_point_name"].values.tolist() == ["probe"] * 3
        assert stored["sensor_name"].values.tolist() == data["sensor_name"].values.tolist() == ["probe"]


def test_totals_and_means_of_sensors(result):
    (probe,) = result.sensors
    means = result.sensor_means
    assert means["sensor"].tolist() == ["probe"] and means["points"].tolist() == [3]
    for band in ("PAR", "NIR"):
        total = probe[f"{band}_direct"] + probe[f"{band}_sky"] + probe[f"{band}_scattered"]
        assert np.allclose(probe[f"{band}_total"], total, rtol=1e-12)
        assert np.allclose(means[f"{band}_total"], total.mean(), rtol=1e-12)
        assert 0.0 < means[f"{band}_total_error"][0] < probe[f"{band}_total_error"].max()


def test_an_error_is_named_after_its_column(result):
    tables = [result.triangles, result.organs, result.plants, result.profile, *result.sensors, result.sensor_means]
    errors = [(table, name) for table in tables for name in table if name.endswith("_error")]
    assert len(errors) > 30
    for table, name in errors:
        assert np.shape(table[name]) == np.shape(table[name.removesuffix("_error")]), name


def test_every_column_is_described(result):
    for table, rows_only, columns in (
        ("organs.csv", [], result.organs),
        ("plants.csv", [], result.plants),
        ("profile.csv", [], result.profile),
        ("triangles.csv", ["triangle"], result.triangles),
        ("sensors.csv", ["sensor", "point"], {name: values for name, values in result.sensors[0].items() if name != "name"}),
        ("sensor_means.csv", [], result.sensor_means),
    ):
        described = result.describe(table)
        assert list(described) == rows_only + list(columns), table
        assert all(meaning for _, meaning in described.values()), table
        header = next(line for line in result.table(table).splitlines() if not line.startswith("#"))
        assert set(header.split(",")) <= set(described), table
    assert result.describe("triangles.csv")["triangle"] == ("1", "number of the triangle, in the order of the files")
    assert result.describe("sensors.csv")["point"] == ("1", "number of the point in its sensor, from 0")
    assert result.describe("organs.csv")["area_m2"] == ("m2", "one-sided area")
    assert result.describe("profile.csv")["PAR_down_error"] == ("W m-2", "half-width of the confidence interval of PAR_down")
    for ask in (result.describe, result.table):
        with pytest.raises(sunfleck.InputError, match="not a table"):
            ask("canopy.csv")


def test_axes_of_the_scene():
    south = sunfleck.run(with_arrays({**TABLES, "plot": {"size": [1.0, 1.5]}}, up="z"), **WORK)
    tables = {**TABLES, "axes": "east-north-up", "plot": {"size": [1.5, 1.0]}, "plane": [{"height": 0.5, "cells": [2, 3]}]}
    tables["sensor"] = [{"name": "probe", "from": [1.0, 0.5, 0.3], "to": [1.0, 0.5, 0.9], "points": 3}]
    east = sunfleck.run(with_arrays(tables, at=[[1.5, 1.0, 0.0]]), **WORK)
    assert (south.summary["axes"], east.summary["axes"]) == ("south-up-west", "east-north-up")
    assert east.to_xarray().attrs["axes"] == "east-north-up"
    assert np.array_equal(east["PAR_absorbed"], south["PAR_absorbed"])

    def in_east(points):
        return np.stack([1.5 - points[..., 2], 1.0 - points[..., 0], points[..., 1]], axis=-1)

    assert np.allclose(east.corners, in_east(south.corners), atol=1e-12)
    for name in ("triangles", "plants"):
        a, b = (np.stack([getattr(result, name)[axis] for axis in "xyz"], axis=-1) for result in (east, south))
        assert np.allclose(a, in_east(b), atol=1e-12), name
    (flat, known), (probe, same) = (east.planes[0], south.planes[0]), (east.sensors[0], south.sensors[0])
    assert "y_m" in flat and "z_m" not in flat and flat["PAR_total"].shape == (3, 2)
    assert np.array_equal(flat["PAR_total"], known["PAR_total"][::-1, ::-1].T)
    assert np.allclose(flat["x_m"], 1.5 - known["z_m"][::-1]) and np.allclose(flat["y_m"], 1.0 - known["x_m"][::-1])
    assert np.allclose([probe["x"], probe["y"]], [1.5 - same["z"], 1.0 - same["x"]]) and np.allclose(probe["z"], same["y"])


def test_unknown_columns_are_named(result):
    with pytest.raises(ValueError, match="no such column"):
        result["PAR_absorbd"]


def test_folders_are_replaced(result, tmp_path):
    result.save(tmp_path / "out", export=["csv", "ply"], images=["rank_total"])
    assert {"triangles.csv", "canopy.ply", "rank_total.png"} <= set(files_of(tmp_path / "out"))
    result.save(tmp_path / "out", export=[])
    assert "triangles.csv" not in files_of(tmp_path / "out")
    with pytest.raises(ValueError, match="no such format"):
        result.save(tmp_path / "out", export=["doc"])
    with pytest.raises(sunfleck.InputError, match="images = 'rank_all'"):
        result.save(tmp_path / "out", images=["rank_total", "rank_all"])
    assert "rank_total.png" not in files_of(tmp_path / "out")


def test_folders_that_cannot_be_written_are_told(result, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(sunfleck.SunfleckError, match=r"\(.*\); "):
        result.save(tmp_path / "file" / "out")


class HeapStatistics(ctypes.Structure):
    """The C library's struct mallinfo2."""

    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


def bytes_in_use():
    """Returns the bytes that the program and Python hold, without the free memory that allocators keep for their threads."""
    mallinfo = ctypes.CDLL(None).mallinfo2
    mallinfo.restype = HeapStatistics
    gc.collect()
    statistics = mallinfo()
    return statistics.uordblks + statistics.hblkhd


BLACK = {
    "plot": {"size": [1.0, 1.0]},
    "sun": {"elevation": 50.0, "azimuth": 130.0},
    "band": [{"name": "PAR", "direct": 100.0}],
    "optics": {"leaf": {"reflectance": 0.0}, "stem": {"reflectance": 0.0}},
}


@pytest.mark.parametrize(
    "device, calls, scene",
    [("cpu", 600, with_arrays(BLACK)), ("cpu", 40, with_arrays()), ("lavapipe", 40, with_arrays())],
    ids=["beam", "all", "vulkan"],
)
def test_calls_leak_nothing(device, calls, scene):
    simulation = sunfleck.Simulation(scene, device=device)

    def call(number):
        result = simulation.run(sun={"elevation": 20.0 + number % 60, "azimuth": 130.0}, grid=0.1, passes=8, progress=lambda _: None)
        assert result["PAR_absorbed"].shape == (3,) and result.summary and result.profile
        assert len(result.planes) == len(result.sensors) == len(scene.get("plane", []))
        with pytest.raises(ValueError):
            simulation.run(sun={"elevation": 200.0, "azimuth": 0.0})

    descriptors = len(os.listdir("/proc/self/fd"))
    for number in range(calls // 4):
        call(number)
    settled = bytes_in_use()
    for number in range(calls - calls // 4):
        call(number)
    # A leak of 10 KiB per call would show in 450 calls.
    assert bytes_in_use() - settled < 4096 * 1024
    assert len(os.listdir("/proc/self/fd")) <= descriptors


def test_simulations_leak_nothing():
    def once():
        return sunfleck.run(with_arrays(), **{**WORK, "grid": 0.1}).complete

    for _ in range(20):
        assert once()
    before, blocks_before = bytes_in_use(), sys.getallocatedblocks()
    for _ in range(60):
        assert once()
    # A leak of 2 KiB per run would show. The resident memory is no measure: it grows by some 60 KiB per run, up to 4 MiB, since
    # the stacks of oneTBB's workers are used ever deeper before a worker pauses, and shrinks again later.
    assert bytes_in_use() - before < 128 * 1024
    assert sys.getallocatedblocks() - blocks_before < 3 * 60  # NumPy 1.24 itself loses one block in each np.unique


def arrays_of(value):
    """Returns the arrays in dicts and lists."""
    if isinstance(value, np.ndarray):
        return [value]
    items = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return [array for item in items for array in arrays_of(item)]


RESULT_TABLES = ("triangles", "organs", "plants", "profile", "planes", "sensors", "sensor_means", "corners")
DAY_TABLES = ("steps", "sums", "season", "organs", "plants", "organ_steps", "sensors", "sensor_means", "sensor_sums", "planes",
              "plane_sums", "plane_maps", "plane_steps", "triangles")  # fmt: skip


def test_arrays_are_read_only(result):
    sun = {"time": "2002-08-08T10:10:00+08:00", "latitude": 40.0, "longitude": 116.0}
    moving = with_arrays({**TABLES, "sun": sun, "band": [{"name": "PAR", "direct_normal": 400.0, "diffuse": 40.0}]})
    scene = {**moving, "optics": BLACK["optics"], "soil": {"reflectance": 0.1}}
    day = sunfleck.day(scene, step=180, grid=0.1, passes=8, device="cpu")
    for owner, tables in ((result, RESULT_TABLES), (day, DAY_TABLES)):
        for again in (owner, pickle.loads(pickle.dumps(owner))):
            for table in tables:
                arrays = arrays_of(getattr(again, table))
                assert arrays and not any(array.flags.writeable for array in arrays), table
    assert result["PAR_absorbed"].copy().flags.writeable and result.render(size=(64, 64)).flags.writeable
