#pragma once
#include "physics/transport/indirect/replicate.h"  // up, within its room
