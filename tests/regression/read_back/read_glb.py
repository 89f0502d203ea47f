"""Reads canopy.glb with VTK, which keeps attributes of any name."""

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

import common


def pieces(file):
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(file)
    reader.Update()
    blocks = reader.GetOutput().NewIterator()
    blocks.InitTraversal()
    while not blocks.IsDoneWithTraversal():
        yield blocks.GetCurrentDataObject()
        blocks.GoToNextItem()


def read(file):
    columns, places, shapes = {}, [], 0
    for piece in pieces(file):
        corners = vtk_to_numpy(piece.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        data = piece.GetPointData()
        for i in range(data.GetNumberOfArrays()):
            values = vtk_to_numpy(data.GetArray(i))[corners]
            columns.setdefault(data.GetArrayName(i), []).append(values)
        places.append(vtk_to_numpy(piece.GetPoints().GetData())[corners])
        shapes += 1
    at = {name: numpy.concatenate(values).astype(float) for name, values in columns.items()}
    places = numpy.concatenate(places).astype(float)
    order = numpy.argsort(at["_TRIANGLE"][:, 0])
    arrays = {name: values[order, 0] for name, values in at.items()}
    names = {f"_{band}_{column.upper()}": f"{band}_{column}" for band in common.BANDS for column in common.COLUMNS}
    light = {names[name]: values for name, values in arrays.items() if name in names}
    sides = numpy.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    area = arrays["_AREA_M2"]
    return {
        "triangles": len(order),
        "shapes": shapes,
        "in_order": bool((arrays["_TRIANGLE"] == numpy.arange(len(order))).all()),
        "same_at_all_corners": all(bool((values == values[:, :1]).all()) for values in at.values()),
        "columns": sorted(light),
        "all": common.sums(light, area),
        "no_interval": {name: int((values == -1.0).sum()) for name, values in light.items() if name.endswith("_error")},
        "area_m2": float(area.sum()),
        "area_of_shapes_m2": float(0.5 * numpy.linalg.norm(sides, axis=1).sum()),
        "bounds": common.bounds(places),
        "greys": [float(v) for v in arrays["COLOR_0"][:3, 0]] if "COLOR_0" in arrays else [],
    }


common.report(read)
