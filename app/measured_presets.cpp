#include "app/measured_presets.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>

#include "app/boats/path_on_body.h"
#include "app/effect_costs.h"
#include "app/lab/flip.h"
#include "app/lab/picture_error.h"
#include "app/program.h"
#include "app/sea_time.h"
#include "app/statistics.h"

namespace seascape {

namespace {

constexpr int finer = 2;                  // the truth's pixels a pixel's side
constexpr double least_ms = 0.02;         // what takes less at every preset has no row
constexpr double frames_a_second = 30.0;  // of the path
constexpr double mebibyte = 1048576.0;
constexpr const char *gpu_times = "GPU: ", *cpu_times = "CPU: ";

struct Shot {
  Pose from;
  double time_s;
};

std::vector<Shot> shots_of(const Scene& scene) {
  std::vector<Shot> shots;
  for (const double turn_deg : {0.0, 130.0})
    shots.push_back({{scene.start.position_m,
                      glm::angleAxis(glm::radians(turn_deg), glm::dvec3(0.0, 1.0, 0.0)) * scene.start.orientation},
                     scene.settings.time_start_s + 2.0 / 30.0});
  return shots;
}

std::vector<Image8> pictures(Device& device, CostSubject& subject, const std::vector<Shot>& shots, int smaller) {
  std::vector<Image8> all;
  for (const Shot& shot : shots) {
    subject.draw_ms(shot.from, shot.time_s);
    const Image8 picture = picture_of(device, subject.experience(), 0);
    all.push_back(smaller > 1 ? averaged(picture, smaller) : picture);
  }
  return all;
}

// Times by name, those of one name in a frame together; the GPU's first, in the order in which they are first met.
class TimesByName {
 public:
  template <class Times>
  void add(const std::string& of, const Times& times, std::size_t preset) {
    std::map<std::string, double> sums;
    for (const auto& time : times) {
      const std::string name = of + time.name;
      if (!sums.contains(name) && std::find(order_.begin(), order_.end(), name) == order_.end()) order_.push_back(name);
      sums[name] += time.ms;
    }
    for (const auto& [name, ms] : sums) of_[name][preset].push_back(ms);
  }
  // With a median for every preset, 0 of what it has not in half of its frames.
  void rows(std::vector<PresetCost>& to, std::size_t frames) const {
    for (const char* of : {gpu_times, cpu_times})
      for (const std::string& name : order_) {
        if (!name.starts_with(of)) continue;
        PresetCost row{name, "ms", {}};
        for (std::size_t p = 0; p < row.of.size(); ++p) {
          std::vector<double> ms = of_.at(name)[p];
          ms.resize(frames, 0.0);
          row.of[p] = summarise(ms).median;
        }
        if (*std::max_element(row.of.begin(), row.of.end()) >= least_ms) to.push_back(row);
      }
  }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::array<std::vector<double>, 4>> of_;
};

}  // namespace

PresetCosts measure_presets(Device& device, ShaderLibrary& shaders, const std::array<Scene, 4>& scenes,
                            const ExperienceOptions& options, const CameraPath* path, int frames,
                            const std::function<void(std::size_t, std::size_t)>& step) {
  const std::size_t all = std::size_t(frames) + 2 * scenes.size() + 1;
  std::size_t done = 0;
  PresetCosts costs;
  costs.scene = scenes[0].name;
  costs.device = device.facts().name;
  costs.width = int(options.width);
  costs.height = int(options.height);
  costs.views = options.views;
  costs.frames = frames;

  const std::vector<Shot> shots = shots_of(scenes[0]);
  std::vector<Image8> truth;
  {
    Scene best = scenes[3];
    best.settings.render.msaa = 4;
    ExperienceOptions large = options;
    large.width *= finer, large.height *= finer;
    CostSubject subject(device, shaders, best, large);
    truth = pictures(device, subject, shots, finer);
    step(++done, all);
  }
  std::array<std::unique_ptr<CostSubject>, 4> subjects;
  PresetCost error{std::string(error_row), "", {}}, bytes{"device memory", "MiB", {}},
      moved{"moved by attachments and copies", "MiB", {}};
  for (std::size_t p = 0; p < scenes.size(); ++p) {
    subjects[p] = std::make_unique<CostSubject>(device, shaders, scenes[p], options);
    step(++done, all);
    const std::vector<Image8> drawn = pictures(device, *subjects[p], shots, 1);
    const double pixels_a_degree = options.height / scenes[p].settings.render.vertical_fov_deg;
    for (std::size_t s = 0; s < shots.size(); ++s)
      error.of[p] += flip_error(drawn[s], truth[s], pixels_a_degree).mean / double(shots.size());
    subjects[p]->draw_ms(2);
    const FrameCounts& counts = subjects[p]->experience().frame().counts();
    bytes.of[p] = double(subjects[p]->holds().bytes) / mebibyte;
    moved.of[p] = double(counts.moved.loaded + counts.moved.stored + counts.moved.copied) / mebibyte;
    step(++done, all);
  }

  std::array<std::vector<double>, 4> whole, gpu, draws, triangles;
  TimesByName times;
  std::array<glm::dvec3, 4> viewers_m;
  viewers_m.fill(path != nullptr ? path->at(0.0).pose.position_m : scenes[0].start.position_m);
  for (int n = 0; n < frames; ++n) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const std::size_t p = (i + std::size_t(n)) % subjects.size();  // each as often after each other
      if (path == nullptr) {
        whole[p].push_back(subjects[p]->draw_ms(n + 3));
      } else {
        const PathSample sample = path->at(n / frames_a_second);
        const double time_s = sea_time_s(scenes[p].settings, sample.scene_time_s);
        const Pose pose = pose_in_world(subjects[p]->experience(), *path, sample, time_s, viewers_m[p]);
        viewers_m[p] = pose.position_m;
        whole[p].push_back(subjects[p]->draw_ms(pose, time_s));
      }
      const Frame& frame = subjects[p]->experience().frame();
      draws[p].push_back(double(frame.counts().draws));
      triangles[p].push_back(double(frame.counts().triangles));
      if (device.facts().timestamps) gpu[p].push_back(frame.gpu_ms());
      times.add(gpu_times, frame.times(), p);
      times.add(cpu_times, frame.stages().times(), p);
    }
    step(++done, all);
  }
  const auto row = [&](std::string_view what, const char* unit, const std::array<std::vector<double>, 4>& of,
                       double Summary::*part) {
    PresetCost made{std::string(what), unit, {}};
    for (std::size_t p = 0; p < of.size(); ++p) made.of[p] = summarise(of[p]).*part;
    costs.rows.push_back(made);
  };
  costs.rows.push_back(error);
  row(frame_row, "ms", whole, &Summary::median);
  row("the same, p99", "ms", whole, &Summary::p99);
  if (device.facts().timestamps) {
    row(gpu_row, "ms", gpu, &Summary::median);
    row("GPU, p99", "ms", gpu, &Summary::p99);
  }
  times.rows(costs.rows, std::size_t(frames));
  costs.rows.push_back(bytes);
  costs.rows.push_back(moved);
  row("draws", "", draws, &Summary::median);
  row("draws, most", "", draws, &Summary::max);
  row("triangles", "", triangles, &Summary::median);
  row("triangles, most", "", triangles, &Summary::max);
  return costs;
}

}  // namespace seascape
