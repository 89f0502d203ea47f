"""Reads canopy.ply with meshio: the values of a triangle are stored at its three vertices."""

import meshio
import numpy

import common


def comments(file):
    found = {}
    with open(file, "rb") as lines:
        for line in lines:
            if line.startswith(b"end_header"):
                return found
            if line.startswith(b"comment ") and b": " in line:
                key, value = line[len(b"comment "):].decode("utf-8").rstrip("\n").split(": ", 1)
                found[key] = value


def read(file):
    mesh = meshio.read(file)
    corners = mesh.cells_dict["triangle"]
    places = mesh.points[corners].astype(float)
    sides = numpy.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    at = {name: values[corners] for name, values in mesh.point_data.items()}
    same = all(((values == values[:, :1]) | (values != values)).all() for values in at.values())
    arrays = {name: values[:, 0] for name, values in at.items()}
    light = {name: values for name, values in arrays.items() if common.is_light(name)}
    record = comments(file)
    plants = numpy.array([not record[f"organ {kind}"].startswith("soil") for kind in arrays["organ"]])
    area = arrays["area_m2"]
    return {
        "triangles": len(corners),
        "in_order": bool((arrays["triangle"] == numpy.arange(len(corners))).all()),
        "same_at_all_corners": bool(same),
        "columns": sorted(light),
        "units": {name: record[name].split(",")[0] for name in light},
        "vegetation": common.sums({name: values[plants] for name, values in light.items()}, area[plants]),
        "all": common.sums(light, area),
        "no_interval": common.missing(light),
        "area_m2": float(area.sum()),
        "area_of_shapes_m2": float(0.5 * numpy.linalg.norm(sides, axis=1).sum()),
        "bounds": common.bounds(places),
        "record": record,
        "greys": [int(v) % 256 for v in arrays["red"][:3]] if "red" in arrays else [],
    }


common.report(read)
