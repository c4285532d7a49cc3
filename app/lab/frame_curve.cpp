#include "app/lab/frame_curve.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>

#include "app/effect_costs.h"
#include "app/lab/pareto.h"
#include "app/lab/picture_error.h"
#include "app/lab/screen_error.h"
#include "app/program.h"
#include "app/quality.h"

namespace seascape {

namespace {

struct Quality {
  std::string name;  // of a preset, or empty
  std::vector<std::pair<std::string, std::string>> values;
  std::string text() const {
    std::string all;
    for (const auto& [key, value] : values) all += (all.empty() ? "" : " ") + key + "=" + value;
    return all;
  }
};

std::vector<Quality> qualities(const LabOptions& options, const DeviceFacts& facts) {
  std::vector<std::string> samples;
  for (const int count : {1, 2, 4, 8})
    if ((facts.sample_counts & std::uint32_t(count)) != 0u) samples.push_back(std::to_string(count));
  std::vector<Quality> all;
  const std::vector<std::pair<std::string, std::vector<std::string>>> knobs{
      {"waves.resolution", {"64", "128", "256", "512"}},
      {"waves.cascades", {"3", "4", "5"}},
      {"waves.half_storage", {"false", "true"}},
      {"lod.pixel_error", {"16", "8", "4", "2", "1"}},
      {"water.anisotropy", {"1", "2", "4", "8", "16"}},
      {"frame.shape", {"tile", "auto"}},
      {"msaa", samples}};
  for (const std::string_view preset : preset_names()) {
    Quality one{std::string(preset), {}};
    Settings settings;
    apply_preset(settings, preset);
    suit_device(settings, preset, device_class(facts));
    for (const auto& [key, choices] : knobs) one.values.emplace_back(key, value_text(settings, *find_setting(key)));
    all.push_back(std::move(one));
  }
  std::mt19937 random(options.seed);
  for (int n = 0; n < (!options.timed ? 3 : options.quick ? 12 : 64); ++n) {
    Quality one;
    for (const auto& [key, choices] : knobs) one.values.emplace_back(key, choices[random() % choices.size()]);
    all.push_back(std::move(one));
  }
  return all;
}

struct Shot {
  Pose from;
  double time_s;
};

// From above the waves to the horizon, from a deck down, and of the water at one's feet.
std::vector<Shot> shots_of(const Scene& scene) {
  const WaveField field(scene.settings.sea, WaveQuality{64, 2, false});
  const double hs = 4.0 * std::sqrt(field.statistics().height_variance);
  std::vector<Shot> shots;
  for (const auto& [height, pitch, yaw, time] :
       {std::array{1.7 + 0.7 * hs, -4.0, 30.0, 12.0}, std::array{8.0 + 3.0 * hs, -20.0, 150.0, 47.0},
        std::array{1.7 + 0.7 * hs, -35.0, 270.0, 83.0}}) {
    const glm::dquat turn = glm::angleAxis(glm::radians(yaw), glm::dvec3(0.0, 1.0, 0.0)) *
                            glm::angleAxis(glm::radians(pitch), glm::dvec3(1.0, 0.0, 0.0));
    shots.push_back({{{120.0, height, -40.0}, turn}, time});
  }
  return shots;
}

// The presets, which stand first, and what they are compared with: the front, and what takes up to a quarter longer.
std::vector<std::size_t> presets_and_front(const std::vector<std::vector<double>>& us,
                                           const std::vector<PictureError>& errors) {
  std::vector<Tradeoff> points;
  for (std::size_t i = 0; i < us.size(); ++i) points.push_back({summarise(us[i]).median, errors[i].mean});
  std::vector<std::size_t> chosen(preset_names().size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  for (const std::size_t i : near_front(points, 1.25))
    if (i >= preset_names().size()) chosen.push_back(i);
  return chosen;
}

std::vector<LabPoint> frame_points(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options,
                                   const std::function<void(double)>& step) {
  const std::uint32_t width = !options.timed  ? 160
                              : options.quick ? 480
                                              : 960,
                      height = !options.timed  ? 90
                               : options.quick ? 272
                                               : 544;
  constexpr std::uint32_t finer = 4;  // the truth's pixels a pixel's side
  // A pixel is as large as a headset's.
  const double fov_deg =
      glm::degrees(2.0 * std::atan(double(height) / headset_height_px * std::tan(0.5 * glm::radians(headset_fov_deg))));
  const auto subject_of = [&](const Quality& quality, std::uint32_t times) {
    Scene scene = lab_scene(wind_mps, options, "ultra");
    scene.settings.render.vertical_fov_deg = fov_deg;
    for (const auto& [key, value] : quality.values) set_from_text(scene.settings, key, value, "seascape lab");
    return std::make_unique<CostSubject>(device, shaders, scene,
                                         ExperienceOptions{times * width, times * height, 1, false, false});
  };
  const std::vector<Shot> shots = shots_of(lab_scene(wind_mps, options, "ultra"));
  const std::vector<Quality> all = qualities(options, device.facts());
  const int rounds = 2,
            again = !options.timed  ? 1
                    : options.quick ? 2
                                    : 4,
            frames = !options.timed  ? 1
                     : options.quick ? 3
                                     : 5;
  // The truth and the second rounds are some tenths of it all.
  const double share = 0.6 / double(rounds * int(all.size()));
  double done = 0.1;
  std::vector<Image8> truth;
  {
    // The best there is: ultra with what goes beyond it, 16 pixels for one.
    Quality best{"",
                 {{"waves.resolution", "512"},
                  {"waves.cascades", "5"},
                  {"waves.half_storage", "false"},
                  {"lod.pixel_error", "2"},
                  {"water.anisotropy", "16"},
                  {"msaa", "4"}}};
    const std::unique_ptr<CostSubject> subject = subject_of(best, finer);
    for (const Shot& shot : shots) {
      subject->draw_ms(shot.from, shot.time_s);
      truth.push_back(averaged(picture_of(device, subject->experience(), 0), int(finer)));
    }
    step(done);
  }
  std::vector<std::vector<double>> us(all.size());
  std::vector<PictureError> errors(all.size());
  // Times one setting in all views; the first time its errors are found too.
  const auto time_one = [&](std::size_t i, bool first) {
    const std::unique_ptr<CostSubject> subject = subject_of(all[i], 1);
    for (std::size_t s = 0; s < shots.size(); ++s) {
      subject->draw_ms(shots[s].from, shots[s].time_s);
      if (first) {
        const PictureError e = picture_error(picture_of(device, subject->experience(), 0), truth[s]);
        errors[i].mean += e.mean / double(shots.size());
        errors[i].p99 += e.p99 / double(shots.size());
        errors[i].dissimilarity += e.dissimilarity / double(shots.size());
      }
      for (int f = 1; f <= frames; ++f)
        us[i].push_back(1e3 * subject->draw_ms(shots[s].from, shots[s].time_s + f / 30.0));
    }
  };
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < all.size(); ++n) {
      time_one(round % 2 == 0 ? n : all.size() - 1 - n, round == 0);  // whatever drifts, drifts for all alike
      step(done += share);
    }
  // Where presets lie against the front is told by these, timed closer together. Their first times are forgotten.
  const std::vector<std::size_t> close = presets_and_front(us, errors);
  for (const std::size_t i : close) us[i].clear();
  for (int round = 0; round < again; ++round)
    for (std::size_t n = 0; n < close.size(); ++n) {
      time_one(close[round % 2 == 0 ? n : close.size() - 1 - n], false);
      step(done += 0.3 / double(again * int(close.size())));
    }
  std::vector<LabPoint> points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string knob = all[i].name.empty() ? "random settings" : "presets";
    const double value = all[i].name.empty() ? double(i) - double(preset_names().size()) + 1.0 : double(i) + 1.0;
    for (const LabError& error : {LabError{errors[i].mean, "of white, mean of pixels"},
                                  LabError{errors[i].p99, "of white, 99th percentile of pixels"},
                                  LabError{errors[i].dissimilarity, "1 - SSIM"}})
      points.push_back({"frame", knob, value, sea_name(wind_mps), summarise(us[i]), error, all[i].name, all[i].text()});
  }
  return points;
}

}  // namespace

Scene lab_scene(double wind_mps, const LabOptions& options, std::string_view preset) {
  Scene scene = load_scene("open_sea", preset);
  scene.settings.sea = lab_sea(wind_mps, options);
  return scene;
}

LabCurve frame_curve(Device& device, ShaderLibrary& shaders) {
  return {"frame",
          "Whole frames",
          "one frame",
          {},
          true,
          true,
          {},
          [&device, &shaders](double wind_mps, const LabOptions& options, const std::function<void(double)>& step) {
            return frame_points(device, shaders, wind_mps, options, step);
          }};
}

}  // namespace seascape
