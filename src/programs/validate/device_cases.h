#pragma once
// Compares every ray and every tally of the device under test as integers.

#include "programs/validate/case_bench.h"

namespace sunfleck {

// Adds rows that compare the tree with a test of every element, and the device with the CPU path.
void device_cases(CaseBench& bench);

// Adds rows about counters beyond the range of single precision.
void counter_cases(CaseBench& bench);

// Adds rows about the ledgers of black scenes and of scenes that absorb nothing.
void ledger_cases(CaseBench& bench);

}  // namespace sunfleck
