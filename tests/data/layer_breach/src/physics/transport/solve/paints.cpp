#include "physics/bvh/bvh.h"
#include "pictures/drawing/image.h"  // up
#include <vulkan/vulkan.h>  // not its library
