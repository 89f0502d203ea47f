// Compiles the implementation of a header-only library; only this file does so.

// tinygltf needs this header but omits it if TINYGLTF_NO_FS is set.
#include <fstream>

#define TINYGLTF_IMPLEMENTATION
#include "files/formats/mesh/gltf_library.h"
