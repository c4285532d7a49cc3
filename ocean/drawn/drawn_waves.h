// The sea's own waves as images that the surface samples, filled by the GPU or by the processor.
#pragma once
#include <memory>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/drawn/wave_compute.h"
#include "ocean/drawn/wave_images.h"
#include "ocean/drawn/wave_upload.h"
#include "ocean/waves/wave_place.h"

namespace seascape {

class DrawnWaves final : public DrawnPiece {
 public:
  // In the sea's quality of the picture; the sea outlives it. A sea without waves has images of none.
  DrawnWaves(Device& device, ShaderLibrary& shaders, Sea& sea, WavePlace where, double anisotropy,
             int in_flight = Frame::slots);

  // Has the waves of a time in this frame's images; nothing where they are there.
  void make(Frame& frame, double time_s);
  const WaveImages& images() const { return images_; }
  // The waves that are drawn; none where the GPU makes them.
  const SeaView& view() const { return upload_ ? upload_->view() : nothing_; }
  bool by_processor() const { return upload_ != nullptr; }

  const char* stage() const override { return "waves"; }
  void update(Frame& frame, const DrawnMoment& moment) override { make(frame, moment.time_s); }
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override { images_.add_reads(uses); }
  std::size_t copies() const override { return images_.copies().size(); }
  std::size_t shown() const override { return images_.shown(); }

 private:
  void follow(Frame& frame);
  Sea& sea_;
  WaveImages images_;
  std::unique_ptr<WaveCompute> compute_;  // either this
  std::unique_ptr<WaveUpload> upload_;    // or this fills them
  std::uint64_t version_;                 // Sea::bins_version that is drawn
  SeaView nothing_;
};

}  // namespace seascape
