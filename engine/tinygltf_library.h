// tinygltf as this program uses it: without pictures and without any file access of its own. Only this header includes
// it, because its class looks different under other macros.
#pragma once
#include <cstdio>
#include <fstream>
#include <sstream>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>
