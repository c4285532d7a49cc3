#include "app/solids/picture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "engine/srgb.h"

namespace seascape {

namespace {

// A power for each texel took most of a scene's loading, so both ways are tables.
struct SrgbTables {
  static constexpr int cells = 4096;
  std::array<float, 256> light{}, data{};   // of a byte
  std::array<float, 257> least{};           // light from which on a byte is the nearest; no byte follows the last
  std::array<std::uint8_t, cells> first{};  // the byte of a cell's least light; a cell holds two bytes at most
  SrgbTables() {
    for (int i = 0; i < 256; ++i) {
      light[std::size_t(i)] = float(srgb_to_light(i / 255.0));
      data[std::size_t(i)] = float(i) / 255.0f;
      least[std::size_t(i)] = i == 0 ? 0.0f : float(srgb_to_light((i - 0.5) / 255.0));
    }
    least[256] = 2.0f;
    int byte = 0;
    for (int i = 0; i < cells; ++i) {
      while (least[std::size_t(byte) + 1] <= float(i) / float(cells)) ++byte;
      first[std::size_t(i)] = std::uint8_t(byte);
    }
  }
};

const SrgbTables& tables() {
  static const SrgbTables made;
  return made;
}

std::uint8_t byte_of(float x) { return std::uint8_t(255.0f * std::clamp(x, 0.0f, 1.0f) + 0.5f); }

std::uint8_t srgb_of(const SrgbTables& table, float light) {
  const float x = std::clamp(light, 0.0f, 1.0f);
  std::size_t byte = table.first[std::size_t(std::min(int(x * float(SrgbTables::cells)), SrgbTables::cells - 1))];
  while (table.least[byte + 1] <= x) ++byte;
  return std::uint8_t(byte);
}

Image8 halved(const Image8& from, TexelKind kind) {
  Image8 made{std::max(1, from.width / 2), std::max(1, from.height / 2), 4, {}};
  made.pixels.resize(std::size_t(made.width) * std::size_t(made.height) * 4);
  const SrgbTables& table = tables();
  const float* const value = (kind == TexelKind::colour ? table.light : table.data).data();
  const std::size_t row = 4 * std::size_t(from.width);
  std::uint8_t* to = made.pixels.data();
  for (int y = 0; y < made.height; ++y) {
    // A side that is odd gives its last texel to the one before.
    const int rows = y + 1 == made.height ? from.height - 2 * y : 2;
    for (int x = 0; x < made.width; ++x, to += 4) {
      const int columns = x + 1 == made.width ? from.width - 2 * x : 2;
      glm::vec4 sum(0.0f);
      const std::uint8_t* line = &from.pixels[2 * std::size_t(y) * row + 8 * std::size_t(x)];
      for (int v = 0; v < rows; ++v, line += row)
        for (int u = 0; u < columns; ++u) {
          const std::uint8_t* at = line + 4 * u;
          sum += glm::vec4(value[at[0]], value[at[1]], value[at[2]], table.data[at[3]]);
        }
      sum *= 1.0f / float(rows * columns);
      if (kind == TexelKind::normal) {
        const glm::vec3 n = 2.0f * glm::vec3(sum) - 1.0f;
        const float length = glm::length(n);
        sum = glm::vec4(length > 1e-3f ? 0.5f + 0.5f / length * n : glm::vec3(0.5f, 0.5f, 1.0f), sum.w);
      }
      for (int c = 0; c < 3; ++c) to[c] = kind == TexelKind::colour ? srgb_of(table, sum[c]) : byte_of(sum[c]);
      to[3] = byte_of(sum[3]);
    }
  }
  return made;
}

}  // namespace

float light_of_srgb(std::uint8_t value) { return tables().light[value]; }

std::uint8_t srgb_of_light(float light) { return srgb_of(tables(), light); }

std::vector<Image8> picture_levels(const Image8& picture, TexelKind kind) {
  std::vector<Image8> levels{picture};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back(), kind));
  return levels;
}

}  // namespace seascape
