"""What the arrays, tables, pictures and results are good for in a script or a notebook."""

import copy
import io
import pickle
import re

import numpy as np
import pytest
import sunfleck
from conftest import LEAVES, OPTIONS, TABLES, WORK, program, with_arrays

PLACE = {"time": "2002-06-21T10:00:00+08:00", "latitude": 40.0, "longitude": 116.0}
BANDS = [{"name": "PAR", "direct_normal": 400.0, "diffuse": 40.0}, {"name": "NIR", "direct_normal": 300.0}]
DAY = {**{key: TABLES[key] for key in ("title", "plot", "sky", "soil", "optics")}, "sun": PLACE, "band": BANDS}


@pytest.fixture(scope="module")
def result():
    return sunfleck.run(with_arrays(organ=["blade", "blade", "culm"], plant=[1, 2, 2]), **WORK)


def test_texts_are_arrays_and_organ_is_a_name(result):
    for table in (result.triangles, result.organs):
        assert table["organ"].dtype.kind == "U"
    assert result["organ"].tolist() == ["blade", "blade", "culm"]
    assert (result["organ"] == "blade").tolist() == [True, True, False]
    assert result["optics"].tolist() == ["leaf", "leaf", "stem"]
    assert result.organs["organ"][result["organ_index"]].tolist() == result["organ"].tolist()
    assert result.organs["plant"][result["organ_index"]].tolist() == result["plant"].tolist()
    assert result.sensor_means["sensor"].dtype.kind == "U"


def test_tables_as_data_frames(result):
    pandas = pytest.importorskip("pandas")
    for name, columns, rows in (
        ("organs", result.organs, 3), ("triangles", result.triangles, 3), ("plants", result.plants, 2), ("layers", result.profile, 5),
        ("sensor_means", result.sensor_means, 1),
    ):  # fmt: skip
        frame = result.to_dataframe(name)
        assert isinstance(frame, pandas.DataFrame) and len(frame) == rows and list(frame.columns) == list(columns)
        for column, values in columns.items():
            if values.dtype.kind == "f":
                assert np.array_equal(frame[column].to_numpy(), values, equal_nan=True), column
    organs = result.to_dataframe("organs")
    assert organs.attrs["units"]["area_m2"] == "m2" and organs.index.name == "organ_index"
    by_organ = result.to_dataframe("triangles").groupby("organ", observed=True)["area_m2"].sum()
    assert by_organ["blade"] == pytest.approx(organs["area_m2"][organs["organ"] == "blade"].sum())
    assert result.to_dataframe("bands").loc["NIR", "incident"] == pytest.approx(85.0)
    sensors = result.to_dataframe("sensors")
    assert sensors.index.names == ["sensor", "point"] and sensors.loc[("probe", 2), "PAR_sky"] == result.sensors[0]["PAR_sky"][2]
    with pytest.raises(ValueError, match=r"no such table\); use one of organs, "):
        result.to_dataframe("leaves")


def test_a_day_as_data_frames():
    pytest.importorskip("pandas")
    day = sunfleck.day(with_arrays(DAY), step=120, error=0.2, device="cpu")
    steps = day.to_dataframe()
    assert len(steps) == len(day.steps["time"]) and steps.index.name == "time"
    assert np.array_equal(steps["PAR_incident"], day.steps["PAR_incident"], equal_nan=True)
    triangles = day.to_dataframe("triangles")
    assert triangles.index.names == ["time", "triangle"] and len(triangles) == 3 * len(steps)
    assert triangles["PAR_absorbed"].iloc[-1] == day.triangles["PAR_absorbed"][-1, 2]
    organs = day.to_dataframe("organs")
    assert organs["PAR_absorbed_mj_m2"].iloc[1] == day.organs["PAR_absorbed_mj_m2"][0, 1]
    assert "MJ m-2 absorbed by vegetation" in repr(day)
    again = pickle.loads(pickle.dumps(day))
    assert np.array_equal(again.steps["PAR_incident"], day.steps["PAR_incident"], equal_nan=True)
    assert again.to_dataframe("plants").equals(day.to_dataframe("plants"))


def test_a_result_goes_through_its_columns(result):
    assert list(result) == list(result.triangles) and "PAR_absorbed" in result and "PAR" not in result


def test_a_simulation_shows_what_it_is_and_is_not_copied():
    simulation = sunfleck.Simulation(with_arrays(DAY), device="cpu")
    assert re.fullmatch(r"<sunfleck.Simulation of .*: 3 triangles, CPU path>", repr(simulation)), repr(simulation)
    for attempt in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="make one from its scene instead"):
            attempt(simulation)


def test_results_are_pickled_and_copied(result):
    for again in (pickle.loads(pickle.dumps(result)), pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))):
        assert again.summary == result.summary and repr(again) == repr(result)
        for name, values in result.triangles.items():
            assert np.array_equal(again[name], values, equal_nan=values.dtype.kind == "f"), name
        for table in ("organs", "plants", "profile", "sensor_means"):
            for name, values in getattr(result, table).items():
                assert np.array_equal(getattr(again, table)[name], values, equal_nan=values.dtype.kind == "f"), name
        assert np.array_equal(again.planes[0]["PAR_total"], result.planes[0]["PAR_total"])
        assert np.array_equal(again.corners, result.corners) and again.corners.flags.owndata is False
        assert again.table("organs.csv") == result.table("organs.csv")
        assert again.describe("triangles.csv") == result.describe("triangles.csv")
        assert again.to_xarray().equals(result.to_xarray())
        with pytest.raises(ValueError, match="has no scene"):
            again.render()
        with pytest.raises(ValueError, match="has no scene"):
            again.save("nowhere")
    assert copy.deepcopy(result).summary == result.summary
    assert np.array_equal(copy.copy(result)["PAR_absorbed"], result["PAR_absorbed"])


def test_a_picture_is_that_of_the_program(scene_file, tmp_path):
    image = pytest.importorskip("matplotlib.image")
    ours = sunfleck.run(scene_file, **WORK)
    for chart, field, view in (("rank", "total", "camera"), ("hue", "direct", "side"), ("map", "absorbed", "top")):
        options = ["--chart", chart, "--field", field, "--view", view, "--size", "160x120", "--samples", "2"]
        program("render", scene_file, "-o", tmp_path / "picture.png", "--device", "cpu", *OPTIONS, *options)
        theirs = np.rint(255.0 * image.imread(tmp_path / "picture.png")[:, :, :3]).astype(np.uint8)
        drawn = ours.render(chart=chart, field=field, view=view, size=(160, 120), samples=2)
        assert drawn.shape == (120, 160, 3) and drawn.dtype == np.uint8 and drawn.std() > 0.0
        assert np.array_equal(drawn, theirs), chart


@pytest.mark.parametrize(
    "options, message",
    [
        ({"chart": "pie"}, "chart = 'pie'"), ({"field": "heat"}, "field = 'heat'"), ({"view": "moon"}, "view = 'moon'"),
        ({"size": (10, 100)}, "size"), ({"repeat": 2}, "repeat = 2"), ({"band": "UV"}, "UV"),
    ],
)  # fmt: skip
def test_pictures_that_cannot_be_drawn(result, options, message):
    with pytest.raises(ValueError, match=message):
        result.render(**options)


def test_plots_show_the_columns(result):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = result.plot("profile", band="NIR")
    (line,) = [line for line in ax.lines if len(line.get_xdata()) == 5][:1]
    assert np.array_equal(line.get_xdata(), result.profile["NIR_down"])
    assert np.array_equal(line.get_ydata(), result.profile["height_m"])
    assert ax.get_xlabel() == "NIR_down (W m-2)" and ax.get_ylabel() == "height (m)"
    same = result.plot("map", quantity="sunfleck", ax=ax.figure.add_subplot(2, 2, 4))
    assert np.array_equal(np.asarray(same.collections[0].get_array()).ravel(), result.planes[0]["sunfleck"].ravel())
    for wrong in ({"kind": "pie"}, {"quantity": "height"}, {"band": "UV"}, {"kind": "map", "plane": 1}):
        with pytest.raises(ValueError, match=r"\(.*\); "):
            result.plot(**wrong)


def test_figures_that_matter_in_a_line_and_a_notebook(result):
    line = repr(result)
    band = result.bands["PAR"]
    assert line.startswith("<sunfleck.Result of 'three leaves': 3 triangles; PAR ") and "\n" not in line
    shown = float(line.split("PAR ")[1].split(" ")[0])
    assert shown == pytest.approx(band["absorbed_vegetation"], abs=band["error"]["absorbed_vegetation"])
    typical = result.summary["triangle_relative_error"]["PAR"]
    assert f"PAR absorbed by a triangle known to {100.0 * typical:.2g} %" in line and "work done" in line
    page = result._repr_html_()
    assert page.count("<tr>") == 3 and "<td>NIR</td>" in page and "three leaves" in page
    tagged = sunfleck.run({**with_arrays(), "title": "a <b> stand"}, **WORK)
    assert "a &lt;b&gt; stand" in tagged._repr_html_()


def test_files_that_are_missing(tmp_path):
    named = with_arrays()
    named["geometry"] = [{"file": "gone.obj"}]
    for scene, name in ((tmp_path / "gone.toml", "gone.toml"), (named, "gone.obj")):
        with pytest.raises(FileNotFoundError, match=name) as caught:
            sunfleck.run(scene, folder=None if scene is not named else tmp_path, **WORK)
        assert isinstance(caught.value, sunfleck.InputError) and isinstance(caught.value, ValueError)
    with pytest.raises(sunfleck.InputError) as other:
        sunfleck.run(with_arrays(optics="moss"), **WORK)
    assert not isinstance(other.value, FileNotFoundError)


def test_a_bar_or_a_line_shows_progress(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "tqdm.auto", None)  # as if it were not installed
    shown = io.StringIO()
    monkeypatch.setattr("sys.stderr", shown)
    sunfleck.run(with_arrays(), device="cpu", error=0.01, progress=True)
    lines = shown.getvalue().split("\r")
    assert lines[-1].startswith("sunfleck: 100 %, ") and lines[-1].endswith("\n")
    quiet = io.StringIO()
    monkeypatch.setattr("sys.stderr", quiet)
    sunfleck.run(with_arrays(), device="cpu", error=0.05, progress=False)
    assert quiet.getvalue() == ""
    with pytest.raises(ValueError, match="progress"):
        sunfleck.run(with_arrays(), device="cpu", error=0.05, progress=3)


def test_tqdm_is_used_if_present(monkeypatch):
    made = []

    class Bar:
        def __init__(self, total, **_):
            self.n, self.total, self.closed = 0.0, total, False
            made.append(self)

        def update(self, more):
            assert more >= 0.0
            self.n += more

        def set_postfix_str(self, text, refresh):
            self.text = text

        def close(self):
            self.closed = True

    monkeypatch.setitem(__import__("sys").modules, "tqdm.auto", type("module", (), {"tqdm": Bar}))
    sunfleck.run(with_arrays(), device="cpu", error=0.02, progress=True)
    (bar,) = made
    assert bar.closed and bar.n == pytest.approx(bar.total) and "million rays" in bar.text


def test_signatures_are_explicit():
    import inspect

    of_run = inspect.signature(sunfleck.run).parameters
    for name in inspect.signature(sunfleck.Simulation.run).parameters:
        assert name == "self" or name in of_run
    assert not any(p.kind in (p.VAR_KEYWORD, p.VAR_POSITIONAL) for p in of_run.values())
    with pytest.raises(TypeError):
        sunfleck.run(with_arrays(), errror=0.1)
    assert LEAVES.shape == (3, 3, 3)
