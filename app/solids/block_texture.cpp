#include "app/solids/block_texture.h"

#include <squish.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace seascape {

namespace {

constexpr int least_texels = 32 * 32;
// Root mean square of what blocks change, of 255: pictures of paint, wood and stone lose 1 to 5.
constexpr double most_lost = 8.0;
// A block that is off by more shows other colours than the picture has: two channels that have nothing to do with each
// other. Pictures of things have none or, one in ten thousand, a few; more of them are seen.
constexpr double spoilt = 32.0, most_spoilt = 0.001;

bool of_colour(BlockKind kind) { return kind == BlockKind::bc1 || kind == BlockKind::bc3; }

int flags_of(BlockKind kind) {
  return (kind == BlockKind::bc1 ? squish::kDxt1 : squish::kDxt5) | squish::kColourRangeFit;
}

std::size_t block_bytes(BlockKind kind) { return kind == BlockKind::bc1 || kind == BlockKind::bc4 ? 8 : 16; }

// The channels of the picture that blocks of two or one keep.
std::array<int, 2> kept_channels(TexelKind kind) {
  return kind == TexelKind::linear ? std::array{1, 2} : std::array{0, 1};
}

// The texels of a block as its encoder takes them; beyond the picture's edge its last ones.
std::array<std::uint8_t, 64> texels_of(const Image8& level, int column, int row, BlockKind block, TexelKind kind) {
  std::array<std::uint8_t, 64> texels{};
  const auto [first, second] = kept_channels(kind);
  for (int i = 0; i < 16; ++i) {
    const int x = std::min(4 * column + i % 4, level.width - 1), y = std::min(4 * row + i / 4, level.height - 1);
    const std::uint8_t* from = &level.pixels[4 * (std::size_t(y) * std::size_t(level.width) + std::size_t(x))];
    std::uint8_t* to = &texels[4 * std::size_t(i)];
    if (of_colour(block)) {
      std::copy_n(from, 4, to);
      if (block == BlockKind::bc1) to[3] = 255;  // below the half its encoder would leave holes
    } else {
      to[0] = from[first];
      to[1] = from[second];
      to[3] = 255;
    }
  }
  return texels;
}

// A channel's values between its most and its least in eight steps (BC4's first mode: Microsoft, "Texture block
// compression in Direct3D 11"). libsquish 1.15 has that too, but what it shows of it is another picture.
void encode_channel(const std::array<std::uint8_t, 64>& texels, int channel, std::uint8_t* to) {
  int most = 0, least = 255;
  for (std::size_t i = std::size_t(channel); i < 64; i += 4) {
    most = std::max(most, int(texels[i]));
    least = std::min(least, int(texels[i]));
  }
  to[0] = std::uint8_t(most);
  to[1] = std::uint8_t(least);
  std::uint64_t codes = 0;
  const int range = std::max(most - least, 1);
  for (std::size_t i = 0; i < 16; ++i) {
    const int step =
        (14 * (most - int(texels[4 * i + std::size_t(channel)])) + range) / (2 * range);  // 0: most; 7: least
    const std::uint64_t code = step == 0 ? 0u : step == 7 ? 1u : std::uint64_t(step) + 1u;
    codes |= code << (3 * i);
  }
  for (int i = 0; i < 6; ++i) to[2 + i] = std::uint8_t(codes >> (8 * i));
}

void decode_channel(const std::uint8_t* from, std::array<std::uint8_t, 64>& texels, int channel) {
  std::uint64_t codes = 0;
  for (int i = 0; i < 6; ++i) codes |= std::uint64_t(from[2 + i]) << (8 * i);
  for (std::size_t i = 0; i < 16; ++i) {
    const int code = int(codes >> (3 * i) & 7u), step = code == 0 ? 0 : code == 1 ? 7 : code - 1;
    texels[4 * i + std::size_t(channel)] = std::uint8_t(((7 - step) * from[0] + step * from[1] + 3) / 7);
  }
}

void encode(const std::array<std::uint8_t, 64>& texels, BlockKind kind, std::uint8_t* to) {
  if (of_colour(kind)) {
    squish::Compress(texels.data(), to, flags_of(kind));
    return;
  }
  encode_channel(texels, 0, to);
  if (kind == BlockKind::bc5) encode_channel(texels, 1, to + 8);
}

std::array<std::uint8_t, 64> decoded(const std::uint8_t* block, BlockKind kind) {
  std::array<std::uint8_t, 64> shown{};
  if (of_colour(kind)) {
    squish::Decompress(shown.data(), block, flags_of(kind));
    return shown;
  }
  decode_channel(block, shown, 0);
  if (kind == BlockKind::bc5) decode_channel(block + 8, shown, 1);
  return shown;
}

// Sum of squares of what a block changes, mean of its channels.
double lost(const std::array<std::uint8_t, 64>& texels, const std::uint8_t* block, BlockKind kind) {
  const std::array<std::uint8_t, 64> shown = decoded(block, kind);
  const std::size_t channels = kind == BlockKind::bc1 ? 3 : kind == BlockKind::bc3 ? 4 : kind == BlockKind::bc4 ? 1 : 2;
  double sum = 0.0;
  for (std::size_t i = 0; i < 64; i += 4)
    for (std::size_t c = 0; c < channels; ++c) {
      const double off = double(shown[i + c]) - double(texels[i + c]);
      sum += off * off / double(channels);
    }
  return sum;
}

}  // namespace

BlockKind block_kind(const Image8& picture, TexelKind kind) {
  switch (kind) {
    case TexelKind::normal:
    case TexelKind::linear:
      return BlockKind::bc5;
    case TexelKind::occlusion:
      return BlockKind::bc4;
    default:
      break;
  }
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
    if (picture.pixels[i] != 255) return BlockKind::bc3;
  return BlockKind::bc1;
}

std::vector<BlockLevel> block_levels(std::span<const Image8> levels, TexelKind kind) {
  if (levels.front().width * levels.front().height < least_texels) return {};
  const BlockKind block = block_kind(levels.front(), kind);
  std::vector<BlockLevel> made(levels.size());
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Image8& level = levels[l];
    const int columns = (level.width + 3) / 4, rows = (level.height + 3) / 4;
    const std::size_t row_bytes = block_bytes(block) * std::size_t(columns);
    made[l] = {level.width, level.height, std::vector<std::uint8_t>(row_bytes * std::size_t(rows))};
    std::vector<double> lost_of(std::size_t(rows), 0.0);
    std::vector<int> spoilt_of(std::size_t(rows), 0);
    tbb::parallel_for(0, rows, [&](int row) {
      std::uint8_t* to = &made[l].blocks[std::size_t(row) * row_bytes];
      for (int column = 0; column < columns; ++column, to += block_bytes(block)) {
        const std::array<std::uint8_t, 64> texels = texels_of(level, column, row, block, kind);
        encode(texels, block, to);
        if (l > 0) continue;
        const double off = lost(texels, to, block);
        lost_of[std::size_t(row)] += off;
        spoilt_of[std::size_t(row)] += off > 16.0 * spoilt * spoilt;
      }
    });
    if (l > 0) continue;
    const double off = std::accumulate(lost_of.begin(), lost_of.end(), 0.0);
    const int blocks = std::accumulate(spoilt_of.begin(), spoilt_of.end(), 0);
    if (std::sqrt(off / (16.0 * columns * rows)) > most_lost || blocks > most_spoilt * columns * rows) return {};
  }
  return made;
}

}  // namespace seascape
