// The sea drawn in a headset as Explorer draws it, and the same frames drawn again without one, to compare.
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/experience.h"
#include "app/picture_copy.h"
#include "platform/headset.h"

namespace seascape::test {

struct HeadsetLook {
  const char* name;
  std::vector<std::pair<std::string, std::string>> set;
  // Whose depths are the same by another way.
  std::vector<std::pair<std::string, std::string>> depth_of = {};
  const char* preset = "low";
  bool underwater = false;
};
Scene scene_of(const HeadsetLook& look, bool for_depth = false);

struct HeadsetPicture {
  Viewpoint viewpoint;
  double time_s = 0.0;  // of the sea
  std::uint32_t width = 0, height = 0;
  std::array<Image8, 2> pictures;  // of both eyes
  std::array<std::vector<std::uint8_t>, 2> depths;
};

// Device and headset outlive it.
class HeadsetScene {
 public:
  HeadsetScene(Device& device, Headset& headset, const Scene& scene);

  // Begins and ends a frame as Explorer does, seen from `carrier`; without a picture where the headset wants none.
  DisplayFrame step(bool kept = false);
  // What the last picture was drawn of; its pictures too, where they were kept.
  const HeadsetPicture& drawn() const { return drawn_; }
  Experience& experience() { return experience_; }

  static const Pose carrier;

 private:
  Device& device_;
  Headset& headset_;
  Experience experience_;
  PictureCopy copy_;
  HeadsetPicture drawn_;
};

// As in `headset`, but for the images, which are the experience's own.
ExperienceOptions options_of(const Headset& headset);
// The same frames of a new Experience, without a headset; `hidden`: what its lenses would hide; null: nothing.
std::vector<HeadsetPicture> drawn_without(Device& device, const Scene& scene, ExperienceOptions options,
                                          const std::vector<HeadsetPicture>& as, const HiddenMesh* hidden = nullptr);
// An eye's depths in a picture's upper left part.
std::vector<std::uint8_t> depths_of(Device& device, const Image& depth, const HeadsetPicture& of, std::size_t eye);

}  // namespace seascape::test
