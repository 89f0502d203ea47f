#pragma once
// tinygltf as we use it: it opens no files and decodes no pictures. Every file that needs it includes it through here, since
// these switches change its classes.

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

#include <tiny_gltf.h>
