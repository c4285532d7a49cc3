#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/gltf_document.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and read as they are");

constexpr std::size_t most_sparse_elements = std::size_t{1} << 20;

template <class T>
T load(const std::uint8_t* at) {  // buffers promise no alignment that we rely on
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

// glTF 2.0, section 3.11 (animations) and 3.6.2.2: signed c/127 and c/32767 held at -1, unsigned c/255 and c/65535.
float component(const std::uint8_t* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const float value = static_cast<float>(load<std::int8_t>(at));
      return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const float value = static_cast<float>(load<std::uint8_t>(at));
      return normalized ? value / 255.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const float value = static_cast<float>(load<std::int16_t>(at));
      return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const float value = static_cast<float>(load<std::uint16_t>(at));
      return normalized ? value / 65535.0f : value;
    }
    default:
      return load<float>(at);
  }
}

std::size_t index_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return 4;
    default:
      return 0;
  }
}

std::uint32_t index_at(const std::uint8_t* at, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

std::size_t float_component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

void GltfAccessors::fail(const std::string& what) const { throw Error(where_, what, "export the model again"); }

const tinygltf::Accessor& GltfAccessors::checked(int accessor) const {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= document_.accessors.size())
    fail(fmt::format("accessor {} does not exist", accessor));
  const tinygltf::Accessor& found = document_.accessors[static_cast<std::size_t>(accessor)];
  // A triangle soup has three indices a vertex, and strips fewer.
  if (found.count < 1 || found.count > 3 * most_model_vertices)
    fail(fmt::format("accessor {} has {} elements; 1 to {} are allowed", accessor, found.count,
                     3 * most_model_vertices));
  return found;
}

std::size_t GltfAccessors::count(int accessor) const { return checked(accessor).count; }

int GltfAccessors::components(int accessor) const {
  return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(checked(accessor).type));
}

std::span<const std::uint8_t> GltfAccessors::bytes(int view) const {
  const Block start = block(view, 0, 1, 1, fmt::format("buffer view {}", view));
  return {start.data, document_.bufferViews[static_cast<std::size_t>(view)].byteLength};
}

GltfAccessors::Block GltfAccessors::block(int view, std::size_t offset, std::size_t count, std::size_t element_bytes,
                                          const std::string& what) const {
  if (view < 0 || static_cast<std::size_t>(view) >= document_.bufferViews.size())
    fail(fmt::format("{} names buffer view {}, which does not exist", what, view));
  const tinygltf::BufferView& found = document_.bufferViews[static_cast<std::size_t>(view)];
  if (found.buffer < 0 || static_cast<std::size_t>(found.buffer) >= document_.buffers.size())
    fail(fmt::format("buffer view {} names buffer {}, which does not exist", view, found.buffer));
  const std::vector<unsigned char>& data = document_.buffers[static_cast<std::size_t>(found.buffer)].data;
  if (found.byteOffset > data.size() || found.byteLength > data.size() - found.byteOffset)
    fail(fmt::format("buffer view {} reaches past the end of its buffer", view));
  const std::size_t stride = found.byteStride == 0 ? element_bytes : found.byteStride;
  if (stride < element_bytes || stride > 252)
    fail(fmt::format("buffer view {} has a stride of {} bytes for elements of {}", view, stride, element_bytes));
  // count is at most 3 * 2^24 and stride 252, so the product cannot overflow.
  if (offset > found.byteLength || (count - 1) * stride + element_bytes > found.byteLength - offset)
    fail(fmt::format("{} reaches past the end of its buffer view", what));
  return {data.data() + found.byteOffset + offset, stride};
}

template <class Read>
void GltfAccessors::each_sparse(const tinygltf::Accessor& accessor, std::size_t element_bytes, const std::string& what,
                                Read&& read) const {
  const auto& sparse = accessor.sparse;
  const std::size_t number_bytes = index_bytes(sparse.indices.componentType);
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count || number_bytes == 0 ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    fail(what + " has broken sparse values");
  const std::size_t number = static_cast<std::size_t>(sparse.count);
  const Block places = block(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), number,
                             number_bytes, "the sparse indices of " + what);
  const Block values = block(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), number,
                             element_bytes, "the sparse values of " + what);
  for (std::size_t i = 0; i < number; ++i) {
    const std::size_t place = index_at(places.data + i * places.stride, sparse.indices.componentType);
    if (place >= accessor.count) fail(what + " has a sparse index past its end");
    read(place, values.data + i * values.stride);
  }
}

std::vector<float> GltfAccessors::floats(int accessor, int components) const {
  const tinygltf::Accessor& found = checked(accessor);
  const std::string what = fmt::format("accessor {}", accessor);
  const std::size_t part_bytes = float_component_bytes(found.componentType);
  const int wanted = components == 1 ? TINYGLTF_TYPE_SCALAR : components;  // TINYGLTF_TYPE_VEC2 is 2, VEC3 3
  if (found.type != wanted || part_bytes == 0)
    fail(fmt::format("{} is not of {} numbers of a kind that vertices may have", what, components));
  const std::size_t parts = static_cast<std::size_t>(components), element_bytes = parts * part_bytes;
  if (found.bufferView < 0 && !found.sparse.isSparse) fail(what + " has no data");
  // Zeros with a few values put in cost the file nothing, so they get a limit of their own.
  if (found.count > (found.bufferView < 0 ? most_sparse_elements : most_model_vertices))
    fail(fmt::format("{} has {} elements, too many for vertices", what, found.count));
  const Block source =
      found.bufferView < 0 ? Block{} : block(found.bufferView, found.byteOffset, found.count, element_bytes, what);
  std::vector<float> values(found.count * parts, 0.0f);
  const auto take = [&](std::size_t place, const std::uint8_t* at) {
    for (std::size_t c = 0; c < parts; ++c)
      values[place * parts + c] = component(at + c * part_bytes, found.componentType, found.normalized);
  };
  if (source.data)
    for (std::size_t i = 0; i < found.count; ++i) take(i, source.data + i * source.stride);
  if (found.sparse.isSparse) each_sparse(found, element_bytes, what, take);
  return values;
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor) const {
  const tinygltf::Accessor& found = checked(accessor);
  const std::string what = fmt::format("accessor {}", accessor);
  const std::size_t bytes = index_bytes(found.componentType);
  if (found.type != TINYGLTF_TYPE_SCALAR || bytes == 0) fail(what + " is not of whole numbers, as indices must be");
  const Block source = block(found.bufferView, found.byteOffset, found.count, bytes, what);
  std::vector<std::uint32_t> values(found.count);
  const auto take = [&](std::size_t place, const std::uint8_t* at) {
    values[place] = index_at(at, found.componentType);
  };
  for (std::size_t i = 0; i < found.count; ++i) take(i, source.data + i * source.stride);
  if (found.sparse.isSparse) each_sparse(found, bytes, what, take);
  return values;
}

}  // namespace seascape
