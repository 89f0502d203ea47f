#include "view/image.h"
#include "tracers/cpu_tracer.h"  // sideways
  #  include "../canopy/canopy.h"  // hidden
