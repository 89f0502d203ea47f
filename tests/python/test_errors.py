"""Tests that bad input gives a ValueError of one line: where, what, why, and what to do."""

import datetime
import re

import numpy as np
import pytest
import sunfleck
from conftest import LEAVES, TABLES, WORK, with_arrays

NAN = float("nan")
FLAT = LEAVES.reshape(-1, 3)
NUMBERS = np.arange(9).reshape(3, 3)


def spoilt(index, value):
    vertices = LEAVES.copy()
    vertices[index] = value
    return vertices


MESHES = {
    "a shape of two": ({"vertices": FLAT[:, :2], "triangles": NUMBERS}, "vertices: shape (9, 2)"),
    "a flat list": ({"vertices": FLAT.ravel(), "triangles": NUMBERS}, "vertices: shape (27,)"),
    "four corners": ({"vertices": np.zeros((3, 4, 3))}, "vertices: shape (3, 4, 3)"),
    "text": ({"vertices": FLAT.astype(str), "triangles": NUMBERS}, "vertices: dtype <U32"),
    "complex numbers": ({"vertices": FLAT.astype(complex), "triangles": NUMBERS}, "vertices: dtype complex128"),
    "objects": ({"vertices": FLAT.astype(object), "triangles": NUMBERS}, "vertices: dtype object"),
    "NaN": ({"vertices": spoilt((1, 2, 0), NAN)}, "NaN or infinity at vertex 5"),
    "infinity": ({"vertices": spoilt((2, 0, 1), np.inf)}, "NaN or infinity at vertex 6"),
    "a masked corner": ({"vertices": np.ma.masked_equal(LEAVES, LEAVES.flat[0])}, "a masked array"),
    "far away": ({"vertices": spoilt((2, 0, 1), 1e39)}, "must be finite"),
    "no triangles": ({"vertices": FLAT}, "triangles (is missing)"),
    "an empty mesh": ({"vertices": np.zeros((0, 3, 3))}, "a mesh needs at least one"),
    "triangles of two": ({"vertices": FLAT, "triangles": NUMBERS[:, :2]}, "triangles: shape (3, 2)"),
    "triangles of floats": ({"vertices": FLAT, "triangles": NUMBERS.astype(float)}, "triangles: dtype float64"),
    "a number too large": ({"vertices": FLAT, "triangles": NUMBERS + 1}, "vertex number 9"),
    "a number below zero": ({"vertices": FLAT, "triangles": NUMBERS - 1}, "vertex number -1"),
    "missing optics": ({"vertices": LEAVES, "optics": None}, "optics (is missing)"),
    "undefined optics": ({"vertices": LEAVES, "optics": "petal"}, 'uses optics "petal", which is not defined'),
    "too few optics": ({"vertices": LEAVES, "optics": ["leaf"]}, "optics: shape (1,)"),
    "optics by number": ({"vertices": LEAVES, "optics": [0, 0, 0]}, "optics: dtype int64"),
    "optics that are no names": ({"vertices": LEAVES, "optics": np.array(["leaf", None, 1], object)}, "an item that is not a string"),
    "too many plants": ({"vertices": LEAVES, "plant": [1, 2]}, "plant: shape (2,)"),
    "half plants": ({"vertices": LEAVES, "plant": 1.5}, "plant: dtype float64"),
    "negative plants": ({"vertices": LEAVES, "plant": -1}, "plant: -1"),
    "ranks of text": ({"vertices": LEAVES, "rank": ["1", "2", "3"]}, "rank: dtype <U1"),
    "an unknown key": ({"vertices": LEAVES, "colour": "red"}, "geometry[0].colour"),
    "no scale": ({"vertices": LEAVES, "scale": 0.0}, "geometry.scale"),
}


def one_line(error, words):
    message = str(error.value)
    assert words in message
    assert "\n" not in message and " (" in message and "); " in message
    return message


@pytest.mark.parametrize("name", MESHES)
def test_meshes(name):
    mesh, words = MESHES[name]
    mesh = {"optics": "leaf", **mesh}
    if mesh["optics"] is None:
        del mesh["optics"]
    with pytest.raises(ValueError) as error:
        sunfleck.run({**TABLES, "geometry": [mesh]}, **WORK)
    one_line(error, words)


SCENES = {
    "an unknown key": ({"colour": 1}, "colour"),
    "a wrong type": ({"plot": "large"}, "plot"),
    "NaN": ({"plot": {"size": [NAN, 1.0]}}, "plot.size"),
    "more than all": ({"optics": {"leaf": {"reflectance": 0.9, "transmittance": 0.2}, "stem": {"reflectance": 0.1}}}, "optics.leaf"),
    "no bands": ({"band": []}, "band"),
    "a direct band without sun": ({"sun": None}, "direct"),
    "an object": ({"title": object()}, "title: object"),
    "a time that is none": ({"sun": {"time": "soon", "latitude": 1.0, "longitude": 2.0}}, 'sun.time = "soon"'),
    "a time without offset": (
        {"sun": {"time": datetime.datetime(2002, 8, 8), "latitude": 1.0, "longitude": 2.0}},
        "sun.time",
    ),
    "geometry that is no list": ({"geometry": "maize"}, "geometry"),
    "geometry that is no dict": ({"geometry": ["maize"]}, "geometry[0]: str"),
    "a file that is not there": ({"geometry": [{"file": "none.obj"}]}, "there is no such file"),
}


@pytest.mark.parametrize("name", SCENES)
def test_scenes(name):
    change, words = SCENES[name]
    scene = {key: value for key, value in {**with_arrays(), **change}.items() if value is not None}
    with pytest.raises(ValueError) as error:
        sunfleck.run(scene, **WORK)
    message = one_line(error, words)
    assert not re.match(r"\S*:\d+: ", message), "lines of a text that nobody saw are not named"


def test_messages_speak_python():
    scenes = {
        '"band": [{"name": "PAR", "direct": 350.0}]': {"band": []},
        '"sky": {...}': {"sky": None},
        "write True or False": {"plot": {"size": [1.0, 1.0], "periodic": "yes"}},
        'write "plane": [{...}]': {"plane": {"height": 0.5}},
    }
    for words, change in scenes.items():
        scene = {key: value for key, value in {**with_arrays(), **change}.items() if value is not None}
        with pytest.raises(ValueError) as error:
            sunfleck.run(scene, **WORK)
        message = one_line(error, words)
        assert "[[" not in message and "[sky]" not in message


def test_messages_name_arguments(tmp_path):
    """They say start, where the program's messages have its option --from."""
    place = {"time": "2002-08-08T10:10:00+08:00", "latitude": 40.0, "longitude": 116.0}
    bands = [{"name": name, "direct_normal": 1.0, "diffuse": 1.0} for name in ("PAR", "NIR")]
    scene = with_arrays({**TABLES, "sun": place, "band": bands})
    arctic = {**scene, "sun": {**place, "latitude": 85.0, "time": "2002-12-08T10:10:00+08:00"}}
    outside = {**TABLES, "geometry": [{"file": "../leaves.obj"}]}
    result = sunfleck.run(with_arrays(), **WORK)
    (tmp_path / "file").write_text("")
    for words, work in {
        "start = 25:00 (must be a time": lambda: sunfleck.day(scene, start="25:00", device="cpu"),
        "; give start and stop": lambda: sunfleck.day(arctic, device="cpu"),
        "stop = 08:00 (it is not after 09:00); give the earlier time as start": lambda: sunfleck.day(
            scene, start="09:00", stop="08:00", device="cpu"
        ),
        "date = 2002-02-30 (": lambda: sunfleck.day(scene, date="2002-02-30", device="cpu"),
        "to_date = 2002-01-01 (": lambda: sunfleck.day(scene, to_date="2002-01-01", device="cpu"),
        "band = foo (": lambda: result.render(band="foo"),
        "or pass allow_outside=True": lambda: sunfleck.run(outside, folder=tmp_path, **WORK),
        "); choose a writable folder": lambda: result.save(tmp_path / "file" / "out"),
        "grid = 1e-09 (": lambda: sunfleck.run(scene, grid=1e-9, device="cpu"),
        "; give a wider grid or more passes": lambda: sunfleck.run(scene, grid=1e-9, device="cpu"),
        '); give a datetime with a time zone, or "2002-': lambda: sunfleck.run({**scene, "sun": {**place, "time": 5}}, **WORK),
    }.items():
        with pytest.raises(sunfleck.Error) as error:
            work()
        message = one_line(error, words)
        assert "--" not in message and " -o" not in message


def test_warnings_speak_python():
    with pytest.warns(UserWarning, match="^scene: sun.azimuth: -60 is below 0"):
        sunfleck.Simulation({**with_arrays(), "sun": {"elevation": 50.0, "azimuth": -60.0}}, device="cpu")
    place = {"time": "2002-08-08T10:10:00+08:00", "latitude": 40.0, "longitude": 116.0}
    spare = {**TABLES["optics"], "laef": {"reflectance": 0.9}}
    scene = with_arrays({**TABLES, "sun": place, "optics": spare, "band": [{"name": "PAR", "direct_normal": 1.0}, {"name": "NIR"}]})
    with pytest.warns(UserWarning, match="^scene: optics.laef is not used by any geometry"):
        sunfleck.day(scene, start="10:00", stop="12:00", grid=0.1, passes=8, device="cpu")


OPTIONS = {
    "error": [0.0, 1.0, -1.0, NAN, "0.01", True],
    "grid": [0.0, -1.0, np.inf, "fine", 1e-9],
    "passes": [7, 0, -8, 8.5, "8", True],
    "max_seconds": [0.0, -1.0, NAN],
    "max_rays": [0, -1, 1.5],
    "seed": [-1, 2**64, "one", 0.5],
    "threads": [-1, 5000, "two"],
}


@pytest.mark.parametrize("name", OPTIONS)
def test_options(name):
    for value in OPTIONS[name]:
        with pytest.raises(ValueError) as error:
            sunfleck.run(with_arrays(), **{"device": "cpu", name: value})
        assert re.search(rf"\b{name}\b", one_line(error, name))


CYCLE = {}
CYCLE["reflectance"] = CYCLE
DEEP = 0.1
for _ in range(300):
    DEEP = [DEEP]

WRONG_ARGUMENTS = {
    "a text as a flag": (lambda *_: sunfleck.run(with_arrays(), allow_outside="no", **WORK), "allow_outside = 'no'"),
    "a list as a flag": (lambda *_: sunfleck.sky("uniform", allow_outside=[]), "allow_outside = []"),
    "a number as a chart": (lambda _, result: result.render(chart=5), "chart: int"),
    "a number as a size": (lambda _, result: result.render(size=5), "size = 5"),
    "a number as a table": (lambda _, result: result.describe(5), "table: int"),
    "no table": (lambda _, result: result.table(None), "table: NoneType"),
    "a number as a format": (lambda _, result: result.save("nowhere", export=5), "export: int"),
    "a number as an image": (lambda _, result: result.save("nowhere", images=[5]), "images: int"),
    "a number as a folder": (lambda _, result: result.save(5), "folder = 5"),
    "a text as a plane": (lambda _, result: result.plot("map", plane="x"), "plane = 'x'"),
    "ragged vertices": (lambda *_: sunfleck.run(with_arrays(vertices=[[1, 2, 3], [1, 2]]), **WORK), "geometry[0].vertices"),
    "ragged optics": (lambda *_: sunfleck.run(with_arrays(optics=["leaf", ["leaf"], "leaf"]), **WORK), "geometry[0].optics"),
    "a dict in itself": (lambda *_: sunfleck.run({**with_arrays(), "soil": CYCLE}, **WORK), "contain themselves"),
    "light in itself": (lambda simulation, _: simulation.relight(soil=CYCLE), "contain themselves"),
    "a deep list": (lambda *_: sunfleck.run({**with_arrays(), "output": {"layers": DEEP}}, **WORK), "nested too deeply"),
    "a deep table of light": (lambda simulation, _: simulation.relight(sky={"model": DEEP}), "nested too deeply"),
}


@pytest.fixture(scope="module")
def simulation():
    return sunfleck.Simulation(with_arrays(), device="cpu")


@pytest.fixture(scope="module")
def result(simulation):
    return simulation.run(grid=0.1, passes=8)


@pytest.mark.parametrize("name", WRONG_ARGUMENTS)
def test_arguments_of_wrong_types(name, simulation, result):
    work, words = WRONG_ARGUMENTS[name]
    with pytest.raises(sunfleck.InputError) as error:
        work(simulation, result)
    assert len(one_line(error, words)) < 120


@pytest.mark.parametrize("text", ["\ud800", "a\0b"], ids=["surrogate", "nul"])
def test_texts_with_characters_that_are_none(text, simulation, result, tmp_path):
    for words, work in {
        "organ": lambda: sunfleck.run(with_arrays(organ=["leaf", text, "leaf"]), **WORK),
        "[0].optics": lambda: sunfleck.run(with_arrays(optics=text), **WORK),
        "a key of optics": lambda: simulation.relight(optics={text: {"reflectance": 0.1}}),
        "band[0].name": lambda: sunfleck.run({**with_arrays(), "band": [{"name": text}]}, **WORK),
        "title": lambda: sunfleck.run({**with_arrays(), "title": text}, **WORK),
        "a key of the scene": lambda: sunfleck.run({**with_arrays(), text: 1}, **WORK),
        "scene": lambda: sunfleck.sweep(text, optics={"leaf": {"reflectance": [0.1]}}, **WORK),
        "folder": lambda: result.save(f"{tmp_path}/{text}"),
        "field": lambda: result.render(field=text),
        "date": lambda: sunfleck.day(with_arrays(), date=text),
        "device": lambda: sunfleck.Simulation(with_arrays(), device=text),
    }.items():
        with pytest.raises(sunfleck.InputError) as error:
            work()
        one_line(error, words)
    assert not list(tmp_path.iterdir())


def test_names_of_files_that_are_not_utf_8(result, tmp_path):
    result.save(tmp_path / "\udce9")
    assert [file.name for file in tmp_path.iterdir()] == ["\udce9"]


def test_scenes_that_are_no_scenes(tmp_path):
    for scene in (None, 3, [], b"x"):
        with pytest.raises(ValueError):
            sunfleck.run(scene)
    with pytest.raises(ValueError, match="none.toml"):
        sunfleck.run(tmp_path / "none.toml")
    (tmp_path / "broken.toml").write_text("[plot\n")
    with pytest.raises(ValueError, match="broken.toml:"):
        sunfleck.run(tmp_path / "broken.toml")


def test_a_scene_file_is_read_once(scene_file, monkeypatch):
    """What becomes of the file or of the current folder later does not reach a simulation."""
    monkeypatch.chdir(scene_file.parent)
    simulations = [sunfleck.Simulation(file, device="cpu") for file in (scene_file, scene_file.name)]
    light = {"sun": {"elevation": 20.0, "azimuth": 130.0}, "grid": 0.05, "passes": 8}
    expected = sunfleck.Simulation(scene_file, device="cpu").run(**light).table("profile.csv")
    spectra = {"leaf": {"spectrum": "leaf.csv"}}
    (scene_file.parent / "leaf.csv").write_text("wavelength,reflectance,transmittance\n300,0.1,0.05\n2500,0.1,0.05\n")
    scene_file.write_text("[plot\n")
    assert simulations[0].run(**light).table("profile.csv") == expected
    scene_file.unlink()
    monkeypatch.chdir("/")
    assert simulations[1].run(**light).table("profile.csv") == expected
    ranges = [{"name": name, "direct": 1.0, "range_nm": [400.0, 700.0]} for name in ("PAR", "NIR")]
    simulations[1].relight(optics=spectra, band=ranges)
    with pytest.raises(sunfleck.InputError, match=r"^scene.toml: sun.elevation"):
        simulations[1].relight(sun={"elevation": 100.0, "azimuth": 0.0})


def test_scene_files_of_windows(scene_file):
    """Editors there begin a file with a byte order mark; older ones write Latin-1."""
    text = scene_file.read_text()
    expected = sunfleck.run(scene_file, **WORK, sun={"elevation": 20.0, "azimuth": 130.0})["PAR_absorbed"]
    scene_file.write_text(text, encoding="utf-8-sig")
    relit = sunfleck.run(scene_file, **WORK, sun={"elevation": 20.0, "azimuth": 130.0})
    assert np.array_equal(relit["PAR_absorbed"], expected)

    def sweep(scene, **work):
        return sunfleck.sweep(scene, optics={"leaf": {"reflectance": [0.1]}}, **work)

    assert sweep(scene_file, **WORK)[0].complete
    for content in (text.replace("three", "trois \xe9").encode("latin-1"), b"\x89PNG\r\n\x1a\n\x00\xff"):
        scene_file.write_bytes(content)
        for simulate in (sunfleck.run, sweep):
            with pytest.raises(sunfleck.InputError, match="scene.toml:"):
                simulate(scene_file, **WORK)


def test_devices_that_are_not_there():
    with pytest.raises(sunfleck.DeviceError, match=r"\(.*\); "):
        sunfleck.run(with_arrays(), device="no such device")


def test_light_that_does_not_fit_leaves_all_as_it_was():
    simulation = sunfleck.Simulation(with_arrays(), device="cpu")
    before = simulation.run(grid=0.05, passes=8).table("triangles.csv")
    for light, words in (
        ({"sun": {"elevation": 100.0, "azimuth": 0.0}}, "sun.elevation"),
        ({"sky": {"model": "grey"}}, "sky.model"),
        ({"sun": None}, "direct"),
        ({"optics": {"leaf": {"reflectance": 2.0}}}, "optics.leaf"),
        ({"optics": {"leaf": None}}, "optics.leaf = None"),
        ({"optics": 5}, "optics: int"),
        ({"soil": {"patch": 0.5}}, "soil.patch"),
        ({"soil": {"reflectance": None}}, "soil.reflectance = None"),
        ({"soil": []}, "soil: list"),
        ({"soil": "x"}, "soil: str"),
        ({"band": [{"name": "PAR"}]}, "NIR"),
    ):
        with pytest.raises(ValueError) as error:
            simulation.run(grid=0.05, passes=8, **light)
        one_line(error, words)
        assert simulation.run(grid=0.05, passes=8).table("triangles.csv") == before


def test_doubts_are_warnings():
    with pytest.warns(UserWarning, match="the sun is not above the horizon"):
        sunfleck.run({**with_arrays(), "sun": {"elevation": -3.0, "azimuth": 0.0}}, **WORK)


def test_optics_that_nothing_has_are_warned_of():
    scene = with_arrays()
    scene["optics"] = {**scene["optics"], "laef": {"reflectance": 0.9}}
    with pytest.warns(UserWarning, match="optics.laef is not used by any geometry"):
        sunfleck.Simulation(scene, device="cpu")


@pytest.mark.parametrize("name, cure", [("laef", "did you mean leaf?"), ("LEAF", "did you mean leaf?"), ("Xyz", "use one of leaf, stem")])
def test_optics_that_can_change_nothing_are_refused(name, cure):
    simulation = sunfleck.Simulation(with_arrays(), device="cpu")
    for change in (simulation.relight, lambda optics: sunfleck.sweep(with_arrays(), optics=optics, device="cpu")):
        with pytest.raises(sunfleck.InputError) as refused:
            change(optics={name: {"reflectance": [0.8, 0.9]}})
        assert f"optics.{name} (" in str(refused.value) and cure in str(refused.value)


def test_the_entry_of_a_geometry_is_named():
    good = {"vertices": LEAVES, "optics": "leaf"}
    bad, far = {**good, "scale": -1.0}, {**good, "at": [[1.0, 2.0, 3.0]] * 20}
    for entries, name in (
        ([good, good, bad], "geometry[2].scale"),
        ([far, bad, far], "geometry[1].scale"),
        ([far, bad], "geometry[1].scale"),
        ([bad], "geometry.scale"),
    ):
        with pytest.raises(sunfleck.InputError) as refused:
            sunfleck.Simulation({**TABLES, "geometry": entries}, device="cpu")
        assert str(refused.value).startswith(f"scene: {name} = -1")


def test_missing_vertices_are_named():
    for key, cure in (("vertces", "did you mean it by vertces?"), ("other", "give it beside triangles")):
        part = {key: LEAVES, "triangles": [[0, 1, 2]], "optics": "leaf"}
        with pytest.raises(sunfleck.InputError, match=re.escape(f"geometry[0].vertices (is missing); {cure}")):
            sunfleck.Simulation({**TABLES, "geometry": [part]}, device="cpu")


def test_kinds_of_devices_may_be_written_in_any_case():
    assert sunfleck.Simulation(with_arrays(), device="CPU").device["kind"] == "cpu"


def test_plants_that_others_are_numbered_as_are_refused():
    first = {"vertices": LEAVES, "optics": "leaf", "plant": 1, "at": [[0.0, 0.0, 0.0], [0.5, 0.0, 0.5]]}
    second = {"vertices": LEAVES, "optics": "leaf", "plant": 2}
    with pytest.raises(sunfleck.InputError, match="plant 2 is there already"):
        sunfleck.Simulation({**TABLES, "geometry": [first, second]}, device="cpu")
    sunfleck.Simulation({**TABLES, "geometry": [second, first]}, device="cpu")


def test_a_scene_without_sensors_has_no_table_of_them():
    result = sunfleck.run({key: value for key, value in with_arrays().items() if key != "sensor"}, **WORK)
    with pytest.raises(sunfleck.InputError, match=r"to_dataframe\('sensor_means'\).*the scene has no sensors"):
        result.to_dataframe("sensor_means")
