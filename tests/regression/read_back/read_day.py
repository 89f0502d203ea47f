"""Reads day.nc with xarray and decodes its times."""

import numpy
import xarray

import common


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def read(file):
    data = xarray.open_dataset(file)
    times = data["time_bounds"].values.astype("datetime64[s]").astype(str)
    starts = data["time"].values.astype("datetime64[s]").astype(str)
    assert (times[:, 0] == starts).all()
    bands = [name[:-len("_absorbed")] for name in data.data_vars if name.endswith("_absorbed")]
    endings = {band: sorted(name[len(band) + 1:] for name in data.data_vars if name.startswith(band + "_")) for band in bands}
    for band in bands:
        assert all(data[f"{band}_{ending}"].dims == ("time", "triangle") for ending in endings[band])
    return {
        "sizes": {name: data.sizes[name] for name in ("time", "triangle")},
        "starts": list(starts),
        "ends": list(times[:, 1]),
        "local": [text(value) for value in data["local_time"].values],
        "conventions": data.attrs["Conventions"],
        "columns": endings,
        "absorbed_w": {band: [float(w) for w in (data[f"{band}_absorbed"].values.astype(numpy.float64)
                                                  * data["area_m2"].values).sum(axis=1)] for band in bands},
    }


if __name__ == "__main__":
    common.report(read)
