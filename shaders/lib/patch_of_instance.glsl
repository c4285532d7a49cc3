// Several patches are one instance: which of them a vertex belongs to.
#include "shared/patch_vertex.h"

layout(location = 0) in ivec4 patch_data[patches_an_instance];  // PatchInstance: corner, stride, flags

// The patch, its number in the instance, and the vertex's place in it.
PatchInstance patch_of_vertex(out int number, out int i, out int j) {
  const int side = patch_quads + 1, vertex = gl_VertexIndex % (side * side);
  number = gl_VertexIndex / (side * side);
  i = vertex % side;
  j = vertex / side;
  ivec4 data = patch_data[0];  // written out: an input that each lane indexes by itself is slow
  for (int n = 1; n < patches_an_instance; ++n)
    if (n == number) data = patch_data[n];
  return PatchInstance(data.xy, data.z, uint(data.w));
}
