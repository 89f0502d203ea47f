"""Reads organs_steps.nc or plane_H_day.nc with xarray and decodes the times."""

import numpy
import xarray

import common


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def read(file):
    data = xarray.open_dataset(file)
    found = {
        "sizes": {name: int(size) for name, size in data.sizes.items()},
        "starts": list(data["time"].values.astype("datetime64[s]").astype(str)),
        "conventions": data.attrs["Conventions"],
        "coordinates": sorted(data["PAR_absorbed" if "organ" in data.sizes else "PAR_total"].coords),
    }
    seconds = numpy.diff(data["time_bounds"].values, axis=1)[:, 0] / numpy.timedelta64(1, "s")
    lights = [name for name in data.data_vars if name.startswith(("PAR_", "NIR_")) or name == "sunfleck"]
    found["sums"] = {}
    for name in lights:
        values = data[name].values.astype(numpy.float64)
        assert data[name].dims[0] == "time", name
        found["sums"][name] = [float(value) for value in numpy.tensordot(seconds, numpy.nan_to_num(values), 1).ravel()]
    if "organ" in data.sizes:
        found["organs"] = [text(value) for value in data["organ_name"].values]
        found["roles"] = [text(value) for value in data["role"].values]
        found["area_m2"] = [float(value) for value in data["area_m2"].values]
        found["plants"] = [int(value) for value in data["plant"].values]
    return found


if __name__ == "__main__":
    common.report(read)
