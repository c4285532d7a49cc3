#include "app/lab/drawn_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <random>

#include "app/effect_costs.h"
#include "app/lab/frame_curve.h"
#include "app/lab/lever_curve.h"
#include "app/lab/screen_error.h"
#include "app/lab/wave_sum.h"
#include "app/quality.h"
#include "engine/text.h"
#include "ocean/drawn/wave_compute.h"
#include "ocean/drawn/wave_upload.h"

namespace seascape {

namespace {

// ---- the mesh

std::vector<LabTask> mesh_tasks(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options) {
  struct Meshed {
    Meshed(Device& device, ShaderLibrary& shaders, const Scene& scene)
        : settings(scene.settings), subject(device, shaders, scene, {160, 168, 1, false, false}) {
      at = scene.start;
      at.position_m.y = 2.0 + 4.0 * std::sqrt(settings.sea.wind_speed_mps > 0.0
                                                  ? subject.experience().sea()->statistics().height_variance
                                                  : 0.0);
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
  const auto add = [&](LodLaw law, LodJoin join, const std::vector<double>& values) {
    const bool by_pixels = law == LodLaw::pixel_error;
    const std::string key = by_pixels ? "lod.pixel_error" : "lod.threshold";
    for (const double value : values) {
      Scene scene = lab_scene(wind_mps, options, "medium");
      scene.settings.lod.by = law;
      scene.settings.lod.join = join;
      (by_pixels ? scene.settings.lod.pixel_error : scene.settings.lod.threshold) = value;
      scene.settings.render.msaa = 1;
      scene.settings.render.vertical_fov_deg = headset_fov_deg;
      const auto meshed = std::make_shared<Meshed>(device, shaders, scene);
      const auto errors = [=]() -> std::vector<LabError> {
        const WaveField field(meshed->settings.sea, WaveQuality{256, 5, false});
        WaveTiles tiles;
        field.evaluate(ticks_from_seconds(17.0), tiles);
        ScreenError error;
        error.enough = by_pixels ? 0.3 * value : 0.3;
        std::mt19937 poses(options.seed + 7), points(options.seed + 8);
        Quadtree tree(meshed->settings.lod);
        for (int n = 0; n < (options.quick ? 2 : 24); ++n) {
          const Viewpoint view = pose_over(field, tiles, poses, n);
          add_picture({field, tiles,
                       tree.select(view, MeshWater(bounds_of(field, tiles, view.viewer.position_m), &field, &tiles))},
                      view, 4, points, error);
        }
        // The worst of eight poses scattered by a fifth: it is told, and no front is drawn by it.
        return {{error.share(0.999), "pixels of a headset, 99.9 % of points"},
                {error.worst, "pixels of a headset, worst"},
                {error.triangles / error.poses, "triangles"}};
      };
      // Presets morph, by pixels.
      const std::string preset =
          by_pixels && join == LodJoin::morphed ? presets_with({{"lod.pixel_error", text_from(value)}}) : "";
      // A small picture with the mesh of a headset's: its time is the mesh's more than its pixels'.
      tasks.push_back({key + (join == LodJoin::morphed ? ", morphed" : ", masked"), value,
                       [=] { meshed->subject.draw_ms(meshed->at, 17.0, meshed->pixels); }, 1.0, errors, preset,
                       fmt::format("{}={}{}", key, value, by_pixels ? "" : " lod.by=threshold")});
    }
  };
  const std::vector<double> pixels = options.quick ? std::vector<double>{16.0, 8.0, 5.0, 4.0, 3.0}
                                                   : std::vector<double>{16.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.4, 1.0},
                            thresholds = options.quick ? std::vector<double>{4.0, 2.0}
                                                       : std::vector<double>{4.0, 3.0, 2.0, 1.5, 1.2, 1.0, 0.7, 0.5};
  for (const LodJoin join : {LodJoin::morphed, LodJoin::masked}) {
    add(LodLaw::pixel_error, join, pixels);
    add(LodLaw::threshold, join, thresholds);
  }
  return tasks;
}

// ---- where waves are computed

struct Filled {
  Filled(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& of, bool on_gpu)
      : quality(of),
        bins(make_wave_bins(sea, of)),
        frame(device, 4096),
        images(device, sea, of, bins, sea_statistics(sea, bins), 1.0,
               on_gpu ? WaveImages::Filled::stored : WaveImages::Filled::written),
        device_(device) {
    if (on_gpu)
      compute = std::make_unique<WaveCompute>(device, shaders, sea, bins, images);
    else {
      SeaSpec spec;
      spec.state = sea;
      spec.drawn = spec.crests = spec.felt = of;
      of_upload = std::make_unique<Sea>(std::move(spec));
      upload = std::make_unique<WaveUpload>(device, *of_upload, images);
    }
  }
  void run(std::int64_t ticks) {
    frame.begin();
    if (compute)
      compute->update(frame, ticks);
    else
      upload->update(frame, ticks);
    frame.submit();
    frame.finish();
  }
  // Heights of the highest of the cascades with 64 waves a side, read between texels anywhere, against the sum of its
  // waves in double: relative L2.
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
      const glm::dvec2 at(unit(random), unit(random)), cell = glm::floor(at * double(samples)),
                                                       f = at * double(samples) - cell;
      const int x = int(cell.x), z = int(cell.y);
      const double got = glm::mix(glm::mix(texel(x, z), texel(x + 1, z), f.x),
                                  glm::mix(texel(x, z + 1), texel(x + 1, z + 1), f.x), f.y);
      const double want = wave_sum(bins, cascade, gpu::wave_bins / 2, ticks, at);
      miss += std::pow(got - want, 2), size += want * want;
    }
    return std::sqrt(miss / size);
  }
  double variance(int cascade) const {
    double sum = 0.0;
    for (std::size_t at = WaveBins::first(cascade); at < WaveBins::first(cascade + 1); ++at)
      sum += double(glm::dot(bins.bins[at].amplitude, bins.bins[at].amplitude));
    return sum;
  }
  WaveQuality quality;
  WaveBins bins;
  Frame frame;
  WaveImages images;
  std::unique_ptr<WaveCompute> compute;
  std::unique_ptr<Sea> of_upload;
  std::unique_ptr<WaveUpload> upload;

 private:
  Device& device_;
};

std::vector<LabTask> compute_tasks(Device& device, ShaderLibrary& shaders, double wind_mps, const LabOptions& options) {
  std::vector<LabTask> tasks;
  for (const bool on_gpu : {false, true})
    for (const bool half : {false, true})
      for (const int resolution :
           options.quick ? std::vector<int>{16, 32, 64, 128, 256} : std::vector<int>{32, 64, 128, 256, 512}) {
        const auto filled = std::make_shared<Filled>(device, shaders, lab_sea(wind_mps, options),
                                                     WaveQuality{resolution, 5, half}, on_gpu);
        const auto time = std::make_shared<std::int64_t>(ticks_from_seconds(10.0));
        const std::string preset = on_gpu == device.facts().software
                                       ? ""
                                       : presets_with({{"waves.resolution", std::to_string(resolution)},
                                                       {"waves.cascades", "5"},
                                                       {"waves.half_storage", half ? "true" : "false"}});
        tasks.push_back({std::string(on_gpu ? "waves.resolution, compute shaders" : "waves.resolution, processor") +
                             (half ? ", 16 bit" : ""),
                         double(resolution), [=] { filled->run(*time += 11650); }, 1.0,
                         [=] {
                           return std::vector<LabError>{{filled->error(ticks_from_seconds(1e5), options.seed),
                                                         "relative L2 of heights between texels"}};
                         },
                         preset,
                         fmt::format("waves.resolution={} waves.half_storage={} waves.where={}", resolution, half,
                                     on_gpu ? "gpu" : "cpu")});
      }
  return tasks;
}

}  // namespace

std::vector<LabCurve> drawn_curves(Device& device, ShaderLibrary& shaders) {
  const auto of = [&](auto tasks) {
    return [&device, &shaders, tasks](double wind_mps, const LabOptions& options) {
      return tasks(device, shaders, wind_mps, options);
    };
  };
  return {
      {"mesh",
       "Pixels that the mesh may miss",
       "a small frame",
       {{"lod.pixel_error, morphed", false, 1.0, 0.35, 1.0, 8.0,
         "the error is what is asked for, and triangles its inverse square"}},
       true,
       true,
       of(mesh_tasks),
       {},
       "lod.pixel_error, morphed",
       "Presets morph and are compared with what does: masked joins jump where a level changes, which no error of one "
       "picture counts. By lod.threshold the mesh does not ask how high the sea is."},
      {"compute",
       "Waves by the processor and by compute shaders",
       "one update of all tiles",
       {{"waves.resolution, processor", false, -2.0, 0.4, 64.0, 512.0,
         "straight lines between texels are of second order"}},
       true,
       true,
       of(compute_tasks)},
      lever_curve(device, shaders),
      frame_curve(device, shaders),
  };
}

}  // namespace seascape
