// The one place where tinygltf's own code is compiled.
#define TINYGLTF_IMPLEMENTATION
#include "engine/tinygltf_library.h"
