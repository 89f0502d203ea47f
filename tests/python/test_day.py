"""The course of a day: the numbers of `sunfleck day`, bit for bit."""

import pickle

import netCDF4
import numpy as np
import pytest
import sunfleck
import tomli_w
from conftest import OBJ, TABLES, body, files_of, program, with_arrays, with_file

PLACE = {"time": "2002-08-08T10:10:00+08:00", "latitude": 40.0, "longitude": 116.0}
BANDS = [{"name": "PAR", "direct_normal": 400.0, "diffuse": 40.0, "umol_per_joule": 4.57}, {"name": "NIR", "direct_normal": 300.0}]
DAY = {**{key: TABLES[key] for key in ("title", "plot", "sky", "soil", "optics", "plane")}, "sun": PLACE, "band": BANDS}
HOURS = {"start": "04:00", "stop": "09:00", "step": 60, "device": "cpu"}
OPTIONS = ["--from", "04:00", "--to", "09:00", "--step", "60", "--device", "cpu", "--images", "none"]


@pytest.fixture
def day_file(tmp_path):
    (tmp_path / "leaves.obj").write_text(OBJ)
    file = tmp_path / "scene.toml"
    text = tomli_w.dumps(with_file(DAY)).replace(f'"{PLACE["time"]}"', PLACE["time"])
    file.write_text(text)
    return file


@pytest.mark.parametrize(
    "work, options",
    [
        ({"grid": 0.03}, ["--grid", "0.03"]),
        ({"error": 0.05}, ["--error", "0.05"]),
        ({"error": 0.05, "together": 2}, ["--error", "0.05", "--together", "2"]),
    ],
    ids=["grid", "bound", "together"],
)
def test_tables_are_those_of_the_program(day_file, tmp_path, work, options):
    program("day", day_file, "-o", tmp_path / "out", *OPTIONS, *options)
    day = sunfleck.day(day_file, **HOURS, **work)
    files = files_of(tmp_path / "out")
    assert {"day.csv", "season.csv", "planes_day.csv", "plane_day_sums.csv"} <= set(day.tables)
    assert set(day.tables) == {name for name in files if name.endswith(".csv")}
    for name in day.tables:
        assert day.table(name).encode() == files[name]
    with netCDF4.Dataset(tmp_path / "out" / "organs_steps.nc") as file:
        for name in ("PAR_absorbed", "PAR_absorbed_error", "NIR_absorbed"):
            values = np.ma.filled(file[name][:], np.nan)
            assert np.array_equal(values, day.organ_steps[name].astype(np.float32), equal_nan=True), name
    with netCDF4.Dataset(tmp_path / "out" / "day.nc") as file:
        for name, values in day.triangles.items():
            assert np.array_equal(np.ma.filled(file[name][:], np.nan), values, equal_nan=True), name
    assert day.complete


def test_arrays_hold_what_the_tables_hold():
    day = sunfleck.day(with_arrays(DAY), **HOURS, grid=0.05, passes=8)
    heads, *rows = [line.split(",") for line in body(day.table("day.csv")).splitlines()]
    assert len(rows) == 5 and float(rows[0][2]) < 0.0, "it begins at night"
    for number, row in enumerate(rows):
        for head, cell in zip(heads, row):
            value = day.steps[head][number]
            assert cell == (value if isinstance(value, str) else "" if np.isnan(value) else f"{value:.9g}"), head
    heads, row = [line.split(",") for line in body(day.table("day_sums.csv")).splitlines()]
    assert row[:2] == [day.sums["date"][0], "5"]
    for head, cell in zip(heads[1:], row[1:]):
        assert cell == f"{day.sums[head][0]:.9g}", head
    heads, *rows = [line.split(",") for line in body(day.table("organs_day.csv")).splitlines()]
    organs = day.organs
    assert organs["PAR_absorbed_mol_m2"].shape == (1, 2)
    for number, row in enumerate(rows):
        assert row[:4] == [organs["date"][0], str(organs["plant"][number]), organs["organ"][number], str(organs["rank"][number])]
        for head, cell in zip(heads[5:], row[5:]):
            assert cell == (organs[head][number] if head == "role" else f"{organs[head][0, number]:.9g}"), head
    heads, *rows = [line.split(",") for line in body(day.table("plants_day.csv")).splitlines()]
    assert day.plants["PAR_absorbed_mj"].shape == (1, len(rows)) and len(rows) > 0
    for number, row in enumerate(rows):
        for head, cell in zip(heads[7:], row[7:]):
            assert cell == f"{day.plants[head][0, number]:.9g}", head


def test_xarray():
    data = sunfleck.day(with_arrays(DAY), **HOURS, grid=0.05, passes=8).to_xarray()
    assert data.sizes == {"time": 5, "organ": 2, "triangle": 3}
    assert data.attrs["axes"] == "south-up-west"
    assert data["PAR_incident"].attrs["units"] == "W m-2" and data["step_s"].attrs["units"] == "s"
    assert all("units" in variable.attrs for variable in data.data_vars.values())
    assert data["organ_PAR_absorbed"].dims == ("time", "organ") and float(data["organ_PAR_absorbed"][4].min()) > 0.0
    assert data["time"].values[0] == np.datetime64("2002-08-07T20:00")
    assert float(data["PAR_absorbed"].isel(time=0).sum()) == 0.0 < float(data["PAR_absorbed"].isel(time=4).sum())


def test_limits_and_bad_times():
    short = sunfleck.day(with_arrays(DAY), **HOURS, error=1e-6, max_seconds=1e-9)
    assert not short.complete and len(short.steps["time"]) == 0
    for bad, words in (({"start": "25:00"}, "25:00"), ({"step": 0}, "step"), ({"date": "2002-02-30"}, "2002-02-30"), ({"step": 7.5}, "step"), ({"together": 0}, "together")):
        with pytest.raises(ValueError) as error:
            sunfleck.day(with_arrays(DAY), **{**HOURS, **bad}, grid=0.1)
        assert words in str(error.value) and "\n" not in str(error.value)
    fixed = {**DAY, "band": [{"name": "PAR", "direct": 1.0}, {"name": "NIR"}]}
    with pytest.raises(ValueError, match="direct"):
        sunfleck.day(with_arrays(fixed), **HOURS, grid=0.1)


def test_progress_is_of_the_whole_day():
    told = []
    sunfleck.day(with_arrays(DAY), **HOURS, error=0.02, progress=told.append)
    fractions = [state["fraction"] for state in told]
    assert told and 0.0 <= min(fractions) and max(fractions) <= 1.0


def test_several_dates_keep_triangles_only_if_asked():
    dates = {**HOURS, "start": "08:00", "stop": "12:00", "step": 120, "to_date": "2002-08-10", "grid": 0.05, "passes": 8}
    season = sunfleck.day(with_arrays(DAY), **dates)
    assert not season.has_triangles
    for name in ("triangles", "plane_steps"):
        with pytest.raises(ValueError, match="triangles=True"):
            getattr(season, name)
    whole = sunfleck.day(with_arrays(DAY), **dates, triangles=True)
    assert whole.triangles["PAR_absorbed"].shape == (6, 3)
    for name in season.tables:
        assert season.table(name) == whole.table(name), name
    kinds = season.season
    assert list(kinds["organ"]) == ["leaf", "stem", "soil"] and kinds["PAR_absorbed_share"].shape == (3, 3)
    assert np.allclose(kinds["PAR_absorbed_ground_mj_m2"][:, 2], season.sums["PAR_absorbed_soil_mj_m2"])
    assert season.to_dataframe("season").loc[(kinds["date"][2], 2), "organ"] == "soil"
    organs = season.organ_steps
    assert organs["PAR_absorbed"].shape == (6, 2)
    assert np.allclose(7200e-6 * organs["PAR_absorbed"].reshape(3, 2, 2).sum(axis=1), season.organs["PAR_absorbed_mj_m2"])
    maps, steps = whole.plane_maps[0], whole.plane_steps[0]
    assert steps["PAR_total"].shape == (6, *maps["PAR_total_mj_m2"].shape)
    assert np.allclose(7200e-6 * steps["PAR_total"].astype(float).sum(axis=0), maps["PAR_total_mj_m2"])


def test_planes_are_in_order_of_height():
    planes = [{"height": height, "cells": [2, cells]} for height, cells in ((0.9, 3), (0.3, 4), (0.6, 5))]
    scene = with_arrays({**DAY, "plane": planes})
    day = sunfleck.day(scene, **HOURS, grid=0.05, passes=8)
    assert day.planes["height_m"].tolist() == [0.3, 0.6, 0.9]
    for maps in (day.plane_maps, day.plane_steps, pickle.loads(pickle.dumps(day)).plane_maps):
        assert [plane["height_m"] for plane in maps] == [0.3, 0.6, 0.9]
    assert [plane["PAR_total_mj_m2"].shape for plane in day.plane_maps] == [(4, 2), (5, 2), (3, 2)]
    assert [plane["height_m"] for plane in sunfleck.run(scene, grid=0.05, passes=8, device="cpu").planes] == [0.3, 0.6, 0.9]


def test_sensors_over_a_day():
    line = {"name": "line", "from": [0.1, 0.1, 0.1], "to": [0.4, 0.1, 0.1], "points": 3}
    day = sunfleck.day(with_arrays({**DAY, "sensor": [line]}), **HOURS, grid=0.05, passes=8)
    assert day.sensors["PAR_total"].shape == (5, 3) and day.sensor_means["PAR_total"].shape == (5, 1)
    assert np.allclose(day.sensors["PAR_total"].mean(axis=1), day.sensor_means["PAR_total"][:, 0])
    assert np.allclose(3600e-6 * day.sensor_means["PAR_total"].sum(axis=0), day.sensor_sums["PAR_total_mj_m2"][0])
    assert day.planes["PAR_down"].shape == (5, len(day.planes["height_m"]))
    assert len(day.to_dataframe("sensors")) == 15
    kept = pickle.loads(pickle.dumps(day))
    assert np.array_equal(kept.sensors["PAR_total"], day.sensors["PAR_total"])
    assert np.array_equal(kept.triangles["PAR_absorbed"], day.triangles["PAR_absorbed"])
    assert sunfleck.day(with_arrays(DAY), **HOURS, grid=0.05, passes=8, triangles=False).sensors == {}
