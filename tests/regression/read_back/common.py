"""What the scripts share: each prints one JSON object about the file that is its only argument."""

import json
import sys

BANDS = ("PAR", "NIR", "A", "B-2")
COLUMNS = ("direct_upper", "direct_lower", "sky_upper", "sky_lower", "indirect_upper", "indirect_lower", "total",
           "absorbed", "error")


def report(read):
    """read: from the file's name to a dictionary of plain values."""
    json.dump(read(sys.argv[1]), sys.stdout)


def sums(columns, area_m2):
    """Watts on the whole: the sum of column times area, for each column of light but the errors."""
    return {name: float((values * area_m2).sum()) for name, values in columns.items() if not name.endswith("_error")}


def missing(columns):
    """How many triangles have no confidence interval."""
    return {name: int((values != values).sum()) for name, values in columns.items() if name.endswith("_error")}


def bounds(places):
    """Of points [..., axis]: the least and the greatest x, then y, then z; none without points."""
    return [float(v) for k in range(3) for v in (places[..., k].min(), places[..., k].max())] if places.size else []


def is_light(name):
    return any(name == f"{band}_{column}" for band in BANDS for column in COLUMNS)
