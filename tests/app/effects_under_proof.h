// The effects that are proved to be absent where no scene calls for them: a row each.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ocean/inputs/input_spec.h"
#include "tests/support/solid_maker.h"
#include "tests/support/wake_maker.h"

namespace seascape::test {

struct EffectUnderProof {
  std::string name;
  std::vector<std::string> without, with;                     // the scene's effects
  std::vector<std::pair<std::string, std::string>> set = {};  // that let it be seen
  std::pair<std::string, std::string> idle = {};  // a setting by which it is declared but not needed; none: ""
  std::vector<std::uint32_t> bindings = {};       // of the surface's shaders that are its own
  bool variants;                                  // without_NAME and leaking_NAME are built (tests/CMakeLists.txt)
  bool objects;                                   // it has objects of its own, and a pass a frame
  std::string pass = name;                        // that pass, in a frame that moves
  std::vector<InputSpec> inputs = {};             // of the scene, with it or without
  std::string part = name;   // where only a part of the effect is meant: its name among tests and variants
  bool shown = false;        // it is drawn in every frame, whether the clock stands or not
  SceneObjects things = {};  // of the scene, with it or without
  std::shared_ptr<SeaActor> (*actor)() = nullptr;  // who acts on its sea, with it or without
  SceneShapes shapes = {};                         // of the scene, with it or without
  double head_m = 3.0;                             // how high its viewer is
  bool apart = false;  // its code is in pipelines of its own, which only eyes in the water draw
};

inline std::shared_ptr<SeaActor> a_boat() {
  return std::make_shared<WakeMaker>(
      std::vector<WakeMade>{{.at_m = {-3.0, -9.0}, .velocity_mps = {2.0, 0.0}, .length_m = 3.0, .head_m = 0.3}});
}

inline InputSpec pool(InputTarget to, glm::vec4 value) {
  InputSpec spec;
  spec.to = to;
  spec.value = value;
  spec.feather_m = 2.0;
  spec.shape = AreaInput{.round = true, .at_m = {-2.0, -12.0}, .size_m = {12.0, 12.0}};
  return spec;
}

inline InputSpec bank() {
  InputSpec spec = pool(InputTarget::sea_depth, {-0.5f, 0.0f, 0.0f, 0.0f});
  spec.blend = InputBlend::replace;
  spec.feather_m = 0.0;
  return spec;
}

inline InputSpec drum() {
  InputSpec spec;
  spec.to = InputTarget::clip;
  spec.value.x = 1.0f;
  spec.blend = InputBlend::replace;
  spec.shape =
      VolumeInput{.form = VolumeInput::Form::cylinder, .at_m = {5.0, 0.0, -12.0}, .radius_m = 3.0, .length_m = 6.0};
  return spec;
}

inline InputSpec strand() {
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.value = glm::vec4(1.0f);
  spec.feather_m = 3.0;
  spec.shape = SplineInput{.points = {{{-30.0, -14.0}, 24.0, spec.value},
                                      {{0.0, -10.0}, 24.0, spec.value},
                                      {{30.0, -16.0}, 24.0, spec.value}}};
  return spec;
}

inline SceneObjects a_box() {
  SceneObjects objects;
  stand(objects, solid_model(solid_box({0.5f, 0.5f, 0.5f}), "{}"), Pose{{3.0, 0.3, -8.0}});
  return objects;
}

// It reaches out of the water.
inline SceneShapes a_pocket() {
  SceneShapes shapes;
  shapes.air.push_back(
      {.form = gpu::shape_box, .half_m = glm::dvec3(2.0), .radius_m = 4.0, .pose = {{-3.0, 0.0, -9.0}, {}}});
  return shapes;
}

// Away from the view.
inline InputSpec far_pool(InputTarget to, glm::vec4 value) {
  InputSpec spec = pool(to, value);
  std::get<AreaInput>(spec.shape).at_m = {60.0, -90.0};
  return spec;
}

inline const EffectUnderProof effects_under_proof[] = {
    {"models", {"waves"}, {"waves", "models"}, {}, {"", ""}, {}, false, true, "models", {}, "models", true, a_box()},
    {"models",
     {"waves"},
     {"waves", "models"},
     {{"models.seen_in_water", "false"}, {"frame.lighting", "forward"}},
     {"", ""},
     {54},
     true,
     true,
     "models",
     {},
     "sun_map",
     true,
     a_box()},
    {.name = "underwater",
     .without = {"waves"},
     .with = {"waves", "underwater"},
     .set = {{"frame.lighting", "forward"}},
     .variants = false,
     .objects = true,
     .pass = "underwater",
     .shown = true,
     .head_m = -2.0,
     .apart = true},
    {.name = "portals",
     .without = {"waves", "underwater"},
     .with = {"waves", "underwater", "portals"},
     .variants = false,
     .objects = false,
     .shapes = a_pocket()},
    {"waves", {}, {"waves"}, {}, {"", ""}, {1, 2, 3, 9, 10, 11}, false, true, "wave rows"},
    {"foam",
     {"waves"},
     {"waves", "foam"},
     {{"waves.wind_speed_mps", "18"},
      {"foam.simulated", "true"},
      {"foam.resolution", "64"},
      {"foam.levels", "2"},
      {"foam.settle_s", "0.5"}},
     {"foam.breaking", "0"},
     {34, 35},
     true,
     true},
    {"spray",
     {"waves"},
     {"waves", "spray"},
     {{"waves.wind_speed_mps", "23"}, {"waves.chop", "1.5"}, {"spray.range_m", "100"}, {"spray.amount", "4"}},
     {"spray.amount", "0"},
     {},
     false,
     true,
     "spray",
     {},
     "spray",
     true},
    {"baked",
     {"waves"},
     {"waves", "baked"},
     {{"baked.loop", "fresh_sea"}},
     {"baked.weight", "0"},
     {22, 23, 24},
     true,
     true},
    {"gerstner",
     {"waves"},
     {"waves", "gerstner"},
     {{"gerstner.set1_height_m", "0.5"}},
     {"gerstner.set1_height_m", "0"},
     {19, 20, 21},
     true,
     true},
    {"gerstner",
     {"waves"},
     {"waves", "gerstner"},
     {{"gerstner.set1_height_m", "0.5"}, {"gerstner.set1_wavelength_m", "12"}, {"gerstner.set1_shore", "true"}},
     {"gerstner.set1_height_m", "0"},
     {44, 45, 46, 47, 48},
     true,
     true,
     "gerstner",
     {strand()},
     "shore_waves"},
    {"wave_particles",
     {"waves"},
     {"waves", "wave_particles"},
     {{"wave_particles.height_m", "0.2"}},
     {"wave_particles.height_m", "0"},
     {12, 13, 14},
     true,
     true},
    {"dynamic_waves",
     {"waves"},
     {"waves", "dynamic_waves"},
     {{"dynamic_waves.rain_per_m2_s", "0.3"},
      {"dynamic_waves.drop_length_m", "1"},
      {"dynamic_waves.drop_height_m", "0.1"},
      {"dynamic_waves.resolution", "64"},
      {"dynamic_waves.levels", "2"},
      {"dynamic_waves.settle_s", "1"}},
     {"dynamic_waves.rain_per_m2_s", "0"},
     {25, 26},
     true,
     true},
    {"wakes",
     {"waves", "boats"},
     {"waves", "boats", "wakes"},
     {{"wakes.resolution", "64"}, {"wakes.slices", "2"}},
     {"", ""},
     {66},
     true,
     true,
     "wakes",
     {far_pool(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}), drum()},
     "wakes",
     false,
     a_box(),
     a_boat},
    {"level",
     {"waves"},
     {"waves", "level"},
     {},
     {"", ""},
     {27},
     true,
     true,
     "level",
     {pool(InputTarget::level, {1.0f, 0.0f, 0.0f, 0.0f})}},
    {"sea_depth", {"waves"}, {"waves", "sea_depth"}, {}, {"", ""}, {15, 28}, true, true, "sea_depth", {bank()}},
    {"flow",
     {"waves"},
     {"waves", "flow"},
     {{"flow.period_s", "1.7"}},
     {"", ""},
     {29},
     true,
     true,
     "flow",
     {pool(InputTarget::flow, {2.0f, 1.0f, 0.0f, 0.0f})}},
    {"clip",
     {"waves"},
     {"waves", "clip"},
     {},
     {"", ""},
     {30, 38, 39},
     true,
     true,
     "clip",
     {pool(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}), drum()}},
    {"albedo",
     {"waves"},
     {"waves", "albedo"},
     {},
     {"", ""},
     {31},
     true,
     true,
     "albedo",
     {pool(InputTarget::albedo, {0.8f, 0.2f, 0.1f, 0.9f})}},
    {"shadow",
     {"waves"},
     {"waves", "shadow"},
     {},
     {"", ""},
     {32},
     true,
     true,
     "shadow",
     {pool(InputTarget::shadow, {1.0f, 1.0f, 0.0f, 0.0f})}},
};

}  // namespace seascape::test
