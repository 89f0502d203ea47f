#include "bvh/bvh.h"
#include "view/image.h"  // up
#include <vulkan/vulkan.h>  // not its library
