#include "app/lab/drawn_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <random>

#include "app/effect_costs.h"
#include "app/lab/picture_error.h"
#include "app/lab/screen_error.h"
#include "app/lab/wave_sum.h"
#include "app/program.h"
#include "app/quality.h"
#include "ocean/waves/wave_compute.h"
#include "ocean/waves/wave_upload.h"

namespace seascape {

namespace {

// The open sea of a wind, at a preset.
Scene scene_at(double wind_mps, const LabOptions& options, std::string_view preset) {
  Scene scene = load_scene("open_sea", preset);
  scene.settings.sea = lab_sea(wind_mps, options);
  return scene;
}

// ---- the mesh

std::vector<LabTask> mesh_tasks(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options) {
  struct Meshed {
    Meshed(Device& device, ShaderLibrary& shaders, const Scene& scene) : settings(scene.settings), subject(device, shaders, scene, {160, 168, 1, false, false}) {
      at = scene.start;
      at.position_m.y = 2.0 + 4.0 * std::sqrt(settings.sea.wind_speed_mps > 0.0 ? subject.experience().ocean().statistics().height_variance : 0.0);
      view.viewer = at;
      view.eyes = stereo_views(at, symmetric_fov(headset_fov_deg, headset_aspect), 0.064);
      pixels = pixels_per_radian(view.eyes, headset_height_px);
    }
    Settings settings;
    CostSubject subject;
    Pose at;
    Viewpoint view;
    double pixels = 0.0;
  };
  std::vector<LabTask> tasks;
  for (const LodJoin join : {LodJoin::morphed, LodJoin::masked})
    for (const double pixels : options.quick ? std::vector<double>{16.0, 8.0, 5.0, 4.0, 3.0} : std::vector<double>{16.0, 8.0, 4.0, 2.0, 1.0}) {
      Scene scene = scene_at(wind_mps, options, "medium");
      scene.settings.lod.join = join;
      scene.settings.lod.pixel_error = pixels;
      scene.settings.render.msaa = 1;
      scene.settings.render.vertical_fov_deg = headset_fov_deg;
      const auto meshed = std::make_shared<Meshed>(device, shaders, scene);
      const auto errors = [=]() -> std::vector<LabError> {
        const WaveField field(meshed->settings.sea, WaveQuality{256, 5, false});
        WaveTiles tiles;
        field.evaluate(ticks_from_seconds(17.0), tiles);
        ScreenError error;
        error.enough = 0.3 * pixels;
        std::mt19937 poses(options.seed + 7), points(options.seed + 8);
        Quadtree tree(meshed->settings.lod);
        for (int n = 0; n < (options.quick ? 2 : 8); ++n) {
          const Viewpoint view = pose_over(field, tiles, poses, n);
          add_picture({field, tiles, tree.select(view, bounds_of(field, tiles, view.viewer.position_m), &field, &tiles)}, view, 4, points, error);
        }
        return {{error.worst, "pixels of a headset, worst"}, {error.share(0.999), "pixels of a headset, 99.9 % of points"}, {error.triangles / error.poses, "triangles"}};
      };
      const std::string preset = join == LodJoin::masked ? "" : pixels == 8.0 ? "low" : pixels == 4.0 ? "medium" : pixels == 2.0 ? "high" : pixels == 1.0 ? "ultra" : "";
      // A small picture with the mesh of a headset's: its time is the mesh's more than its pixels'.
      tasks.push_back({join == LodJoin::morphed ? "lod.pixel_error, morphed" : "lod.pixel_error, masked", pixels,
                       [=] { meshed->subject.draw_ms(meshed->at, 17.0, meshed->pixels); }, 1.0, errors, preset, fmt::format("lod.pixel_error={}", pixels)});
    }
  return tasks;
}

// ---- where waves are computed

struct Filled {
  Filled(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& of, bool on_gpu)
      : quality(of), bins(make_wave_bins(sea, of)), frame(device, 4096),
        images(device, sea, of, bins, sea_statistics(sea, bins), 1.0, on_gpu ? WaveImages::Filled::stored : WaveImages::Filled::written), device_(device) {
    if (on_gpu) compute = std::make_unique<WaveCompute>(device, shaders, sea, bins, images);
    else upload = std::make_unique<WaveUpload>(device, sea, of, bins, images);
  }
  void run(std::int64_t ticks) {
    frame.begin();
    if (compute) compute->update(frame, ticks);
    else upload->update(frame, ticks);
    frame.submit();
    frame.finish();
  }
  // Heights of the highest of the cascades with 64 waves a side, read between texels anywhere, against the sum of its waves in double: relative L2.
  double error(std::int64_t ticks, std::uint32_t seed) {
    run(ticks - 1);
    run(ticks);
    int cascade = 1;
    for (int c = 2; c < bins.cascades; ++c)
      if (variance(c) > variance(cascade)) cascade = c;
    const int samples = tile_samples(quality, cascade);
    const WaveImages::Set& set = images.sets()[1];
    const Image& image = set.image(WavePlane::shift);
    const std::vector<std::uint8_t> bytes = read_image(device_, image, std::uint32_t(cascade - set.first), 0);
    const bool half = image.spec().format == VK_FORMAT_R16G16B16A16_SFLOAT;
    const auto texel = [&](int x, int z) {
      const std::size_t at = std::size_t(z & (samples - 1)) * std::size_t(samples) + std::size_t(x & (samples - 1));
      std::uint16_t h = 0;
      float f = 0.0f;
      half ? std::memcpy(&h, &bytes[8 * at + 2], 2) : std::memcpy(&f, &bytes[16 * at + 4], 4);
      return half ? double(glm::unpackHalf1x16(h)) : double(f);
    };
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double miss = 0.0, size = 0.0;
    for (int place = 0; place < 400; ++place) {
      const glm::dvec2 at(unit(random), unit(random)), cell = glm::floor(at * double(samples)), f = at * double(samples) - cell;
      const int x = int(cell.x), z = int(cell.y);
      const double got = glm::mix(glm::mix(texel(x, z), texel(x + 1, z), f.x), glm::mix(texel(x, z + 1), texel(x + 1, z + 1), f.x), f.y);
      const double want = wave_sum(bins, cascade, gpu::wave_bins / 2, ticks, at);
      miss += std::pow(got - want, 2), size += want * want;
    }
    return std::sqrt(miss / size);
  }
  double variance(int cascade) const {
    double sum = 0.0;
    for (std::size_t at = WaveBins::first(cascade); at < WaveBins::first(cascade + 1); ++at) sum += double(glm::dot(bins.bins[at].amplitude, bins.bins[at].amplitude));
    return sum;
  }
  WaveQuality quality;
  WaveBins bins;
  Frame frame;
  WaveImages images;
  std::unique_ptr<WaveCompute> compute;
  std::unique_ptr<WaveUpload> upload;

 private:
  Device& device_;
};

std::vector<LabTask> compute_tasks(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options) {
  std::vector<LabTask> tasks;
  for (const bool on_gpu : {false, true})
    for (const bool half : {false, true})
      for (const int resolution : options.quick ? std::vector<int>{16, 32, 64, 128, 256} : std::vector<int>{32, 64, 128, 256, 512}) {
        const auto filled = std::make_shared<Filled>(device, shaders, lab_sea(wind_mps, options), WaveQuality{resolution, 4, half}, on_gpu);
        const auto time = std::make_shared<std::int64_t>(ticks_from_seconds(10.0));
        const std::string preset = on_gpu != device.facts().software && resolution == 256 ? (half ? "low medium" : "high") : "";
        tasks.push_back({std::string(on_gpu ? "waves.resolution, compute shaders" : "waves.resolution, processor") + (half ? ", 16 bit" : ""), double(resolution),
                         [=] { filled->run(*time += 11650); }, 1.0,
                         [=] { return std::vector<LabError>{{filled->error(ticks_from_seconds(1e5), options.seed), "relative L2 of heights between texels"}}; }, preset,
                         fmt::format("waves.resolution={} waves.half_storage={} waves.where={}", resolution, half, on_gpu ? "gpu" : "cpu")});
      }
  return tasks;
}

// ---- whole frames

struct Quality {
  std::string name;  // of a preset, or empty
  std::vector<std::pair<std::string, std::string>> values;
  std::string text() const {
    std::string all;
    for (const auto& [key, value] : values) all += (all.empty() ? "" : " ") + key + "=" + value;
    return all;
  }
};

// `samples`: what the device can draw of them.
std::vector<Quality> qualities(const LabOptions& options, const std::vector<std::string>& samples) {
  std::vector<Quality> all;
  const std::vector<std::pair<std::string, std::vector<std::string>>> knobs{
      {"waves.resolution", {"64", "128", "256", "512"}}, {"waves.cascades", {"3", "4", "5"}}, {"waves.half_storage", {"false", "true"}}, {"lod.pixel_error", {"16", "8", "4", "2", "1"}},
      {"lod.patch_quads", {"16", "32", "64"}},           {"water.anisotropy", {"1", "2", "4", "8", "16"}}, {"frame.shape", {"tile", "auto"}}, {"msaa", samples}};
  for (const std::string_view preset : preset_names()) {
    Quality one{std::string(preset), {}};
    Settings settings;
    apply_preset(settings, preset);
    for (const auto& [key, choices] : knobs) one.values.emplace_back(key, value_text(settings, *find_setting(key)));
    all.push_back(std::move(one));
  }
  std::mt19937 random(options.seed);
  for (int n = 0; n < (options.quick ? 12 : 64); ++n) {
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

std::vector<Shot> shots_of(const Scene& scene) {
  const WaveField field(scene.settings.sea, WaveQuality{64, 2, false});
  const double hs = 4.0 * std::sqrt(field.statistics().height_variance);
  std::vector<Shot> shots;
  for (const auto& [height, pitch, yaw, time] : {std::array{1.7 + 0.7 * hs, -4.0, 30.0, 12.0}, std::array{8.0 + 3.0 * hs, -20.0, 150.0, 47.0}}) {
    const glm::dquat turn = glm::angleAxis(glm::radians(yaw), glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(glm::radians(pitch), glm::dvec3(1.0, 0.0, 0.0));
    shots.push_back({{{120.0, height, -40.0}, turn}, time});
  }
  return shots;
}

std::vector<LabPoint> frame_points(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options, const std::function<void(double)>& step) {
  const std::uint32_t width = options.quick ? 320 : 480, height = options.quick ? 176 : 272;
  constexpr std::uint32_t finer = 4;  // the truth's pixels a pixel's side
  const auto subject_of = [&](const Quality& quality, std::uint32_t times) {
    Scene scene = scene_at(wind_mps, options, "ultra");
    for (const auto& [key, value] : quality.values) set_from_text(scene.settings, key, value, "seascape lab");
    return std::make_unique<CostSubject>(device, shaders, scene, ExperienceOptions{times * width, times * height, 1, false, false});
  };
  const std::vector<Shot> shots = shots_of(scene_at(wind_mps, options, "ultra"));
  std::vector<Image8> truth;
  {
    // The best there is: ultra with what goes beyond it, 16 pixels for one.
    Quality best{"", {{"waves.resolution", "512"}, {"waves.cascades", "5"}, {"waves.half_storage", "false"}, {"lod.pixel_error", "2"}, {"water.anisotropy", "16"}, {"msaa", "4"}}};
    const std::unique_ptr<CostSubject> subject = subject_of(best, finer);
    for (const Shot& shot : shots) {
      subject->draw_ms(shot.from, shot.time_s);
      truth.push_back(averaged(picture_of(device, subject->experience(), 0), int(finer)));
    }
  }
  std::vector<std::string> samples;
  for (const int count : {1, 2, 4, 8})
    if ((device.facts().sample_counts & std::uint32_t(count)) != 0u) samples.push_back(std::to_string(count));
  const std::vector<Quality> all = qualities(options, samples);
  std::vector<std::vector<double>> us(all.size());
  std::vector<PictureError> errors(all.size());
  const int rounds = 2, frames = options.quick ? 3 : 5;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < all.size(); ++n) {
      const std::size_t i = round % 2 == 0 ? n : all.size() - 1 - n;  // whatever drifts, drifts for all alike
      const std::unique_ptr<CostSubject> subject = subject_of(all[i], 1);
      for (std::size_t s = 0; s < shots.size(); ++s) {
        subject->draw_ms(shots[s].from, shots[s].time_s);
        if (round == 0) {
          const PictureError e = picture_error(picture_of(device, subject->experience(), 0), truth[s]);
          errors[i].mean += e.mean / double(shots.size());
          errors[i].p99 += e.p99 / double(shots.size());
          errors[i].dissimilarity += e.dissimilarity / double(shots.size());
        }
        for (int f = 1; f <= frames; ++f) us[i].push_back(1e3 * subject->draw_ms(shots[s].from, shots[s].time_s + f / 30.0));
      }
      step((round * double(all.size()) + double(n) + 1.0) / (rounds * double(all.size())));
    }
  std::vector<LabPoint> points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string knob = all[i].name.empty() ? "random settings" : "presets";
    const double value = all[i].name.empty() ? double(i) - double(preset_names().size()) + 1.0 : double(i) + 1.0;
    for (const LabError& error : {LabError{errors[i].mean, "of white, mean of pixels"}, LabError{errors[i].p99, "of white, 99th percentile of pixels"}, LabError{errors[i].dissimilarity, "1 - SSIM"}})
      points.push_back({"frame", knob, value, sea_name(wind_mps), summarise(us[i]), error, all[i].name, all[i].text()});
  }
  return points;
}

}  // namespace

std::vector<LabCurve> drawn_curves(Device& device, ShaderLibrary& shaders) {
  const auto of = [&](auto tasks) {
    return [&device, &shaders, tasks](double wind_mps, const LabOptions& options) { return tasks(device, shaders, wind_mps, options); };
  };
  return {
      {"mesh", "Pixels that the mesh may miss", "a small frame",
       {{"lod.pixel_error, morphed", false, 1.0, 0.35, 1.0, 8.0, "the error is what is asked for, and triangles its inverse square"}}, true, true, of(mesh_tasks)},
      {"compute", "Waves by the processor and by compute shaders", "one update of all tiles",
       {{"waves.resolution, processor", false, -2.0, 0.4, 64.0, 512.0, "straight lines between texels are of second order"}}, true, true, of(compute_tasks)},
      {"frame", "Whole frames", "one frame", {}, true, true, {},
       [&device, &shaders](double wind_mps, const LabOptions& options, const std::function<void(double)>& step) { return frame_points(device, shaders, wind_mps, options, step); }},
  };
}

}  // namespace seascape
