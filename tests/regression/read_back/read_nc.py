"""Reads results.nc with xarray and with netCDF4."""

import netCDF4
import numpy
import xarray

import common


def read(file):
    data = xarray.open_dataset(file)
    light = {name: data[name].values for name in data.variables if common.is_light(name)}
    organ_names = [str(name) for name in data.organ_name.values]
    plants = numpy.array([not organ_names[kind].startswith("soil") for kind in data.organ.values], dtype=bool)
    area = data.area_m2.values
    places = numpy.stack([data[f"corner_{axis}"].values for axis in "xyz"], axis=-1)
    sides = numpy.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    centroids = numpy.stack([data[axis].values for axis in "xyz"], axis=-1)
    with netCDF4.Dataset(file) as plain:
        model = plain.data_model
        units = {name: plain[name].units for name in plain.variables if common.is_light(name)}
        named = all("long_name" in variable.ncattrs() for variable in plain.variables.values())
        organ = plain["organ"].__dict__
        flags = [int(flag) for flag in numpy.atleast_1d(organ.get("flag_values", []))]
        meanings = organ.get("flag_meanings", "").split()
        organs_read_alike = [str(name) for name in plain["organ_name"][:]] == organ_names
    return {
        "data_model": model,
        "triangles": int(data.sizes["triangle"]),
        "in_order": bool((data.triangle.values == numpy.arange(data.sizes["triangle"])).all()),
        "columns": sorted(light),
        "units": units,
        "all_have_long_names": named,
        "flags": flags,
        "flag_meanings": meanings,
        "organs_read_alike": organs_read_alike,
        "vegetation": common.sums({name: values[plants] for name, values in light.items()}, area[plants]),
        "all": common.sums(light, area),
        "no_interval": common.missing(light),
        "area_m2": float(area.sum()),
        "area_of_shapes_m2": float(0.5 * numpy.linalg.norm(sides, axis=1).sum()),
        "centroids_off_m": float(numpy.abs(places.mean(axis=1) - centroids).max(initial=0.0)),
        "bounds": common.bounds(places),
        "record": {key: str(value) for key, value in data.attrs.items()},
        "organ_names": organ_names,
        "optics_names": [str(name) for name in data.optics_name.values],
        "plants": sorted({int(plant) for plant in data.plant.values}),
        "ranks": sorted({int(rank) for rank in data["rank"].values}),
        "bands": [str(name) for name in data.band_name.values],
        "absorbed_vegetation": [float(value) for value in data.absorbed_vegetation.values],
        "incident": [float(value) for value in data.incident.values],
        "plot_area_m2": float(data.plot_area_m2),
        "planes": int(data.sizes.get("plane_height", 0)),
    }


common.report(read)
