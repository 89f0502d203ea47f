// The one file that compiles the body of a header-only library.

#include <fstream>  // tinygltf forgets it where it is told to open no files

#define TINYGLTF_IMPLEMENTATION
#include "io/gltf_library.h"
