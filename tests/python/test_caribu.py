"""Tests CARIBU's vocabulary against known answers and the numbers of sunfleck.run."""

import math

import numpy as np
import pytest
import sunfleck
from sunfleck.caribu import CaribuScene

LOWER = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
UPPER = [(0, 0, 1e-3), (1, 0, 1e-3), (0, 1, 1e-3)]
OTHER_HALF = [(1, 0, 0), (1, 1, 0), (0, 1, 0)]
HALVES = {"lower": [LOWER, OTHER_HALF], "upper": [UPPER]}
SQUARE = (0, 0, 1, 1)


def within(values, expected, error):
    """Returns whether values are within three half-widths of the requested relative error."""
    return values == pytest.approx(expected, rel=3 * error, abs=3 * error)


def test_first_hits_of_a_zenith_light():
    raw, aggregated = CaribuScene(HALVES, pattern=SQUARE).run(error=0.002)
    quantities = raw["default_band"]
    assert set(quantities) == {"area", "Eabs", "Ei", "Ei_sup", "Ei_inf", "Eabs_error"}
    assert quantities["area"]["lower"] == pytest.approx([0.5, 0.5])
    assert within(quantities["Ei"]["lower"], [0.0, 1.0], 0.002)
    of_both = aggregated["default_band"]
    assert of_both["area"]["lower"] == pytest.approx(1.0) and within(of_both["Ei"]["lower"], 0.5, 0.002)
    assert within(of_both["Ei_sup"]["upper"], 1.0, 0.002) and of_both["Ei_inf"]["upper"] == 0.0
    assert within(of_both["Eabs"]["upper"], 1.0 - 0.06 - 0.07, 0.002)


def test_bands_and_faces():
    materials = {
        "par": {"lower": (0.1,), "upper": (0.1, 0.05)},
        "nir": {"lower": (0.5,), "upper": (0.4, 0.3, 0.2, 0.1)},
    }
    scene = CaribuScene({"upper": [UPPER[::-1]], "lower": [OTHER_HALF]}, pattern=SQUARE, opt=materials)
    _, aggregated = scene.run(error=0.002)
    assert within(aggregated["par"]["Eabs"]["upper"], 0.85, 0.002)
    assert within(aggregated["nir"]["Ei_inf"]["upper"], 1.0, 0.002), "its lower face looks up"
    assert within(aggregated["nir"]["Eabs"]["upper"], 0.7, 0.002)
    assert within(aggregated["nir"]["Eabs"]["lower"], 0.5, 0.002)


def test_one_band_may_stand_alone():
    raw, aggregated = CaribuScene(HALVES, pattern=SQUARE, opt={"par": (0.1,)}).run(simplify=True, error=0.01)
    assert "Eabs" in raw and "Eabs" in aggregated


@pytest.mark.parametrize("unit, metres", [("m", 1.0), ("cm", 0.01)])
def test_units_change_nothing_but_areas(unit, metres):
    scaled = {name: (np.asarray(triangles) / metres).tolist() for name, triangles in HALVES.items()}
    pattern = tuple(edge / metres for edge in SQUARE)
    _, aggregated = CaribuScene(scaled, pattern=pattern, scene_unit=unit).run(error=0.002, simplify=True)
    assert aggregated["area"]["upper"] == pytest.approx(0.5)
    assert within(aggregated["Ei"]["upper"], 1.0, 0.002)


def test_infinite_canopy_over_soil():
    """A plate that fills the pattern lies over soil: two parallel planes, whose exchange is a geometric series."""
    plate = {"plate": [[(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(1, 0, 1), (1, 1, 1), (0, 1, 1)]]}
    reflectance, transmittance, soil = 0.4, 0.3, 0.35
    scene = CaribuScene(plate, light=[(200.0, (0.3, -0.2, -1.0))], pattern=SQUARE, opt={"nir": (reflectance, transmittance)}, soil_reflectance=soil)
    _, aggregated = scene.run(direct=False, infinite=True, error=0.002, simplify=True)
    between = 200.0 * transmittance / (1.0 - soil * reflectance)  # light that comes down below the plate
    absorbed = (1.0 - reflectance - transmittance) * (200.0 + soil * between)
    assert within(aggregated["Eabs"]["plate"], absorbed, 0.002)
    assert within(aggregated["Ei_sup"]["plate"], 200.0, 0.002)
    assert within(aggregated["Ei_inf"]["plate"], soil * between, 0.002)
    assert within(scene.soil_aggregated["nir"]["Ei"], between, 0.002)
    assert within(scene.soil_aggregated["nir"]["Eabs"], (1.0 - soil) * between, 0.002)


def test_white_soil():
    """Soil that absorbs nothing is still lit."""
    plate = {"plate": [[(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(1, 0, 1), (1, 1, 1), (0, 1, 1)]]}
    light = [(200.0, (0.3, -0.2, -1.0))]
    scene = CaribuScene(plate, light=light, pattern=SQUARE, opt={"nir": (0.4, 0.3)}, soil_reflectance=1.0)
    scene.run(direct=False, infinite=True, error=0.002)
    assert within(scene.soil_aggregated["nir"]["Ei"], 200.0 * 0.3 / (1.0 - 0.4), 0.002)
    assert scene.soil_aggregated["nir"]["Eabs"] == 0.0


def test_white_soil_of_an_isolated_canopy():
    """The light on the soil does not jump where its reflectance becomes 1."""
    incident = []
    for reflectance in (1.0 - 1e-3, 1.0):
        scene = CaribuScene(HALVES, pattern=SQUARE, opt={"nir": (0.4, 0.3)}, soil_reflectance=reflectance, soil_mesh=0, z_soil=-1.0)
        scene.run(direct=False, error=0.002)
        incident.append(scene.soil_aggregated["nir"]["Ei"])
    assert incident[0] > 0.0 and within(incident[1], incident[0], 0.003)


@pytest.mark.parametrize(
    "mesh, is_soil", [(None, False), (-1, False), (np.int64(-1), False), (0, True), ([LOWER], True), (np.array([LOWER]), True)]
)
def test_meshes_of_soil(mesh, is_soil):
    scene = CaribuScene(HALVES, pattern=SQUARE, soil_mesh=mesh)
    scene.run(error=0.05)
    assert bool(scene.soil_aggregated) == is_soil


def test_soil_may_have_more_bands():
    scene = CaribuScene(HALVES, opt={"nir": (0.4, 0.3)}, soil_reflectance={"par": 0.1, "nir": 0.35})
    assert scene.soil_reflectance == {"nir": 0.35}
    assert CaribuScene(HALVES, soil_reflectance={"par": 0.1}).soil_reflectance == {"par": 0.1}


def test_primitives_without_triangles():
    scene = CaribuScene({"list": [], "array": np.empty((0, 3, 3)), **HALVES}, pattern=SQUARE)
    raw, aggregated = scene.run(error=0.05, simplify=True)
    for quantity, values in aggregated.items():
        assert raw[quantity]["list"] == raw[quantity]["array"] == []
        assert values["list"] == values["array"] == 0.0


def checkerboards(heights=(15, 10, 5), side=20, cells=8):
    """Each layer lets half of the light through that reaches it: it consists of a board's squares of one colour."""
    step = side / cells
    layers = {}
    for height in heights:
        layers[height] = []
        for i in range(cells):
            for j in range(cells):
                if (i + j) % 2:
                    continue
                x, y = i * step, j * step
                layers[height] += [
                    [(x, y, height), (x + step, y, height), (x, y + step, height)],
                    [(x + step, y, height), (x + step, y + step, height), (x, y + step, height)],
                ]
    return layers


def test_lists_of_lights():
    """A full layer receives all light, whatever its directions; the layer below receives nothing."""
    full = {"top": [[(0, 0, 2), (4, 0, 2), (0, 4, 2)], [(4, 0, 2), (4, 4, 2), (0, 4, 2)]], "below": [[(0, 0, 1), (1, 0, 1), (0, 1, 1)]]}
    lights = [(5.0, (0, 0, -1)), (2.0, (1, 1, -1)), (0.0, (0, 1, -1)), (3.0, (-2, 1, -0.5))]
    _, aggregated = CaribuScene(full, light=lights, pattern=(0, 0, 4, 4), opt={"par": (0.1,)}).run(infinite=True, error=0.005, simplify=True)
    assert within(aggregated["Ei"]["top"], 10.0, 0.005)
    assert aggregated["Ei"]["below"] == 0.0


@pytest.mark.filterwarnings("ignore:scene")
def test_low_light():
    """Light that just descends enough gives a level leaf its irradiance."""
    light = [(100.0, (1.0, 0.0, -math.tan(math.radians(0.011))))]
    _, aggregated = CaribuScene({"leaf": [LOWER]}, light=light, pattern=SQUARE).run(error=0.01, max_seconds=10, simplify=True)
    assert within(aggregated["Ei"]["leaf"] / 100.0, 1.0, 0.01)


def test_light_comes_from_where_it_comes():
    """A wall that faces west is lit by light that travels east, on the side it faces."""
    wall = {"wall": [[(0.5, 0.2, 0.2), (0.5, 0.2, 0.8), (0.5, 0.8, 0.2)]]}  # counter-clockwise when seen from the west
    for x, lit in ((1.0, "Ei_sup"), (-1.0, "Ei_inf")):
        _, aggregated = CaribuScene(wall, light=[(1.0, (x, 0.0, -1.0))], pattern=SQUARE).run(error=0.005, simplify=True)
        assert within(aggregated[lit]["wall"], 1.0, 0.005), "of a sun of 45 degrees: as much as a level plane"
        assert aggregated["Ei"]["wall"] == aggregated[lit]["wall"]
    _, aggregated = CaribuScene(wall, light=[(1.0, (0.0, 1.0, -1.0))], pattern=SQUARE).run(error=0.005, simplify=True)
    assert within(aggregated["Ei"]["wall"], 0.0, 0.005), "edge on"


def test_numbers_are_those_of_sunfleck():
    scene = CaribuScene(checkerboards(), light=[(1.0, (0.2, 0.4, -1.0))], pattern=(0, 0, 20, 20), opt={"par": (0.2, 0.1)})
    raw, aggregated = scene.run(direct=False, infinite=True, error=0.01)
    assert np.array_equal(np.concatenate([raw["par"]["Eabs"][height] for height in scene.scene]), scene.result["b0_absorbed"])
    absorbed = sum(aggregated["par"]["Eabs"][h] * aggregated["par"]["area"][h] for h in scene.scene) / 400.0
    assert absorbed == pytest.approx(scene.result.bands["b0"]["absorbed_vegetation"], rel=1e-9)
    again, _ = scene.run(direct=False, infinite=True, error=0.01)
    assert again == raw or all(math.isnan(x) for x in raw["par"]["Eabs_error"][15])


BAD = {
    "no scene": (lambda: CaribuScene({}), "must be a dict"),
    "a file": (lambda: CaribuScene("stand.can"), "a file"),
    "points of two": (lambda: CaribuScene({"a": [[(0, 0), (1, 0), (0, 1)]]}), "scene['a']"),
    "ragged triangles": (lambda: CaribuScene({"a": [LOWER, LOWER[:2]]}), "scene['a']"),
    "NaN": (lambda: CaribuScene({"a": [[(0, 0, math.nan), (1, 0, 0), (0, 1, 0)]]}), "NaN"),
    "a masked corner": (lambda: CaribuScene({"a": np.ma.masked_equal([LOWER], 1.0)}), "scene['a']: a masked array"),
    "a masked pattern": (lambda: CaribuScene(HALVES, pattern=np.ma.masked_equal([0, 0, 1, 2], 2)), "pattern: a masked array"),
    "light upwards": (lambda: CaribuScene(HALVES, light=[(1.0, (0, 0, 1))]), "light[0] direction"),
    "negative light": (lambda: CaribuScene(HALVES, light=[(-1.0, (0, 0, -1))]), "must not be negative"),
    "light of two": (lambda: CaribuScene(HALVES, light=[(1.0, (0, -1))]), "light[0]"),
    "a unit": (lambda: CaribuScene(HALVES, scene_unit="inch"), "scene_unit"),
    "a pattern of three": (lambda: CaribuScene(HALVES, pattern=(0, 0, 1)), "pattern"),
    "a pattern without area": (lambda: CaribuScene(HALVES, pattern=(0, 0, 0, 1)), "no area"),
    "a material of three": (lambda: CaribuScene(HALVES, opt={"par": (0.1, 0.1, 0.1)}), "opt['par']"),
    "a material above one": (lambda: CaribuScene(HALVES, opt={"par": (0.6, 0.5)}), "together at most 1"),
    "a missing material": (lambda: CaribuScene(HALVES, opt={"par": {"upper": (0.1,)}}), "primitive 'lower' has no material"),
    "no triangles": (lambda: CaribuScene({"a": np.empty((0, 3, 3)), "b": []}), "no triangles"),
    "a number as lights": (lambda: CaribuScene(HALVES, light=5), "light: int"),
    "an array that is no list": (lambda: CaribuScene(HALVES, light=np.array(5.0)), "light: ndarray"),
    "an array of lights": (lambda: CaribuScene(HALVES, light=np.array([[1, 0, 0, -1.0]])), "light[0]"),
    "a grazing light": (lambda: CaribuScene(HALVES, light=[(100.0, (1, 0, -1e-7))]), "must descend by 0.01 degrees"),
    "one grazing light of two": (lambda: CaribuScene(HALVES, light=[(1, (0, 0, -1)), (1, (1, 0, -1e-7))]), "light[1] direction"),
    "a list of units": (lambda: CaribuScene(HALVES, scene_unit=["m"]), "scene_unit"),
    "files of materials": (lambda: CaribuScene(HALVES, opt=["par.opt"]), "opt: list"),
    "a material without a band": (lambda: CaribuScene(HALVES, opt=(0.1, 0.05)), "opt: tuple"),
    "a number as materials": (lambda: CaribuScene(HALVES, opt=0.1), "opt: float"),
    "a set of bands": (lambda: CaribuScene(HALVES, opt={"par"}), "opt: set"),
    "soil of another band": (
        lambda: CaribuScene(HALVES, opt={"nir": (0.4, 0.3)}, soil_reflectance={"NIR": 0.35}),
        "band 'nir' has no reflectance",
    ),
    "soil without a band": (lambda: CaribuScene(HALVES, soil_reflectance={}), "soil_reflectance"),
    "soil without a number": (lambda: CaribuScene(HALVES, soil_reflectance={"nir": None}), "soil_reflectance['nir']"),
    "a list of bounds": (lambda: CaribuScene(HALVES, pattern=SQUARE).run(of=["canopy"]), "of = "),
    "soil above one": (lambda: CaribuScene(HALVES, soil_reflectance=1.5), "soil_reflectance"),
    "no pattern": (lambda: CaribuScene(HALVES).run(infinite=True), "pattern"),
    "sensors": (lambda: CaribuScene(HALVES, pattern=SQUARE).run(sensors={}), "sensors"),
    "no error": (lambda: CaribuScene(HALVES, pattern=SQUARE).run(error=0.0), "error"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input(name):
    work, words = BAD[name]
    with pytest.raises(ValueError) as error:
        work()
    message = str(error.value)
    assert words in message and "\n" not in message and "); " in message


def test_dark():
    _, aggregated = CaribuScene(HALVES, light=[(0.0, (0, 0, -1))], pattern=SQUARE).run(simplify=True)
    assert aggregated["Ei"]["upper"] == 0.0 and sunfleck.__version__


def test_the_canopy_is_bounded_and_primitives_have_errors():
    scene = CaribuScene(HALVES, pattern=SQUARE)
    told = []
    _, aggregated = scene.run(error=0.02, simplify=True, progress=told.append)
    summary = scene.result.summary
    assert scene.result.complete and summary["settings"]["of"] == "canopy" and told[-1]["fraction"] == 1.0
    for primitive in HALVES:
        assert 0.0 < aggregated["Eabs_error"][primitive] < 0.1
    assert abs(aggregated["Eabs"]["upper"] - 0.87) <= 2.0 * aggregated["Eabs_error"]["upper"]
    finer = CaribuScene(HALVES, pattern=SQUARE)
    finer.run(error=0.02, of="triangle")
    assert finer.result.summary["settings"]["of"] == "triangle"
    with pytest.raises(ValueError, match="of = 'leaf'"):
        scene.run(of="leaf")


def test_limits_cut_a_simulation_short():
    scene = CaribuScene(HALVES, pattern=SQUARE)
    scene.run(error=1e-6, max_rays=200_000)
    assert not scene.result.complete and scene.result.summary["direct"]["rays"] <= 200_000
    scene.run(error=1e-6, max_seconds=0.5)
    assert not scene.result.complete


def test_errors_of_primitives_are_those_of_the_organs():
    scene = CaribuScene(HALVES, pattern=SQUARE)
    _, aggregated = scene.run(error=0.02, simplify=True)
    organs = scene.result.organs
    for number, primitive in enumerate(HALVES, 1):
        (row,) = np.flatnonzero(organs["plant"] == number)
        assert aggregated["Eabs_error"][primitive] > 0.0
        assert aggregated["area"][primitive] == pytest.approx(organs["area_m2"][row])
