"""Tests that a sweep gives each variant what a run with its optics gives."""

import numpy as np
import pytest
import sunfleck
import tomli_w
from conftest import TABLES, with_arrays, with_file

REFLECTANCE = [0.05, 0.1, 0.2]
OPTICS = {"leaf": {"reflectance": {"PAR": REFLECTANCE, "NIR": 0.4}}}
WORK = {"grid": 0.02, "passes": 24, "device": "cpu"}


@pytest.fixture(scope="module")
def variants():
    return sunfleck.sweep(with_arrays(), optics=OPTICS, soil={"reflectance": {"PAR": [0.1, 0.15, 0.2], "NIR": 0.3}}, **WORK)


def expect_close(one, other, error, other_error):
    """Three half-widths of 95 % are 5.9 standard errors."""
    assert np.all(np.abs(one - other) <= 3.0 * np.hypot(error, other_error) + 1e-9)


def test_variants_are_runs(variants):
    assert [variant.number for variant in variants] == [0, 1, 2]
    for number, variant in enumerate(variants):
        work = {key: value for key, value in WORK.items() if key != "device"}
        optics = {"leaf": {**TABLES["optics"]["leaf"], "reflectance": {"PAR": REFLECTANCE[number], "NIR": 0.4}}}
        soil = {"reflectance": {"PAR": [0.1, 0.15, 0.2][number], "NIR": 0.3}}
        run = sunfleck.Simulation(with_arrays(), device="cpu").run(optics=optics, soil=soil, seed=100 + number, **work)
        assert list(variant.bands) == list(run.bands) == ["PAR", "NIR"]
        assert list(variant.organs) == list(run.organs)
        assert list(variant.triangles) == list(run.triangles)
        assert list(variant.profile) == list(run.profile)
        assert list(variant.plants) == list(run.plants)
        assert [list(plane) for plane in variant.planes] == [list(plane) for plane in run.planes]
        assert [list(sensor) for sensor in variant.sensors] == [list(sensor) for sensor in run.sensors]
        assert list(variant.sensor_means) == list(run.sensor_means)
        for name, band in variant.bands.items():
            assert band["residual"] == 0 and band["name"] == name
            for term in ("absorbed_vegetation", "absorbed_soil", "reflected"):
                expect_close(band[term], run.bands[name][term], band["error"][term], run.bands[name]["error"][term])
            column = f"{name}_absorbed"
            expect_close(variant.organs[column], run.organs[column], variant.organs[f"{column}_error"], run.organs[f"{column}_error"])
        assert variant["PAR_absorbed"].shape == (3,)
    # What is more reflective absorbs less.
    absorbed = [variant.bands["PAR"]["absorbed_vegetation"] for variant in variants]
    assert absorbed[0] > absorbed[1] > absorbed[2]
    assert "PAR" in repr(variants[0])


def test_variants_share_packets(variants):
    assert all(variant.result is variants[0].result for variant in variants)
    assert list(variants[0].result.bands) == ["PAR-1", "NIR-1", "PAR-2", "NIR-2", "PAR-3", "NIR-3"]
    # Nothing that varies concerns the near infrared but the light of the other band's packets.
    first, last = (variants[k].bands["NIR"]["absorbed_vegetation"] for k in (0, 2))
    assert first == pytest.approx(last, rel=1e-9)


def test_data_frames(variants):
    frame = variants[1].to_dataframe("organs")
    assert "PAR_absorbed" in frame.columns and not any("-" in name for name in frame.columns)
    assert frame.attrs["units"]["PAR_absorbed"] == "W m-2"
    np.testing.assert_array_equal(frame["PAR_absorbed"].to_numpy(), variants[1].organs["PAR_absorbed"])
    assert list(variants[2].to_dataframe("bands").index) == ["PAR", "NIR"]


FACES = {"upper": {"reflectance": 0.1, "transmittance": 0.05}, "lower": {"reflectance": 0.2, "transmittance": 0.1}}
PLAIN = {"reflectance": 0.1, "transmittance": 0.05}


@pytest.mark.parametrize(
    "leaf, change, same",
    [
        (FACES, {"reflectance": [0.3]}, {face: {**FACES[face], "reflectance": 0.3} for face in FACES}),
        (FACES, {"upper": {"reflectance": [0.3]}}, {"upper": {**FACES["upper"], "reflectance": 0.3}, "lower": FACES["lower"]}),
        (PLAIN, {"upper": {"reflectance": [0.3]}}, {"upper": {**PLAIN, "reflectance": 0.3}, "lower": PLAIN}),
        (PLAIN, {"reflectance": {"PAR": [0.3]}}, {**PLAIN, "reflectance": {"PAR": 0.3, "NIR": 0.1}}),
    ],
    ids=["both_faces", "one_face", "a_face_of_a_plain_table", "one_band"],
)
def test_what_is_left_out_stays(leaf, change, same):
    tables = {**TABLES, "optics": {**TABLES["optics"], "leaf": leaf}}
    (only,) = sunfleck.sweep(with_arrays(tables), optics={"leaf": change}, **WORK)
    run = sunfleck.run(with_arrays({**tables, "optics": {**TABLES["optics"], "leaf": same}}), **WORK)
    for name, band in run.bands.items():
        for term in ("absorbed_vegetation", "absorbed_soil", "reflected"):
            assert only.bands[name][term] == band[term], (name, term)


def test_lamps_spectra_and_photons(tmp_path):
    (tmp_path / "leaf.csv").write_text("wavelength,reflectance,transmittance\n300,0.1,0.05\n2500,0.1,0.05\n")
    band = [{"name": "PAR", "direct": 500.0, "unit": "umol_m2_s", "diffuse": 10.0}]
    optics = {"leaf": {"reflectance": 0.1}, "stem": {"reflectance": 0.2, "emission": 10.0}}
    scene = with_arrays({**TABLES, "band": band, "optics": optics, "soil": {"reflectance": 0.15}})
    changes = {"stem": {"upper": {"reflectance": [0.2]}}}
    (only,) = sunfleck.sweep(scene, optics=changes, **WORK)
    run = sunfleck.run(scene, **WORK)
    assert only.bands["PAR"]["absorbed_vegetation"] == run.bands["PAR"]["absorbed_vegetation"]
    band = [{"name": "PAR", "direct": 100.0, "diffuse": 20.0, "range_nm": [400.0, 700.0]}]
    optics = {"leaf": {"spectrum": "leaf.csv"}, "stem": {"reflectance": 0.2}}
    scene = with_arrays({**TABLES, "band": band, "optics": optics, "soil": {"reflectance": 0.15}})
    (only,) = sunfleck.sweep(scene, folder=tmp_path, optics={"stem": {"reflectance": [0.2]}}, **WORK)
    run = sunfleck.run(scene, folder=tmp_path, **WORK)
    assert only.bands["PAR"]["reflected"] == run.bands["PAR"]["reflected"]
    assert only.to_dataframe("sensors").shape == run.to_dataframe("sensors").shape


def test_a_file_that_is_missing_or_broken_is_named(tmp_path):
    with pytest.raises(sunfleck.MissingFileError, match="absent.toml"):
        sunfleck.sweep(tmp_path / "absent.toml", optics=OPTICS, device="cpu")
    (tmp_path / "broken.toml").write_text("[plot\n")
    with pytest.raises(sunfleck.InputError, match="broken.toml"):
        sunfleck.sweep(tmp_path / "broken.toml", optics=OPTICS, device="cpu")


def test_of_a_file(tmp_path):
    from conftest import OBJ

    (tmp_path / "leaves.obj").write_text(OBJ)
    file = tmp_path / "scene.toml"
    file.write_text(tomli_w.dumps(with_file()))
    faces = {"leaf": {"upper": {"reflectance": [0.1, 0.2], "transmittance": 0.05}, "lower": {"reflectance": 0.1}}}
    two = sunfleck.sweep(file, optics=faces, device="cpu", grid=0.05, passes=8)
    assert len(two) == 2 and two[0].complete
    assert two[0].bands["PAR"]["reflected"] < two[1].bands["PAR"]["reflected"]


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"optics": {"leaf": {"reflectance": [0.1, 0.2], "transmittance": [0.1]}}}, "optics.leaf.transmittance: 1 values"),
        ({"optics": {"leaf": {"reflectance": 0.1}}}, "nothing varies"),
        ({}, "nothing varies"),
        ({"optics": {"leaf": {"reflektance": [0.1, 0.2]}}}, "optics.leaf.reflektance (no such values can vary)"),
        ({"optics": {"leaf": {"reflectance": []}}}, "optics.leaf.reflectance (the list is empty)"),
        ({"optics": {"leaf": [0.1, 0.2]}}, "optics.leaf: list"),
        ({"optics": [0.1, 0.2]}, "optics: list"),
        ({"optics": {"leaf": {"reflectance": [0.1, 0.2]}}, "band": []}, "band"),
        ({"optics": {"leaf": {"reflectance": [0.1, 1.2]}}}, "1.2"),
        ({"optics": {"leaf": {"spectrum": "leaf.csv", "reflectance": [0.1, 0.2]}}}, "optics.leaf.spectrum"),
        ({"optics": {"leaf": {"reflectance": {"PAR": [0.1, 0.2], "UV": 0.1}}}}, "UV"),
    ],
)
def test_mistakes_are_named(wrong, message):
    with pytest.raises(sunfleck.InputError) as caught:
        sunfleck.sweep(with_arrays(), device="cpu", passes=8, grid=0.1, **wrong)
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_scenes_without_named_bands_are_refused():
    scene = with_arrays()
    scene["bands"] = {"from": 400.0, "to": 500.0, "step": 50.0, "direct": 100.0}
    del scene["band"]
    with pytest.raises(sunfleck.InputError, match="no list of named bands"):
        sunfleck.sweep(scene, optics={"leaf": {"reflectance": [0.1, 0.2]}}, device="cpu")
