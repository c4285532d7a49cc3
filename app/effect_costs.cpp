#include "app/effect_costs.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "app/frame.h"
#include "engine/error.h"
#include "ocean/effects.h"
#include "platform/headless.h"

namespace seascape {

namespace {

using Clock = std::chrono::steady_clock;

Cost held(const Device& device) {
  Cost cost;
  for (const ObjectRecord& object : device.objects()) {
    if (object.type == VK_OBJECT_TYPE_IMAGE || object.type == VK_OBJECT_TYPE_BUFFER)
      cost.bytes += std::int64_t(object.bytes);
    if (object.type == VK_OBJECT_TYPE_SHADER_MODULE) cost.words += std::int64_t(object.bytes / 4);
    cost.pipelines += object.type == VK_OBJECT_TYPE_PIPELINE;
  }
  return cost;
}

Cost less(Cost a, const Cost& b) {
  a.bytes -= b.bytes;
  a.passes -= b.passes;
  a.draws -= b.draws;
  a.dispatches -= b.dispatches;
  a.pipelines -= b.pipelines;
  a.words -= b.words;
  return a;
}

// The named effects and what they need, in the order of effect_names(), so that equal sets are equal lists.
std::vector<std::string> set_of(const std::vector<std::string>& named) {
  std::vector<std::string> set;
  const std::vector<EffectEntry> entries = closure(named);
  for (const std::string_view name : effect_names())
    if (std::any_of(entries.begin(), entries.end(), [&](const EffectEntry& e) { return e.name == name; }))
      set.emplace_back(name);
  return set;
}

Scene with_effects(const Scene& scene, const std::vector<std::string>& effects) {
  Scene other = scene;
  other.effects = effects;
  return other;
}

struct Question {
  std::string effect, beside;
  std::vector<std::string> with, without;
};

std::vector<Question> questions_of(const std::vector<std::string>& effects) {
  std::vector<Question> questions;
  const auto ask = [&](const std::string& effect, const std::string& beside, std::vector<std::string> others) {
    const std::vector<std::string> without = set_of(others);
    if (std::find(without.begin(), without.end(), effect) != without.end()) return;
    others.push_back(effect);
    questions.push_back({effect, beside, set_of(others), without});
  };
  for (const std::string& effect : effects) {
    ask(effect, beside_nothing, {});
    for (const std::string& other : effects)
      if (other != effect) ask(effect, other, {other});
    std::vector<std::string> others = effects;
    std::erase(others, effect);
    ask(effect, beside_all_others, others);
  }
  return questions;
}

}  // namespace

CostSubject::CostSubject(Device& device, ShaderLibrary& shaders, const Scene& scene, const ExperienceOptions& options)
    : device_(device), before_(held(device)), experience_(device, shaders, scene, options) {
  draw_ms(0);
  draw_ms(1);
  holds_ = less(held(device), before_);
  const FrameCounts& counts = experience_.frame().counts();
  holds_.passes = std::int64_t(counts.passes);
  holds_.draws = std::int64_t(counts.draws);
  holds_.dispatches = std::int64_t(counts.dispatches);
}

double CostSubject::draw_ms(int n) {
  const Scene& scene = experience_.scene();
  return draw_ms(scene.start, scene.settings.time_start_s + n / 30.0);
}

double CostSubject::draw_ms(const Pose& from, double time_s, double pixels_per_radian) {
  const Scene& scene = experience_.scene();
  HeadlessOptions shown;
  shown.width = experience_.options().width;
  shown.height = experience_.options().height;
  shown.views = experience_.options().views;
  shown.vertical_fov_deg = scene.settings.render.vertical_fov_deg;
  shown.eye_distance_m = scene.settings.render.eye_distance_m;
  Headless display(shown);
  Frame& frame = experience_.frame();
  const Clock::time_point start = Clock::now();
  display.begin();
  frame.begin();
  Viewpoint seen = display.viewpoint(from);
  if (pixels_per_radian > 0.0) seen.pixels_per_radian = pixels_per_radian;
  draw_frame(experience_, frame, seen, time_s);
  display.end(frame, &experience_.picture());
  frame.finish();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Cost difference(const MakeSubject& make_with, const MakeSubject& make_without, int frames, int rounds) {
  Cost cost;
  std::vector<double> ms;
  for (int round = 0; round < rounds; ++round) {
    const bool with_first = round % 2 == 0;
    std::unique_ptr<CostSubject> with, without;
    if (with_first) with = make_with();
    without = make_without();
    if (!with_first) with = make_with();
    cost = less(with->holds(), without->holds());
    for (int n = 0; n < frames; ++n) {
      const bool first =
          n % 2 == 0;  // whatever a frame leaves to the next in the machine's caches, either leaves it as often
      const double a = (first ? *with : *without).draw_ms(n + 2), b = (first ? *without : *with).draw_ms(n + 2);
      ms.push_back(first ? a - b : b - a);
    }
  }
  cost.ms = median_interval(ms);
  return cost;
}

CostMatrix measure_costs(Device& device, ShaderLibrary& shaders, const Scene& scene,
                         const std::vector<std::string>& effects, const ExperienceOptions& options,
                         const std::string& preset, int frames,
                         const std::function<void(std::size_t, std::size_t)>& step) {
  CostMatrix matrix;
  matrix.scene = scene.name;
  matrix.preset = preset;
  matrix.device = device.facts().name;
  matrix.width = int(options.width);
  matrix.height = int(options.height);
  matrix.views = options.views;
  matrix.frames = frames;
  for (const std::string& effect : effects) try {
      const std::vector<std::string> with = set_of({effect});
      std::vector<std::string> needs = with;
      std::erase(needs, effect);
      const Cost own = less(CostSubject(device, shaders, with_effects(scene, with), options).holds(),
                            CostSubject(device, shaders, with_effects(scene, needs), options).holds());
      if (own.bytes != 0 || own.passes != 0 || own.draws != 0 || own.dispatches != 0 || own.pipelines != 0 ||
          own.words != 0)
        matrix.effects.push_back(effect);
      else
        spdlog::info("the matrix leaves {} out, which has nothing to do in {}", effect, scene.name);
    } catch (const Error& fault) {
      spdlog::warn("the matrix leaves {} out, for which {} has no settings: {}", effect, scene.name, fault.what());
    }
  const std::vector<Question> questions = questions_of(matrix.effects);
  for (std::size_t q = 0; q < questions.size(); ++q) {
    const Question& asked = questions[q];
    const auto same = std::find_if(questions.begin(), questions.begin() + std::ptrdiff_t(q), [&](const Question& o) {
      return o.with == asked.with && o.without == asked.without;
    });
    if (same != questions.begin() + std::ptrdiff_t(q)) {  // of two effects one is all others
      matrix.cells.push_back({asked.effect, asked.beside, matrix.cells[std::size_t(same - questions.begin())].cost});
    } else {
      const auto maker = [&](const std::vector<std::string>& set) {
        return [&] { return std::make_unique<CostSubject>(device, shaders, with_effects(scene, set), options); };
      };
      matrix.cells.push_back(
          {asked.effect, asked.beside, difference(maker(asked.with), maker(asked.without), frames, 2)});
    }
    step(q + 1, questions.size());
  }
  return matrix;
}

}  // namespace seascape
