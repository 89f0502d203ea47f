"""Tests that the module gives the numbers of the program, bit for bit."""

import netCDF4
import numpy as np
import pytest
import sunfleck
from conftest import LEAVES, OPTIONS, TABLES, WORK, body, files_of, program, with_arrays, with_file


@pytest.mark.parametrize("device", ["cpu", "lavapipe"])
def test_saved_files_are_those_of_the_program(scene_file, tmp_path, device):
    program("run", scene_file, "-o", tmp_path / "program", "--device", device, "--export", "csv,nc,caribu", "--images", "none", *OPTIONS)
    result = sunfleck.run(scene_file, **{**WORK, "device": device})
    result.save(tmp_path / "module", export=["csv", "nc", "caribu"])
    ours, theirs = files_of(tmp_path / "module"), files_of(tmp_path / "program")
    assert set(ours) == set(theirs)
    for name in set(theirs) - {"summary.json"}:
        assert ours[name] == theirs[name], name
    for name in ("profile.csv", "organs.csv", "plants.csv", "triangles.csv", "sensors.csv", "sensor_means.csv"):
        assert result.table(name).encode() == theirs[name]


def test_bounds_are_kept_as_by_the_program(scene_file, tmp_path):
    program("run", scene_file, "-o", tmp_path / "program", "--device", "cpu", "--images", "none", "--error", "0.02", "--seed", "7")
    result = sunfleck.run(scene_file, device="cpu", error=0.02, seed=7)
    assert result.table("organs.csv").encode() == files_of(tmp_path / "program")["organs.csv"]
    assert result.complete and result.summary["direct"]["relative_error"] <= 0.02


def test_arrays_hold_what_the_files_hold(scene_file, tmp_path):
    result = sunfleck.run(scene_file, **WORK)
    result.save(tmp_path / "module", export=["nc"])
    with netCDF4.Dataset(tmp_path / "module" / "results.nc") as file:
        for name, values in result.triangles.items():
            if name in file.variables and values.dtype.kind != "U":
                stored = np.ma.filled(file[name][:].astype(float), np.nan)
                assert np.array_equal(stored, values.astype(float), equal_nan=True), name
        corners = np.stack([file[f"corner_{axis}"][:] for axis in "xyz"], axis=2)
    assert np.array_equal(corners, result.corners)
    for name, table in (("profile.csv", result.profile), ("organs.csv", result.organs), ("plants.csv", result.plants)):
        lines = body(result.table(name)).splitlines()
        heads = lines[0].split(",")
        assert [head for head in heads if head not in table] == []
        for row, line in enumerate(lines[1:]):
            for head, cell in zip(heads, line.split(",")):
                value = table[head][row]
                assert cell == (value if isinstance(value, str) else "" if value != value else f"{value:.9g}"), (head, row)


def test_maps_and_sensors_hold_what_the_files_hold(scene_file, tmp_path):
    result = sunfleck.run(scene_file, **WORK)
    result.save(tmp_path / "module")
    files = files_of(tmp_path / "module")
    (plane,) = result.planes
    rows = [line.split(",") for line in body(files["plane_0.500.csv"].decode()).splitlines()]
    assert plane["PAR_total"].shape == (2, 3)
    for number, row in enumerate(rows[1:]):
        z, x = divmod(number, 3)
        assert row[:2] == [f"{plane['x_m'][x]:.9g}", f"{plane['z_m'][z]:.9g}"]
        for head, cell in zip(rows[0][2:], row[2:]):
            assert cell == f"{plane[head][z, x]:.9g}", head
    (sensor,) = result.sensors
    rows = [line.split(",") for line in body(files["sensors.csv"].decode()).splitlines()]
    for number, row in enumerate(rows[1:]):
        assert row[:2] == [sensor["name"], str(number)]
        for head, cell in zip(rows[0][2:], row[2:]):
            value = sensor[head][number]
            assert cell == ("" if np.isnan(value) else f"{value:.9g}"), head


def test_a_dict_is_the_file(scene_file):
    of_file = sunfleck.run(scene_file, **WORK)
    of_dict = sunfleck.run(with_file(), folder=scene_file.parent, **WORK)
    of_arrays = sunfleck.run(with_arrays(), **WORK)
    indexed = {"vertices": LEAVES.reshape(-1, 3).astype("f4"), "triangles": np.arange(9, dtype="i2").reshape(3, 3)}
    of_numbers = sunfleck.run({**TABLES, "geometry": [{**indexed, "optics": np.array(["leaf", "leaf", "stem"])}]}, **WORK)
    for other in (of_dict, of_arrays):
        assert other.table("triangles.csv") == of_file.table("triangles.csv")
        assert other.table("organs.csv") == of_file.table("organs.csv")
    assert np.allclose(of_numbers["PAR_absorbed"], of_file["PAR_absorbed"], rtol=0.05)


def test_organs_plants_and_placement_of_arrays():
    scene = with_arrays(plant=[2, 2, 5], organ=["leaf", "leaf", "stem"], rank=[1, 3, 0], at=[[0, 0, 0], [0.1, 0, 0.1]])
    result = sunfleck.run(scene, **WORK)
    assert list(result.organs["plant"]) == [2, 2, 5, 7, 7, 10]
    assert result.organs["organ"].tolist() == ["leaf", "leaf", "stem"] * 2
    assert list(result.organs["rank"]) == [1, 3, 0] * 2
    assert list(result["plant"]) == [2, 2, 5, 7, 7, 10]


def test_entries_of_the_same_plant_are_parts_of_it():
    parts = [
        {"vertices": LEAVES, "optics": "leaf", "plant": 7},
        {"vertices": LEAVES - [0, 0.1, 0], "optics": "stem", "plant": 7},
        {"vertices": LEAVES - [0, 0.2, 0], "optics": "leaf", "plant": 3},
        {"vertices": LEAVES - [0, 0.3, 0], "optics": "leaf"},
    ]
    result = sunfleck.run({**TABLES, "geometry": parts}, **WORK)
    assert list(result.organs["plant"]) == [7, 7, 3, 8]
    assert list(result.plants["plant"]) == [3, 7, 8]


def test_roles_and_organs_of_arrays():
    frames = sunfleck.run(with_arrays(role="structure"), **WORK)
    assert set(frames.organs["role"]) == {"structure"}
    assert frames.bands["PAR"]["absorbed_vegetation"] == 0 < frames.bands["PAR"]["absorbed_structure"]
    parts = sunfleck.run(with_arrays(split="parts"), **WORK)
    assert len(parts.organs["organ"]) == len(LEAVES)
    copies = {"at": [[0, 0, 0], [0.1, 0, 0.1]], "optics": "leaf"}
    own = sunfleck.run(with_arrays(**copies, instances=False), **WORK)
    shared = sunfleck.run(with_arrays(**copies, instances=True), **WORK)
    half_widths = np.hypot(own["PAR_absorbed_error"], shared["PAR_absorbed_error"])
    assert np.all(np.abs(own["PAR_absorbed"] - shared["PAR_absorbed"]) <= 2.0 * half_widths)


def test_optics_by_patterns_of_names():
    organs = ["leaf1", "leaf2", "stalk"]
    named = sunfleck.run(with_arrays(organ=organs), **WORK)
    patterned = sunfleck.run(with_arrays(organ=organs, optics={"LEAF?": "leaf", "*": "stem"}), **WORK)
    assert body(patterned.table("triangles.csv")) == body(named.table("triangles.csv"))


def test_other_light_is_that_of_a_fresh_scene(scene_file):
    changes = [
        {"sun": {"elevation": 20.0, "azimuth": 250.0}},
        {"sun": None, "band": [{"name": "PAR", "diffuse": 30.0}, {"name": "NIR", "diffuse": 1.0}]},
        {"sun": {"time": "2002-08-08T10:10:00+08:00", "latitude": 40.0, "longitude": 116.0}, "sky": {"model": "cie", "type": 12}},
        {"optics": {"leaf": {"reflectance": 0.2}}, "soil": {"reflectance": 0.05}},
    ]
    tables = with_file()
    kept = sunfleck.Simulation(scene_file, device="cpu")
    first = kept.run(grid=0.02, passes=8)
    before = first["PAR_absorbed"].copy()
    for change in changes:
        for key, value in change.items():
            if value is None:
                tables.pop(key)
            else:
                tables[key] = {**tables[key], **value} if key in ("optics", "soil") else value
        again = kept.run(grid=0.02, passes=8, **change)
        fresh = sunfleck.run(tables, folder=scene_file.parent, **WORK)
        assert again.table("triangles.csv") == fresh.table("triangles.csv"), change
        assert again.table("profile.csv") == fresh.table("profile.csv"), change
        assert again.summary["scene_digest"] != first.summary["scene_digest"]
    assert np.array_equal(first["PAR_absorbed"], before)
    assert first.table("organs.csv") == sunfleck.run(scene_file, **WORK).table("organs.csv")


def test_energy_closes(scene_file):
    for band in sunfleck.run(scene_file, **WORK).bands.values():
        quanta = band["quanta"]
        assert band["residual"] == 0
        assert quanta["incident"] == sum(value for name, value in quanta.items() if name != "incident")
