// Which part of a picture the mirror shows. Controls are named beside each test; each was seen to fail.
#include "app/mirror_layout.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

// A circle stays round: both directions are scaled alike, but for the rounding to a pixel of either. Nothing beyond the
// picture is shown, and as much of it as fits. Control: a part that is the whole picture.
TEST(MirrorLayout, FillsUndistortedFromTheMiddle) {
  for (const glm::ivec2 picture : {glm::ivec2(1440, 1584), glm::ivec2(1832, 1920), glm::ivec2(320, 320)})
    for (const glm::ivec2 window : {glm::ivec2(1280, 720), glm::ivec2(640, 720), glm::ivec2(300, 900)}) {
      const PixelBox part = middle_part(picture, window);
      const glm::ivec2 size = part.most - part.least;
      EXPECT_NEAR(double(size.x) / window.x, double(size.y) / window.y, 1.0 / std::min(window.x, window.y));
      EXPECT_GE(part.least.x, 0);
      EXPECT_GE(part.least.y, 0);
      EXPECT_LE(part.most.x, picture.x);
      EXPECT_LE(part.most.y, picture.y);
      EXPECT_TRUE(size.x == picture.x || size.y == picture.y);
      EXPECT_LE(std::abs(part.least.x - (picture.x - part.most.x)), 1);
      EXPECT_LE(std::abs(part.least.y - (picture.y - part.most.y)), 1);
    }
}

// Control: a part that may come to nothing.
TEST(MirrorLayout, LeavesAPixelOfTheThinnest) {
  for (const glm::ivec2 window : {glm::ivec2(1, 4000), glm::ivec2(4000, 1), glm::ivec2(1, 1)}) {
    const PixelBox part = middle_part({100, 100}, window);
    EXPECT_GE(part.most.x - part.least.x, 1);
    EXPECT_GE(part.most.y - part.least.y, 1);
  }
}

// Control: halves that leave the middle column of an odd width out.
TEST(MirrorLayout, BothEyesFillTheWindow) {
  const PixelBox left = place_of_eye(MirrorView::both, 0, {641, 300}),
                 right = place_of_eye(MirrorView::both, 1, {641, 300});
  EXPECT_EQ(left.least, glm::ivec2(0, 0));
  EXPECT_EQ(left.most.x, right.least.x);
  EXPECT_EQ(right.most, glm::ivec2(641, 300));
  EXPECT_EQ(place_of_eye(MirrorView::right, 1, {641, 300}).most, glm::ivec2(641, 300));
}

// Control: a view left out.
TEST(MirrorLayout, TheNextViewComesRoundToTheFirst) {
  MirrorView view = MirrorView::off;
  for (const MirrorView next :
       {MirrorView::left, MirrorView::right, MirrorView::both, MirrorView::third, MirrorView::left}) {
    view = next_view(view);
    EXPECT_EQ(view, next);
  }
}

}  // namespace
}  // namespace seascape
