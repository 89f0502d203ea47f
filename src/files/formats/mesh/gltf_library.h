#pragma once
// Includes tinygltf, configured to open no files and to decode no images. Include it only through this header, because these
// switches change its classes.

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

#include <tiny_gltf.h>
