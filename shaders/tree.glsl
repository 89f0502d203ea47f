// Reads the tree. TREE_IN_STORAGE selects storage buffers instead of texel buffers. Texel buffers were measured to be faster on
// lavapipe; devices whose texel buffers are too small use storage buffers.
#ifdef TREE_IN_STORAGE
layout(set = 0, binding = 0, scalar) readonly buffer Nodes { uvec4 node_words[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Triangles { uvec4 triangle_words[]; };
#define NODE_WORDS(index) node_words[index]
#define TRIANGLE_WORDS(index) triangle_words[index]
#else
layout(set = 0, binding = 0) uniform usamplerBuffer node_words;
layout(set = 0, binding = 1) uniform usamplerBuffer triangle_words;
#define NODE_WORDS(index) texelFetch(node_words, int(index))
#define TRIANGLE_WORDS(index) texelFetch(triangle_words, int(index))
#endif
