// Debian hands out these two compiled; here they are compiled again, so that fuzzer and sanitizers see into them. (tinygltf and
// nlohmann-json come as headers.)

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
