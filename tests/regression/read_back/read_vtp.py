"""Reads canopy.vtp with VTK."""

import vtk
from vtk.util.numpy_support import vtk_to_numpy

import common


def read(file):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    canopy = reader.GetOutput()
    cells = canopy.GetCellData()
    arrays = {cells.GetArrayName(i): vtk_to_numpy(cells.GetArray(i)) for i in range(cells.GetNumberOfArrays())}
    light = {name: values for name, values in arrays.items() if common.is_light(name)}
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(canopy)
    sizes.Update()
    fields = canopy.GetFieldData()
    texts = {}
    for i in range(fields.GetNumberOfArrays()):
        texts[fields.GetArrayName(i)] = [fields.GetAbstractArray(i).GetValue(k)
                                         for k in range(fields.GetAbstractArray(i).GetNumberOfTuples())]
    units = {cells.GetArrayName(i): cells.GetArray(i).GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL())
             for i in range(cells.GetNumberOfArrays())}
    soil = [texts["organ_names"][kind].startswith("soil") for kind in arrays["organ"]]
    plants = [not is_soil for is_soil in soil]
    area = arrays["area_m2"]
    return {
        "triangles": canopy.GetNumberOfCells(),
        "in_order": bool((arrays["triangle"] == range(canopy.GetNumberOfCells())).all()),
        "columns": sorted(light),
        "units": units,
        "vegetation": common.sums({name: values[plants] for name, values in light.items()}, area[plants]),
        "all": common.sums(light, area),
        "no_interval": common.missing(light),
        "area_m2": float(area.sum()),
        "area_of_shapes_m2": float(vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Area")).sum()),
        "bounds": canopy.GetBounds(),
        "record": {name: values[0] for name, values in texts.items() if name not in ("organ_names", "optics_names")},
        "organ_names": texts["organ_names"],
        "optics_names": texts["optics_names"],
        "plants": sorted({int(plant) for plant in arrays["plant"]}),
        "ranks": sorted({int(rank) for rank in arrays["rank"]}),
    }


common.report(read)
