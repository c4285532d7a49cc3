// Pictures laid on the sea.
#include <algorithm>
#include <cmath>

#include "engine/image_file.h"
#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

// Values are cut to this, which no kind of data reaches, so that differences and means of texels are finite: rasters of
// heights mark holes by -3.4e38.
constexpr double most_value = 1e6;

// Bilinear between texels' middles, level beyond the outer ones, and of the mean over 2^n texels a side where the
// footprint is as wide (Williams 1983).
class Texture final : public InputSource {
 public:
  Texture(const InputSpec& spec, const TextureInput& texture)
      : frame_(texture.at_m, texture.turn_deg),
        half_(0.5 * texture.size_m),
        feather_m_(spec.feather_m),
        turns_(spec.to == InputTarget::flow && spec.blend != InputBlend::scale) {
    const ImageF& image = *texture.image;
    const int channels = spec.blend == InputBlend::scale ? 1 : traits(spec.to).channels;
    const std::string letters =
        texture.channels.empty() ? std::string("rgba").substr(0, std::size_t(channels)) : texture.channels;
    Level first{image.width, image.height, {}};
    first.texels.resize(std::size_t(image.width) * std::size_t(image.height));
    for (std::size_t i = 0; i < first.texels.size(); ++i) {
      glm::vec4 value{0.0f};
      for (int c = 0; c < channels; ++c)
        value[c] = float(std::clamp(
            texture.offset +
                texture.scale * double(image.pixels[4 * i + std::string_view("rgba").find(letters[std::size_t(c)])]),
            -most_value, most_value));
      first.texels[i] = plain_value(spec, value);
    }
    texel_m_ = std::max(texture.size_m.x / image.width, texture.size_m.y / image.height);
    levels_.push_back(std::move(first));
    while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
  }

  InputSample sample(glm::dvec2 place_m, double footprint_m, double) const override {
    const glm::dvec2 p = frame_.local(place_m);
    double share = 1.0;
    for (int axis = 0; axis < 2; ++axis)
      share *= soft_share(half_[axis] - std::abs(p[axis]), feather_m_, footprint_m) *
               band_factor(half_[axis], feather_m_, footprint_m);
    if (!(share > 0.0)) return {};
    const glm::dvec2 at = 0.5 + 0.5 * p / half_;  // 0 to 1 over the picture
    const double level = std::clamp(std::log2(std::max(footprint_m / texel_m_, 1.0)), 0.0, double(levels_.size() - 1));
    const std::size_t fine = std::size_t(level);
    glm::vec4 value = bilinear(fine, at);
    if (const float rest = float(level - double(fine)); rest > 0.0f) value += (bilinear(fine + 1, at) - value) * rest;
    if (turns_) {
      const glm::dvec2 v = frame_.turned({value.x, value.y});
      value = {float(v.x), float(v.y), 0.0f, 0.0f};
    }
    return {value, float(share)};
  }
  InputBounds bounds() const override { return frame_.bounds({0.0, 0.0}, half_); }

 private:
  struct Level {
    int width, height;
    std::vector<glm::vec4> texels;
    const glm::vec4& at(int x, int y) const {
      return texels[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) +
                    std::size_t(std::clamp(x, 0, width - 1))];
    }
  };

  // Means of four; of two at the end of an odd side.
  static Level halved(const Level& of) {
    Level result{(of.width + 1) / 2, (of.height + 1) / 2, {}};
    result.texels.reserve(std::size_t(result.width) * std::size_t(result.height));
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x)
        result.texels.push_back(0.25f * (of.at(2 * x, 2 * y) + of.at(2 * x + 1, 2 * y) + of.at(2 * x, 2 * y + 1) +
                                         of.at(2 * x + 1, 2 * y + 1)));
    return result;
  }
  glm::vec4 bilinear(std::size_t number, glm::dvec2 at) const {
    const Level& level = levels_[number];
    // A texel of this level has 2^number of the picture's a side.
    const glm::dvec2 place = at * glm::dvec2(levels_[0].width, levels_[0].height) / double(1u << number) - 0.5;
    const glm::dvec2 low = glm::floor(place);
    const glm::vec2 f(place - low);
    const int x = int(std::clamp(low.x, -2.0, double(level.width))),
              y = int(std::clamp(low.y, -2.0, double(level.height)));
    const glm::vec4 top = level.at(x, y) + (level.at(x + 1, y) - level.at(x, y)) * f.x;
    const glm::vec4 bottom = level.at(x, y + 1) + (level.at(x + 1, y + 1) - level.at(x, y + 1)) * f.x;
    return top + (bottom - top) * f.y;
  }

  TurnedFrame frame_;
  glm::dvec2 half_;
  double feather_m_, texel_m_ = 1.0;
  bool turns_;
  std::vector<Level> levels_;
};

}  // namespace

std::unique_ptr<const InputSource> make_texture(const InputSpec& spec) {
  return std::make_unique<Texture>(spec, std::get<TextureInput>(spec.shape));
}

}  // namespace seascape
