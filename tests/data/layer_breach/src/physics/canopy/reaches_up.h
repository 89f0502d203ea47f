#pragma once
#include "base/error.h"
#include "physics/bvh/bvh.h"  // up
