#include "files/formats/mesh/mesh_reader.h"
#include "devices/tracers/cpu_tracer.h"  // sideways
  #  include "../../physics/canopy/canopy.h"  // hidden
