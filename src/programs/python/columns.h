#pragma once
// A table as a dict of arrays, one per column, named as in the result files.

#include "files/results/tables/table.h"

#include <pybind11/pybind11.h>

namespace sunfleck {

// Returns the columns that are in_arrays, after those of `first`: numbers as read-only arrays of the shape of the axes along which
// they vary, single numbers as floats, texts as lists; the categories of NAME become the list NAME_name behind NAME. Arrays share
// the memory of the table or, for columns that it does not own, memory that `holder` keeps alive.
[[nodiscard]] pybind11::dict columns_of(const Table& table, const pybind11::handle& holder = {}, pybind11::dict first = {});

// Returns the unit, the meaning and whether xarray has it, for each column of the table as text or as arrays.
[[nodiscard]] pybind11::dict descriptions_of(const Table& table);

}  // namespace sunfleck
