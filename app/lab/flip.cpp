#include "app/lab/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "engine/srgb.h"

namespace seascape {

namespace {

struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;
  Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
  double at(int x, int y) const {
    return values[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) +
                  std::size_t(std::clamp(x, 0, width - 1))];
  }
};
using Planes = std::array<Plane, 3>;

// Of linear light, Rec. 709's primaries; against the white of its light.
glm::dvec3 xyz_of(const glm::dvec3& rgb) {
  const glm::dvec3 xyz{0.4124564 * rgb.x + 0.3575761 * rgb.y + 0.1804375 * rgb.z,
                       0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z,
                       0.0193339 * rgb.x + 0.1191920 * rgb.y + 0.9503041 * rgb.z};
  return xyz / glm::dvec3(0.9504700, 1.0000001, 1.0888300);
}
glm::dvec3 rgb_of(const glm::dvec3& relative) {
  const glm::dvec3 v = relative * glm::dvec3(0.9504700, 1.0000001, 1.0888300);
  return {3.2404542 * v.x - 1.5371385 * v.y - 0.4985314 * v.z, -0.9692660 * v.x + 1.8760108 * v.y + 0.0415560 * v.z,
          0.0556434 * v.x - 0.2040259 * v.y + 1.0572252 * v.z};
}

// The opponent colours that contrast is seen in, linear in light (their eq. 1).
glm::dvec3 opponent(const glm::dvec3& relative) {
  return {116.0 * relative.y - 16.0, 500.0 * (relative.x - relative.y), 200.0 * (relative.y - relative.z)};
}
glm::dvec3 from_opponent(const glm::dvec3& c) {
  const double y = (c.x + 16.0) / 116.0;
  return {y + c.y / 500.0, y, y - c.z / 200.0};
}

// CIE L*a*b*, colours weaker where it is darker (Hunt 1952; their eq. 6).
glm::dvec3 hunt_lab(const glm::dvec3& relative) {
  const auto f = [](double t) {
    constexpr double d = 6.0 / 29.0;
    return t > d * d * d ? std::cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
  };
  const double l = 116.0 * f(relative.y) - 16.0;
  return {l, 0.01 * l * 500.0 * (f(relative.x) - f(relative.y)), 0.01 * l * 200.0 * (f(relative.y) - f(relative.z))};
}

// Abasi, Tehran and Fairchild 2020.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 off = a - b;
  return std::abs(off.x) + std::hypot(off.y, off.z);
}

using Kernel = std::vector<double>;  // of odd length, its middle at 0

Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  const auto pass = [](const Plane& from, const Kernel& kernel, int dx, int dy) {
    Plane to(from.width, from.height);
    const int reach = int(kernel.size() / 2);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        double sum = 0.0;
        for (int i = -reach; i <= reach; ++i) sum += kernel[std::size_t(i + reach)] * from.at(x + i * dx, y + i * dy);
        to.values[std::size_t(y) * std::size_t(from.width) + std::size_t(x)] = sum;
      }
    return to;
  };
  return pass(pass(plane, along_x, 1, 0), along_y, 0, 1);
}

// What the eye's contrast sensitivity leaves of a channel: two Gaussians of weights a and widths b (their table 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> sensitivities{
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

Plane seen(const Plane& plane, const Sensitivity& s, double pixels_a_degree) {
  constexpr double pi = std::numbers::pi;
  const int reach = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * pixels_a_degree));
  Plane sum(plane.width, plane.height);
  double weight = 0.0;
  for (const auto& [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
    if (a == 0.0) continue;
    Kernel kernel;
    double total = 0.0;
    for (int i = -reach; i <= reach; ++i) {
      const double degrees = i / pixels_a_degree;
      kernel.push_back(std::exp(-pi * pi * degrees * degrees / b));
      total += kernel.back();
    }
    for (double& k : kernel) k /= total;
    const double share = a * std::sqrt(pi / b) * total * total;
    const Plane part = filtered(plane, kernel, kernel);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += share * part.values[i];
    weight += share;
  }
  for (double& v : sum.values) v /= weight;
  return sum;
}

// How strong edges and points of the lightness are (their section 4.2): the length of the first and of the second
// derivative of a Gaussian as wide as what the eye tells apart best.
struct Features {
  Plane edges, points;
};

Features features_of(const Plane& lightness, double pixels_a_degree) {
  constexpr double width_deg = 0.082;
  const double sigma = 0.5 * width_deg * pixels_a_degree;
  const int reach = int(std::ceil(3.0 * sigma));
  Kernel across, first, second;
  for (int i = -reach; i <= reach; ++i) {
    const double g = std::exp(-0.5 * i * i / (sigma * sigma));
    across.push_back(g), first.push_back(-i * g), second.push_back((i * i / (sigma * sigma) - 1.0) * g);
  }
  const auto normalise = [](Kernel& kernel) {  // what is above 0 to 1, what is below to -1
    double above = 0.0, below = 0.0;
    for (const double k : kernel) (k > 0.0 ? above : below) += std::abs(k);
    for (double& k : kernel) k /= k > 0.0 ? above : std::max(below, 1e-300);
  };
  for (Kernel* kernel : {&across, &first, &second}) normalise(*kernel);
  const auto length = [&](const Kernel& derivative) {
    Plane x = filtered(lightness, derivative, across);
    const Plane y = filtered(lightness, across, derivative);
    for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
  };
  return {length(first), length(second)};
}

Planes opponents_of(const Image8& image) {
  Planes planes{Plane(image.width, image.height), Plane(image.width, image.height), Plane(image.width, image.height)};
  const std::size_t step = std::size_t(image.channels);
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    const auto light = [&](std::size_t c) { return srgb_to_light(image.pixels[i * step + c] / 255.0); };
    const glm::dvec3 c = opponent(xyz_of({light(0), light(1), light(2)}));
    planes[0].values[i] = c.x, planes[1].values[i] = c.y, planes[2].values[i] = c.z;
  }
  return planes;
}

}  // namespace

FlipError flip_error(const Image8& picture, const Image8& reference, double pixels_a_degree) {
  if (picture.width != reference.width || picture.height != reference.height || picture.width < 1 ||
      picture.height < 1 || picture.channels < 3 || reference.channels < 3 || !(pixels_a_degree > 0.0))
    throw std::invalid_argument("flip_error: pictures of one size, three channels or more");
  const auto colours_of = [&](const Planes& planes) {
    const Planes eye{seen(planes[0], sensitivities[0], pixels_a_degree),
                     seen(planes[1], sensitivities[1], pixels_a_degree),
                     seen(planes[2], sensitivities[2], pixels_a_degree)};
    std::vector<glm::dvec3> colours;
    for (std::size_t i = 0; i < eye[0].values.size(); ++i) {
      const glm::dvec3 relative = from_opponent({eye[0].values[i], eye[1].values[i], eye[2].values[i]});
      colours.push_back(hunt_lab(xyz_of(glm::clamp(rgb_of(relative), 0.0, 1.0))));
    }
    return colours;
  };
  const auto lightness_of = [](Plane plane) {
    for (double& v : plane.values) v = (v + 16.0) / 116.0;
    return plane;
  };
  const Planes a = opponents_of(picture), b = opponents_of(reference);
  const std::vector<glm::dvec3> colours_a = colours_of(a), colours_b = colours_of(b);
  const Features f = features_of(lightness_of(a[0]), pixels_a_degree),
                 g = features_of(lightness_of(b[0]), pixels_a_degree);
  constexpr double colour_power = 0.7, feature_power = 0.5, knee = 0.4, knee_to = 0.95;
  const double most =
      std::pow(hyab(hunt_lab(xyz_of({0.0, 1.0, 0.0})), hunt_lab(xyz_of({0.0, 0.0, 1.0}))), colour_power);
  FlipError error;
  const double pixels = double(colours_a.size());
  for (std::size_t i = 0; i < colours_a.size(); ++i) {
    const double far = std::pow(hyab(colours_a[i], colours_b[i]), colour_power);
    const double colour = far < knee * most ? far * knee_to / (knee * most)
                                            : knee_to + (far - knee * most) / (most - knee * most) * (1.0 - knee_to);
    const double feature = std::pow(
        std::max(std::abs(f.edges.values[i] - g.edges.values[i]), std::abs(f.points.values[i] - g.points.values[i])) /
            std::numbers::sqrt2,
        feature_power);
    const double flip = std::pow(std::clamp(colour, 0.0, 1.0), 1.0 - std::clamp(feature, 0.0, 1.0));
    error.mean += flip / pixels;
    error.worst = std::max(error.worst, flip);
  }
  return error;
}

Image8 stretched(const Image8& picture, int width, int height) {
  Image8 result{width, height, picture.channels, {}};
  const int channels = picture.channels;
  result.pixels.resize(std::size_t(width) * std::size_t(height) * std::size_t(channels));
  std::array<double, 256> light;
  for (std::size_t v = 0; v < light.size(); ++v) light[v] = srgb_to_light(double(v) / 255.0);
  const auto at = [&](int x, int y, int c) {
    const std::size_t texel = std::size_t(std::clamp(y, 0, picture.height - 1)) * std::size_t(picture.width) +
                              std::size_t(std::clamp(x, 0, picture.width - 1));
    return light[picture.pixels[texel * std::size_t(channels) + std::size_t(c)]];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) * picture.width / width - 0.5, v = (y + 0.5) * picture.height / height - 0.5;
      const int left = int(std::floor(u)), top = int(std::floor(v));
      const double right = u - left, down = v - top;
      for (int c = 0; c < channels; ++c) {
        const double value = glm::mix(glm::mix(at(left, top, c), at(left + 1, top, c), right),
                                      glm::mix(at(left, top + 1, c), at(left + 1, top + 1, c), right), down);
        result.pixels[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels) + std::size_t(c)] =
            std::uint8_t(std::lround(255.0 * std::clamp(light_to_srgb(value), 0.0, 1.0)));
      }
    }
  return result;
}

}  // namespace seascape
