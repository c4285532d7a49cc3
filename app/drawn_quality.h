// What of a frame's quality may change from one frame to the next. Plain values.
#pragma once

namespace seascape {

// Against what the settings ask for; 1 is as they say.
struct DrawnQuality {
  double scale = 1.0;   // of the picture's width and height, at most 1
  double mesh = 1.0;    // of the pixels by which the mesh may miss the sea (lod.pixel_error, lod.threshold), at least 1
  double detail = 1.0;  // of models.detail, at most 1
  double spray = 1.0;   // share of the spray aloft that is drawn

  bool operator==(const DrawnQuality&) const = default;
};

}  // namespace seascape
