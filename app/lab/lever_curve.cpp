#include "app/lab/lever_curve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "app/drawn_quality.h"
#include "app/effect_costs.h"
#include "app/lab/flip.h"
#include "app/lab/screen_error.h"
#include "app/program.h"

namespace seascape {

namespace {

// A part of a headset's picture of a scene, of pixels as large as a headset's.
class Levered {
 public:
  Levered(Device& device, ShaderLibrary& shaders, const std::string& name, int side, int samples)
      : device_(device),
        side_(side),
        subject_(device, shaders, scene_of(name, side, samples), {unsigned(side), unsigned(side), 2}) {
    const Pose& start = subject_.experience().scene().start;
    for (const double turn_deg : {0.0, 130.0})
      from_.push_back(
          {start.position_m, glm::angleAxis(glm::radians(turn_deg), glm::dvec3(0.0, 1.0, 0.0)) * start.orientation});
  }

  void set(const DrawnQuality& quality) {
    const auto side = std::uint32_t(std::lround(side_ * quality.scale));
    subject_.experience().resize(side, side, {unsigned(side_), unsigned(side_)});
    subject_.experience().draw_at(quality);
    quality_ = quality;
  }
  // A frame more of a sea that runs.
  void run() {
    const double pixels = pixels_per_radian();
    subject_.draw_ms(from_[0], start_s + frames_++ / 72.0, pixels);
  }
  // Against the finest step, which `finest` draws; after `run_s` of both seas, at 24 frames a second.
  FlipError error(Levered& finest, double run_s) {
    const DrawnQuality quality = quality_;
    for (int i = 1; i < int(24.0 * run_s); ++i) {
      finest.draw(from_[0], {}, i / 24.0);
      draw(from_[0], quality, i / 24.0);
    }
    FlipError error;
    for (const Pose& from : from_) {
      finest.draw(from, {}, run_s);
      const Image8 whole = picture_of(finest.device_, finest.subject_.experience(), 0);
      draw(from, quality, run_s);
      const Image8 now = picture_of(device_, subject_.experience(), 0);
      const FlipError one = flip_error(stretched(now, side_, side_), whole, pixels_per_radian(1.0) * glm::radians(1.0));
      error.mean += one.mean / double(from_.size());
      error.worst = std::max(error.worst, one.worst);
    }
    return error;
  }

 private:
  static constexpr double start_s = 12.0;
  static Scene scene_of(const std::string& name, int side, int samples) {
    Scene scene = load_scene(name, "medium");
    scene.settings.render.msaa = samples;
    scene.settings.render.vertical_fov_deg =
        glm::degrees(2.0 * std::atan(side / headset_height_px * std::tan(0.5 * glm::radians(headset_fov_deg))));
    return scene;
  }
  double pixels_per_radian(double scale) const {
    return scale * 0.5 * headset_height_px / std::tan(0.5 * glm::radians(headset_fov_deg));
  }
  double pixels_per_radian() const { return pixels_per_radian(quality_.scale); }
  void draw(const Pose& from, const DrawnQuality& quality, double after_s) {
    set(quality);
    subject_.draw_ms(from, start_s + after_s, pixels_per_radian());
  }

  Device& device_;
  int side_;
  CostSubject subject_;
  std::vector<Pose> from_;
  DrawnQuality quality_;
  int frames_ = 0;
};

struct Tried {
  const char* knob;
  double DrawnQuality::*part;  // null: samples a pixel, which a scene is built with
  std::vector<double> values, quick;
  std::vector<std::string> scenes;
  double run_s = 0.0;  // of the sea before its error is seen
};

std::vector<Tried> all_levers() {
  return {{"picture scale",
           &DrawnQuality::scale,
           {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5},
           {1.0, 0.9, 0.7, 0.5},
           {"open_sea", "storm", "harbour"}},
          {"mesh coarseness",
           &DrawnQuality::mesh,
           {1.0, 1.1, 1.2, 1.3, 1.41},
           {1.0, 1.2, 1.41},
           {"open_sea", "storm", "harbour"}},
          {"detail of models", &DrawnQuality::detail, {1.0, 0.85, 0.7, 0.6, 0.5}, {1.0, 0.7, 0.5}, {"harbour"}},
          {"spray drawn", &DrawnQuality::spray, {1.0, 0.85, 0.7, 0.5, 0.3}, {1.0, 0.7, 0.3}, {"storm"}},
          {"shadow texels", &DrawnQuality::shadows, {1.0, 0.9, 0.8, 0.65, 0.5}, {1.0, 0.7, 0.5}, {"harbour"}},
          {"anisotropy",
           &DrawnQuality::anisotropy,
           {1.0, 0.84, 0.7, 0.5, 0.35, 0.25},
           {1.0, 0.5, 0.25},
           {"open_sea", "storm", "harbour"}},
          {"foam's rate", &DrawnQuality::foam, {1.0, 0.5}, {1.0, 0.5}, {"storm"}, 3.0},
          {"samples", nullptr, {4.0, 2.0, 1.0}, {4.0, 1.0}, {"open_sea", "storm", "harbour"}}};
}

std::vector<LabTask> lever_tasks(Device& device, ShaderLibrary& shaders, const LabOptions& options) {
  const int side = !options.timed ? 128 : options.quick ? 256 : 512;
  std::map<std::tuple<std::string, int, bool>, std::shared_ptr<Levered>> made;
  const auto scenes_of = [&](const Tried& tried, int samples, bool another = false) {
    std::vector<std::shared_ptr<Levered>> scenes;
    for (const std::string& name : tried.scenes) {
      std::shared_ptr<Levered>& scene = made[{name, samples, another}];
      if (scene == nullptr) scene = std::make_shared<Levered>(device, shaders, name, side, samples);
      scenes.push_back(scene);
    }
    return scenes;
  };
  std::vector<LabTask> tasks;
  for (const Tried& tried : all_levers()) {
    const std::vector<double>& values = options.quick ? tried.quick : tried.values;
    const auto finest = scenes_of(tried, tried.part == nullptr ? int(values.front()) : 1);
    const auto lowered = tried.run_s > 0.0 ? scenes_of(tried, 1, true) : finest;
    const double run_s = tried.run_s;
    for (const double value : values) {
      DrawnQuality quality;
      if (tried.part != nullptr) quality.*tried.part = value;
      const auto drawn = tried.part != nullptr ? lowered : scenes_of(tried, int(value));
      const auto run = [=] {
        for (const auto& scene : drawn) scene->set(quality), scene->run();
      };
      const auto errors = [=]() -> std::vector<LabError> {
        FlipError all;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
          drawn[i]->set(quality);
          const FlipError one = drawn[i]->error(*finest[i], run_s);
          all.mean += one.mean / double(drawn.size());
          all.worst = std::max(all.worst, one.worst);
        }
        return {{all.mean, "FLIP, mean of pixels"}, {all.worst, "FLIP, worst pixel"}};
      };
      tasks.push_back({tried.knob, value, run, double(drawn.size()), errors, "", ""});
    }
  }
  return tasks;
}

}  // namespace

LabCurve lever_curve(Device& device, ShaderLibrary& shaders) {
  return {"levers",
          "Levers of adaptive quality",
          "one frame",
          {},
          false,
          true,
          [&device, &shaders](double, const LabOptions& options) { return lever_tasks(device, shaders, options); }};
}

}  // namespace seascape
