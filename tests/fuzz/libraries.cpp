// Debian ships these two libraries compiled; they are compiled again here, so that the fuzzer and the sanitizers can see into
// them. (tinygltf and nlohmann-json are header-only.)

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
