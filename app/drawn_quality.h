// What of a frame's quality may change from one frame to the next. Plain values.
#pragma once

namespace seascape {

// Against what the settings ask for; 1 is as they say.
struct DrawnQuality {
  double scale = 1.0;   // of the picture's width and height, at most 1
  double mesh = 1.0;    // of the pixels by which the mesh may miss the sea (lod.pixel_error, lod.threshold), at least 1
  double detail = 1.0;  // of models.detail, at most 1
  double spray = 1.0;   // share of the spray aloft that is drawn
  double shadows = 1.0;     // of the sun map's side (models.shadow_texels), at most 1
  double anisotropy = 1.0;  // of water.anisotropy, at most 1
  double foam = 1.0;        // share of the foam's steps that are made: 1 over a whole number

  bool operator==(const DrawnQuality&) const = default;
};

}  // namespace seascape
