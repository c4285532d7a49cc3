#include "tests/support/gpu/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace seascape::test {

namespace {

double linear(std::uint8_t value) {
  const double c = value / 255.0;  // IEC 61966-2-1
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

void expect_same_size(const Image8& a, const Image8& b) {
  if (a.width != b.width || a.height != b.height) throw std::runtime_error("pictures of different sizes");
}

std::size_t pixels(const Image8& p) { return std::size_t(p.width) * std::size_t(p.height); }

double pixel_difference(const Image8& a, const Image8& b, std::size_t i) {
  double most = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    most = std::max(most, std::abs(linear(a.pixels[i * std::size_t(a.channels) + c]) -
                                   linear(b.pixels[i * std::size_t(b.channels) + c])));
  return most;
}

}  // namespace

PictureStatistics statistics(const Image8& picture) {
  PictureStatistics s;
  double squares = 0.0;
  for (std::size_t i = 0; i < pixels(picture); ++i) {
    const std::uint8_t* p = &picture.pixels[i * std::size_t(picture.channels)];
    const double grey = (p[0] + p[1] + p[2]) / 3.0;
    s.mean += grey;
    squares += grey * grey;
    s.most = std::max({s.most, int(p[0]), int(p[1]), int(p[2])});
  }
  s.mean /= double(pixels(picture));
  s.deviation = std::sqrt(std::max(squares / double(pixels(picture)) - s.mean * s.mean, 0.0));
  return s;
}

int count_colour(const Image8& picture, int red, int green, int blue, int within) {
  int count = 0;
  for (std::size_t i = 0; i < pixels(picture); ++i) {
    const std::uint8_t* p = &picture.pixels[i * std::size_t(picture.channels)];
    count += std::abs(p[0] - red) <= within && std::abs(p[1] - green) <= within && std::abs(p[2] - blue) <= within;
  }
  return count;
}

int differing_pixels(const Image8& a, const Image8& b) {
  expect_same_size(a, b);
  int count = 0;
  for (std::size_t i = 0; i < pixels(a); ++i)
    count += !std::equal(&a.pixels[i * std::size_t(a.channels)], &a.pixels[i * std::size_t(a.channels)] + 3,
                         &b.pixels[i * std::size_t(b.channels)]);
  return count;
}

PictureDifference difference(const Image8& a, const Image8& b) {
  expect_same_size(a, b);
  std::vector<double> all(pixels(a));
  double sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) sum += all[i] = pixel_difference(a, b, i);
  const auto p99 = all.begin() + std::ptrdiff_t(0.99 * double(all.size() - 1));
  std::nth_element(all.begin(), p99, all.end());
  return {sum / double(all.size()), *p99};
}

Image8 difference_picture(const Image8& a, const Image8& b) {
  expect_same_size(a, b);
  Image8 picture{a.width, a.height, 3, {}};
  for (std::size_t i = 0; i < pixels(a); ++i) {
    const auto value = std::uint8_t(std::min(255.0, 2550.0 * pixel_difference(a, b, i)));
    picture.pixels.insert(picture.pixels.end(), 3, value);
  }
  return picture;
}

glm::dvec3 light_at(const Image8& picture, std::size_t i) {
  glm::dvec3 light;
  for (int c = 0; c < 3; ++c) {
    const double v = picture.pixels[4 * i + std::size_t(c)] / 255.0;
    light[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return light;
}

std::string leave(const Image8& picture, const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(SEASCAPE_BUILD_DIR) / "test_pictures";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / (name + ".png");
  write_png(file, picture);
  return file.string();
}

}  // namespace seascape::test
