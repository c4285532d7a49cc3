#include "app/lab/picture_error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "app/statistics.h"
#include "engine/srgb.h"

namespace seascape {

namespace {

// Of Rec. 709's weights, from 0 to 1.
std::vector<double> luma(const Image8& image) {
  std::vector<double> values;
  const std::size_t step = std::size_t(image.channels);
  for (std::size_t at = 0; at + 2 < image.pixels.size(); at += step)
    values.push_back((0.2126 * image.pixels[at] + 0.7152 * image.pixels[at + 1] + 0.0722 * image.pixels[at + 2]) /
                     255.0);
  return values;
}

}  // namespace

PictureError picture_error(const Image8& picture, const Image8& truth) {
  if (picture.width != truth.width || picture.height != truth.height || picture.channels != truth.channels ||
      picture.width < 8 || picture.height < 8)
    throw std::invalid_argument("picture_error: pictures of one size, at least 8 x 8");
  PictureError error;
  std::vector<double> differences;
  const std::size_t step = std::size_t(picture.channels);
  for (std::size_t at = 0; at + 2 < picture.pixels.size(); at += step) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c)
      most = std::max(most, std::abs(int(picture.pixels[at + c]) - int(truth.pixels[at + c])));
    differences.push_back(most / 255.0);
  }
  const Summary all = summarise(differences);
  error.mean = all.mean;
  error.p99 = all.p99;

  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // eq. 11, of values from 0 to 1
  constexpr int side = 8;
  const std::vector<double> a = luma(picture), b = luma(truth);
  double sum = 0.0, windows = 0.0;
  for (int z = 0; z + side <= picture.height; z += side / 2)
    for (int x = 0; x + side <= picture.width; x += side / 2) {
      double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const std::size_t at = std::size_t(z + j) * std::size_t(picture.width) + std::size_t(x + i);
          ma += a[at], mb += b[at], aa += a[at] * a[at], bb += b[at] * b[at], ab += a[at] * b[at];
        }
      constexpr double n = side * side;
      ma /= n, mb /= n;
      const double va = (aa - n * ma * ma) / (n - 1.0), vb = (bb - n * mb * mb) / (n - 1.0),
                   cov = (ab - n * ma * mb) / (n - 1.0);
      sum += (2.0 * ma * mb + c1) * (2.0 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      windows += 1.0;
    }
  error.dissimilarity = std::max(0.0, 1.0 - sum / windows);
  return error;
}

Image8 averaged(const Image8& image, int times) {
  if (times < 1 || image.width % times != 0 || image.height % times != 0)
    throw std::invalid_argument("averaged: sides that are no multiples");
  Image8 small{image.width / times, image.height / times, image.channels, {}};
  double light[256];
  for (int i = 0; i < 256; ++i) light[i] = srgb_to_light(i / 255.0);
  const std::size_t channels = std::size_t(image.channels), row = std::size_t(image.width) * channels;
  for (int z = 0; z < small.height; ++z)
    for (int x = 0; x < small.width; ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        double sum = 0.0;
        for (int j = 0; j < times; ++j)
          for (int i = 0; i < times; ++i) {
            const std::uint8_t value =
                image.pixels[std::size_t(z * times + j) * row + std::size_t(x * times + i) * channels + c];
            sum += c == 3 ? value / 255.0 : light[value];
          }
        const double mean = sum / (times * times);
        small.pixels.push_back(std::uint8_t(std::lround(255.0 * (c == 3 ? mean : light_to_srgb(mean)))));
      }
  return small;
}

}  // namespace seascape
