"""Functions shared by the scripts, each of which prints one JSON object about the file that is its only argument."""

import json
import sys

BANDS = ("PAR", "NIR", "A", "B-2")
COLUMNS = ("direct_upper", "direct_lower", "sky_upper", "sky_lower", "indirect_upper", "indirect_lower", "total",
           "absorbed", "absorbed_error")


def report(read):
    """Prints the dictionary of plain values that `read` makes of the file's name."""
    json.dump(read(sys.argv[1]), sys.stdout)


def sums(columns, area_m2):
    """Returns total watts: the sum of column times area, for each column of light except the errors."""
    return {name: float((values * area_m2).sum()) for name, values in columns.items() if not name.endswith("_error")}


def missing(columns):
    """Returns how many triangles have no confidence interval."""
    return {name: int((values != values).sum()) for name, values in columns.items() if name.endswith("_error")}


def bounds(places):
    """Returns the least and the greatest x, then y, then z of points [..., axis]; empty without points."""
    return [float(v) for k in range(3) for v in (places[..., k].min(), places[..., k].max())] if places.size else []


def is_light(name):
    return any(name == f"{band}_{column}" for band in BANDS for column in COLUMNS)
