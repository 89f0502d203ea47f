#pragma once
#include "base/error.h"
#include "bvh/bvh.h"  // up
