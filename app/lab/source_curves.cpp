// Curves of what feeds the sea beside its spectrum: wave particles, recorded loops.
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "app/lab/lab.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

// A field whose only waves are a source's.
struct SourceOnly {
  explicit SourceOnly(std::shared_ptr<const TileSource> source)
      : field(flat(), WaveQuality{16, 1, false}, {std::move(source)}) {}
  static SeaState flat() {
    SeaState sea;
    sea.wind_speed_mps = 0.0;
    return sea;
  }
  void evaluate(std::int64_t ticks) { field.evaluate(ticks, tiles); }
  glm::vec4 at(int x, int z) const {
    const int n = tiles.samples(1);
    return tiles.texels(1, WavePlane::shift, 0)[(z & (n - 1)) * tiles.stride(1, 0) + (x & (n - 1))];
  }
  WaveField field;
  WaveTiles tiles;
};

// A straight front of particles that runs along x.
std::vector<LabTask> particles_tasks(double, const LabOptions&) {
  constexpr int n = WaveParticles::tile_samples;
  constexpr double radius = 8.0, amplitude = 0.01, tiles_per_s = 1.0 / 64.0,
                   time_s = 37.65;  // radius: in texels, as the settings' default has it
  std::vector<LabTask> tasks;
  for (const int count : {32, 40, 48, 64, 96, 128, 256}) {
    std::vector<WaveParticle> list;
    for (int i = 0; i < count; ++i) {
      WaveParticle p;
      p.x = 0x40000000u;
      p.z = std::uint32_t(std::ldexp(double(i) / count, 32));
      p.turns_x = std::uint64_t(std::llround(std::ldexp(tiles_per_s, 64) / double(gpu::ticks_per_second)));
      list.push_back(p);
    }
    const auto drawn =
        std::make_shared<SourceOnly>(std::make_shared<WaveParticles>(WaveParticleSettings{}, list, amplitude));
    const auto errors = [=]() -> std::vector<LabError> {
      // d'Alembert: the profile of infinitely many particles of as much height, moved by c t; the tile's mean is 0, the
      // front's is not.
      const double spacing = double(n) / count,
                   mean = amplitude * count * particle_volume * radius * radius / (double(n) * n);
      const auto profile = [&](double off) {
        constexpr int steps = 400;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
          const double u = std::hypot(off, radius * ((i + 0.5) * 2.0 / steps - 1.0)) / radius;
          sum += u < 1.0 ? 0.5 * (1.0 + std::cos(pi * u)) : 0.0;
        }
        return amplitude * sum * 2.0 * radius / steps / spacing;
      };
      double miss = 0.0, size = 0.0;
      const double crest = n / 4.0 + std::fmod(tiles_per_s * time_s * n, double(n));
      for (int x = int(crest) - 10; x <= int(crest) + 11; ++x) {
        const double want = profile(x - crest);
        for (int z = 0; z < n; ++z) miss += std::pow(double(drawn->at(x, z).y) + mean - want, 2) / n;
        size += want * want;
      }
      return {{std::sqrt(miss / size), "relative L2 to d'Alembert"}};
    };
    tasks.push_back({"particles a radius of the front", count * radius / n,
                     [=] { drawn->evaluate(ticks_from_seconds(time_s)); }, 1.0, errors, "", ""});
  }
  return tasks;
}

// ---- recorded loops

std::shared_ptr<SourceOnly> recorded(const SeaState& sea, const LoopRequest& request) {
  LoopRecorder recorder(sea, request);
  const LoopRequest& r = recorder.request();
  BakedLoop loop{r.samples, r.frames, r.fps, r.side_m, {}};
  loop.texels.resize(loop.frame_floats() * std::size_t(r.frames));
  for (int frame = 0; frame < r.frames; ++frame)
    recorder.record(frame,
                    std::span(loop.texels).subspan(std::size_t(frame) * loop.frame_floats(), loop.frame_floats()));
  return std::make_shared<SourceOnly>(std::make_shared<Baked>(std::move(loop), BakedSettings{}));
}

std::vector<LabTask> baked_tasks(double wind_mps, const LabOptions& options) {
  const SeaState sea = lab_sea(wind_mps, options);
  const double peak_s = std::sqrt(2.0 * pi * longest_peak_wave_m(sea) / sea.gravity_mps2);
  // `finest`: frames a peak period of the truth, a multiple of every rate below; at its own frames a loop is what was
  // recorded.
  constexpr int samples = 64, periods = 4, finest = 96;
  const auto request = [&](int loop_periods, int rate) {
    return LoopRequest{loop_periods * rate, rate / peak_s, samples, 0.0};
  };
  const std::shared_ptr<SourceOnly> truth = recorded(sea, request(periods, finest));
  std::vector<LabTask> tasks;
  for (const int rate : {2, 3, 4, 6, 8, 12, 16}) {
    const std::shared_ptr<SourceOnly> drawn = recorded(sea, request(periods, rate));
    const auto errors = [=]() -> std::vector<LabError> {
      std::mt19937 random(options.seed);
      double miss = 0.0, size = 0.0;
      for (int i = 0; i < 12; ++i) {
        const int frame = int(random() % unsigned(periods * finest));
        if (frame % (finest / rate) == 0) continue;  // it has this one
        truth->evaluate(ticks_from_seconds(frame * peak_s / finest));
        drawn->evaluate(ticks_from_seconds(frame * peak_s / finest));
        for (int z = 0; z < samples; ++z)
          for (int x = 0; x < samples; ++x) {
            const double want = double(truth->at(x, z).y);
            miss += std::pow(double(drawn->at(x, z).y) - want, 2), size += want * want;
          }
      }
      return {{std::sqrt(miss / size), "of the heights, rms"},
              {double(periods * rate) * 3.0 * samples * samples * sizeof(float) / 1048576.0, "MiB"},
              {periods * peak_s, "s, after which it repeats"}};
    };
    tasks.push_back({"frames a peak period, played", double(rate),
                     [=] { drawn->evaluate(ticks_from_seconds(0.37 * peak_s)); }, 1.0, errors, "", ""});
  }
  for (const int loop_periods : {2, 4, 8, 16, 32}) {
    const auto recorder = std::make_shared<LoopRecorder>(sea, request(loop_periods, 8));
    const auto frame = std::make_shared<std::vector<float>>(3 * samples * samples);
    tasks.push_back({"peak periods in the loop (time: a frame at run time)", double(loop_periods),
                     [=] { recorder->record(1, *frame); }, 1.0,
                     [=] {
                       return std::vector<LabError>{{recorder->frequency_error(), "of frequencies, rms"}};
                     },
                     "", ""});
  }
  return tasks;
}

}  // namespace

std::vector<LabCurve> source_curves() {
  return {
      {"particles",
       "Wave particles against d'Alembert",
       "one evaluation of the tile",
       {},
       false,
       false,
       particles_tasks},
      {"baked",
       "Recorded loops against waves at run time",
       "one evaluation of the tile",
       {{"frames a peak period, played", false, -6.0, 0.6, 8.0, 16.0,
         "Lagrange's polynomial through six frames is of sixth order"},
        {"peak periods in the loop", false, -1.0, 0.25, 2.0, 32.0,
         "frequencies are rounded to whole turns of the loop"}},
       true,
       false,
       baked_tasks},
  };
}

}  // namespace seascape
