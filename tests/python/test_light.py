"""Tests sun and sky without a canopy."""

import datetime
import json

import numpy as np
import pytest
import sunfleck
from conftest import TABLES, program, with_arrays

PAPER = "2002-08-08T10:10:00+08:00"


def test_sun_is_that_of_the_program(scene_file):
    scene_file.write_text(
        scene_file.read_text().replace("elevation = 50.0\nazimuth = 130.0", f"time = {PAPER}\nlatitude = 40.02\nlongitude = 116.28")
    )
    expected = json.loads(program("info", scene_file, "--json").stdout)["sun"]
    elevation, azimuth = sunfleck.sun_position(PAPER, 40.02, 116.28)
    assert elevation == pytest.approx(expected["elevation_deg"], abs=1e-9)
    assert azimuth == pytest.approx(expected["azimuth_deg"], abs=1e-9)


def test_times_of_all_kinds_are_one():
    moment = datetime.datetime.fromisoformat(PAPER)
    expected = sunfleck.sun_position(PAPER, 40.0, 116.0)
    assert sunfleck.sun_position(moment, 40.0, 116.0) == expected
    assert sunfleck.sun_position(np.datetime64("2002-08-08T02:10:00"), 40.0, 116.0) == expected
    elevation, azimuth = sunfleck.sun_position([[PAPER, moment]], 40.0, 116.0)
    assert elevation.shape == azimuth.shape == (1, 2)
    assert elevation.tolist() == [[expected[0]] * 2]


@pytest.mark.parametrize(
    "arguments", [("today", 0, 0), (datetime.datetime(2002, 8, 8), 0, 0), (PAPER, 91, 0), (PAPER, 0, 999), (PAPER, float("nan"), 0),
                  (5, 0, 0), ([1, 2], 0, 0), (np.datetime64("NaT"), 0, 0), ("1500-01-01T00:00:00+00:00", 0, 0),
                  (np.datetime64("300000-01-01", "s"), 40, 0), (np.datetime64(2**62, "s"), 40, 0),
                  (np.datetime64("1899", "Y"), 40, 0), (PAPER, 40, 0, 1e300), (PAPER, 40, 0, -1000), (PAPER, 40, 0, float("inf")),
                  (np.ma.array(np.array(["2002-08-08", "2002-08-09"], "M8[s]"), mask=[False, True]), 40, 0)]
)  # fmt: skip
def test_bad_times_and_places(arguments):
    with pytest.raises(sunfleck.InputError, match=r"\(.*\); ") as error:
        sunfleck.sun_position(*arguments)
    assert "\n" not in str(error.value) and ".cpp" not in str(error.value)


def test_first_and_last_years():
    for text in ("1900-01-01T00:00", "2100-12-31T23:59"):
        assert sunfleck.sun_position(np.datetime64(text), 40, 0, 9000) == sunfleck.sun_position(f"{text}:00+00:00", 40, 0, 9000)


def level_irradiance(sky, step=0.5):
    """Returns the integral of radiance times the sine of elevation."""
    elevation = np.arange(step / 2, 90, step)
    azimuth = np.arange(step / 2, 360, step)
    radiance = sky.radiance(elevation[:, None], azimuth[None, :])
    ring = np.radians(step) * np.cos(np.radians(elevation)) * np.sin(np.radians(elevation))
    return float((radiance.sum(axis=1) * np.radians(step) * ring).sum())


@pytest.mark.parametrize("model", ["uniform", "cie-overcast", "cie-clear", "cie", "perez"])
def test_skies_shed_one_watt(model):
    more = {"cie": {"type": 7}, "perez": {"dni": 500.0, "dhi": 200.0}}.get(model, {})
    sky = sunfleck.sky(model, sun={"elevation": 40.0, "azimuth": 120.0}, **more)
    # The tolerance covers midpoints of half a degree against cells of half and one degree.
    assert level_irradiance(sky) == pytest.approx(1.0, abs=2e-3)
    assert sky.radiance(-5.0, 0.0) == 0.0
    assert sky.lights == []


def test_uniform_sky():
    sky = sunfleck.sky("uniform")
    assert sky.radiance(30.0, 200.0) == pytest.approx(1.0 / np.pi, rel=1e-4)
    assert sky.spherical_irradiance == pytest.approx(2.0, rel=1e-4)
    ways = sky.draw(20000, seed=3)
    assert ways.shape == (20000, 3)
    assert np.allclose(np.linalg.norm(ways, axis=1), 1.0)
    # The mean sine of elevation, weighted by the cosine law, is 2/3; strata in zenith angle leave an error far below 1/sqrt(n).
    assert ways[:, 1].mean() == pytest.approx(2.0 / 3.0, abs=1e-4)
    assert np.array_equal(ways, sky.draw(20000, seed=3)) and not np.array_equal(ways, sky.draw(20000, seed=4))


def test_lights(tmp_path):
    (tmp_path / "two.light").write_text("3 0 0 -1\n1 1 0 -1\n")
    sky = sunfleck.sky("lights", file="two.light", folder=tmp_path)
    (zenith, up), (other, slanting) = sky.lights
    assert (zenith, other) == (0.75, 0.25) and up == (0.0, 1.0, 0.0)
    assert slanting == pytest.approx((0.0, np.sqrt(0.5), np.sqrt(0.5)))
    with pytest.raises(ValueError, match="single lights"):
        sky.radiance(10.0, 0.0)


def test_bad_skies():
    for model, more in (("grey", {}), ("cie", {"type": 99}), ("perez", {}), ("cie-clear", {})):
        with pytest.raises(ValueError, match=r"\(.*\); "):
            sunfleck.sky(model, **more)
    with pytest.raises(ValueError, match="must be finite"):
        sunfleck.sky("uniform").radiance(float("nan"), 0.0)
    with pytest.raises(ValueError, match="masked"):
        sunfleck.sky("uniform").radiance(np.ma.masked_equal([10.0, 20.0], 20.0), 0.0)


def test_times_of_numpy_are_utc_and_offsets_may_have_seconds():
    place = {"latitude": 48.85, "longitude": 2.35}
    utc = datetime.datetime(2024, 7, 10, 10, 0, tzinfo=datetime.timezone.utc)
    odd = utc.astimezone(datetime.timezone(datetime.timedelta(hours=2, seconds=30)))
    suns = {
        sunfleck.Simulation(with_arrays({**TABLES, "sun": {"time": time, **place}}), device="cpu").sun
        for time in (utc, odd, np.datetime64("2024-07-10T10:00"), np.datetime64("2024-07-10T10:00", "ns"))
    }
    assert len(suns) == 1
