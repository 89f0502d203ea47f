"""Reads rows that were stored chunk by chunk: row r of variable v holds 1000 v + 100 r + (column modulo 97) / 8."""

import netCDF4
import numpy

import common


def read(file):
    with netCDF4.Dataset(file) as data:
        columns = numpy.arange(data.dimensions["column"].size)
        expected = [[1000 * v + 100 * r + (columns % 97) / 8 for r in range(3)] for v in range(2)]
        found = [data[name][:].filled(numpy.nan) for name in ("first", "second")]
        return {
            "filters": data["second"].filters()["zlib"] and data["second"].filters()["shuffle"],
            "chunks": data["first"].chunking(),
            "wrong": int((numpy.array(found) != numpy.array(expected, dtype=numpy.float32)).sum()),
            "kept": int(data["kept"][1]),
        }


if __name__ == "__main__":
    common.report(read)
