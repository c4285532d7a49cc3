// What tests ask about pictures.
#pragma once
#include <glm/glm.hpp>
#include <string>

#include "engine/image_file.h"

namespace seascape::test {

struct PictureStatistics {
  double mean = 0.0;       // of the three colours, 0 to 255
  double deviation = 0.0;  // standard deviation of the pixels' mean colour
  int most = 0;            // the brightest value of any colour
};
PictureStatistics statistics(const Image8& picture);

// Pixels of this colour, each value off by at most `within` (of 255): drivers round what lies between two either way.
int count_colour(const Image8& picture, int red, int green, int blue, int within = 0);
// Pixels in which two pictures of one size differ in any bit of colour.
int differing_pixels(const Image8& a, const Image8& b);

struct PictureDifference {
  double mean = 0.0, p99 = 0.0;  // of the largest difference of a pixel's colours, in linear light from 0 to 1
};
PictureDifference difference(const Image8& a, const Image8& b);
// The difference as a picture, ten times as strong.
Image8 difference_picture(const Image8& a, const Image8& b);

// The light of pixel i, row after row, 0 to 1 and linear.
glm::dvec3 light_at(const Image8& picture, std::size_t i);

// Leaves a picture in the build folder, in "test_pictures"; returns its file for a message.
std::string leave(const Image8& picture, const std::string& name);

}  // namespace seascape::test
