#include "app/experience.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/boats/line_shape.h"
#include "app/place_inputs.h"
#include "app/sea_remarks.h"
#include "app/sea_spec.h"
#include "engine/multiview_check.h"
#include "ocean/effects.h"

namespace seascape {

namespace {

// Whether two settings differ in what the running sea can grow into.
bool needs_change(const Settings& a, const Settings& b) {
  for (const Setting& row : settings_table())
    if (row.grows && value_of(a, row) != value_of(b, row)) return true;
  return false;
}

// A depth with a stencil beside it is nothing that can be shown: it is kept, to be copied into what is.
bool keeps_depth(const TargetSpec& spec) { return spec.show_depth && spec.stencil && spec.samples == 1; }

bool is_debug(const Settings& s) { return s.render.debug != DebugView::none; }

// Whether two settings differ in something that GPU objects were built from.
bool needs_rebuild(const Settings& a, const Settings& b, bool sea_at_once) {
  const RenderSettings &r = a.render, &q = b.render;
  Settings x = a;  // compare what the table marks: rows with `rebuild`
  Settings y = b;
  for (const Setting& row : settings_table())
    if (!row.rebuild.empty() && (sea_at_once || !row.grows) && value_of(x, row) != value_of(y, row)) return true;
  return r.msaa != q.msaa || r.shape != q.shape || is_debug(a) != is_debug(b) ||
         (r.debug == DebugView::wireframe) != (q.debug == DebugView::wireframe) ||
         (r.debug == DebugView::holes) != (q.debug == DebugView::holes);
}

}  // namespace

bool draw_per_eye(Device& device, ShaderLibrary& shaders, StereoMode mode, int views) {
  if (views < 2) return mode == StereoMode::per_eye;
  if (mode == StereoMode::per_eye) return true;
  if (multiview_known_to_work(device, shaders)) return false;
  if (mode == StereoMode::single) {
    spdlog::warn("{} ({}) draws multiview passes wrongly; --stereo single uses them all the same", device.facts().name,
                 device.facts().driver);
    return false;
  }
  spdlog::warn("{} ({}) draws multiview passes wrongly: drawing a pass per eye instead; a newer driver is faster",
               device.facts().name, device.facts().driver);
  return true;
}

Experience::Experience(Device& device, ShaderLibrary& shaders, const Scene& scene, const ExperienceOptions& options,
                       std::shared_ptr<Sea> sea)
    : device_(device),
      shaders_(shaders),
      scene_(scene),
      options_(options),
      frame_(std::make_unique<Frame>(device)),
      sea_(std::move(sea)) {
  if (sea_ != nullptr) sea_key_ = sea_key(scene_);
  sky_ = std::make_unique<Sky>(device, shaders);
  build();
  told_ = remarks_of(scene_);  // by who read the scene
}

bool Experience::under_water() const {
  return std::any_of(eyes_depth_m_.begin(), eyes_depth_m_.end(),
                     [](const std::optional<double>& depth_m) { return depth_m && *depth_m > 0.0; });
}

Experience::~Experience() {
  if (before_build_) before_build_();
}

void Experience::tell_remarks() {
  std::vector<std::string> remarks = remarks_of(scene_);
  for (const std::string& remark : remarks)
    if (std::find(told_.begin(), told_.end(), remark) == told_.end()) spdlog::warn("{}", remark);
  told_ = std::move(remarks);
}

void Experience::reload_shaders() {
  if (!shaders_.reload()) return;
  if (before_build_) before_build_();
  sky_ = std::make_unique<Sky>(device_, shaders_);
  build();
}

bool Experience::in_tile() const {
  const FrameShape shape = scene_.settings.render.shape;
  return shape == FrameShape::tile || (shape == FrameShape::automatic && !options_.linear_picture);
}

// Where pixels are lit by a CPU, one that several small triangles touch costs several times its light: measured in
// docs/performance.md.
bool Experience::deferred() const {
  const RenderSettings& render = scene_.settings.render;
  if (render.msaa > 1 || (is_debug(scene_.settings) && render.debug != DebugView::holes))
    return false;  // the others colour triangles
  return render.lighting == Lighting::deferred || (render.lighting == Lighting::automatic && device_.facts().software);
}

void Experience::show_hands(std::vector<ShownHand> hands) {
  assert(options_.hands);
  shown_hands_ = std::move(hands);
}

void Experience::show_aim(const std::optional<ShownAim>& aim) {
  assert(options_.hands);
  shown_aim_ = aim;
}

void Experience::show_comfort(const ComfortShown& shown) {
  assert(options_.comfort);
  comfort_shown_ = shown;
}

void Experience::hide(const HiddenMesh& mesh) {
  assert(options_.hidden);
  if (mesh.version != hidden_mesh_.version) hidden_mesh_ = mesh;
}

void Experience::go_on() {
  goes_on_ = true;
  sea_->go_on();
}

void Experience::build() {
  if (before_build_) before_build_();
  ++builds_;
  RenderSettings& render = scene_.settings.render;
  int samples = render.msaa;  // software drivers have 1 and 4 but not 2
  while (samples > 1 && !(device_.facts().sample_counts & std::uint32_t(samples))) samples /= 2;
  if (samples != render.msaa) {
    spdlog::warn("msaa {}: {} has not that many; using {}", render.msaa, device_.facts().name, samples);
    render.msaa = samples;
  }
  if (render.lighting == Lighting::deferred && !deferred())
    spdlog::warn("frame.lighting deferred: takes msaa 1 and no debug.view but holes; the sea is lit forward");
  const Settings& s = scene_.settings;
  // Debug views but for holes colour the sea's triangles.
  underwater_ = calls_for(scene_.effects, "underwater") && (!is_debug(s) || render.debug == DebugView::holes);
  shaped_ = underwater_ && calls_for(scene_.effects, "portals") && !scene_.shapes.empty();
  std::string key = sea_key(scene_);
  SeaSpec spec = sea_spec(scene_);  // what it cannot make leaves the old ocean
  std::shared_ptr<Sea> sea = sea_;
  if (sea == nullptr || key != sea_key_) sea = std::make_shared<Sea>(spec);
  OceanState before = ocean_ != nullptr && sea == sea_ ? ocean_->give_up() : OceanState{};
  ocean_.reset();
  sea->draw_in(spec.drawn, spec.place.settings);
  sea->know_velocity(SeaDetail::crests, spec.crests_velocity);
  sea_ = std::move(sea);
  sea_key_ = std::move(key);
  if (goes_on_) sea_->go_on();
  join_bodies();
  ocean_ = std::make_unique<Ocean>(
      device_, shaders_, *sea_,
      OceanSettings{s.wave_place, s.lod, s.water, s.place, foam_spec(scene_), s.baked.fade_m,
                    calls_for(scene_.effects, "spray") && !is_debug(s) ? std::optional(s.spray) : std::nullopt,
                    options_.seen_elsewhere},
      std::move(before));
  build_targets();
  const bool tile = in_tile();
  const RenderTarget& drawn = tile ? picture_ : lit_;
  SurfaceLook look;
  look.tile_shape = tile;
  look.foam = calls_for(scene_.effects, "foam");
  look.debug = is_debug(s);
  look.wireframe = render.debug == DebugView::wireframe;
  look.deferred = deferred();
  look.probe = options_.probe;
  look.hidden = options_.hidden;
  look.solids = calls_for(scene_.effects, "models") && !scene_.objects.empty();
  look.below = look.solids && s.models.seen_in_water;
  look.underwater = underwater();
  if (shaped()) look.shapes = {int(scene_.shapes.air.size()), int(scene_.shapes.portals.size())};
  look.anisotropy = std::min(float(s.water.anisotropy), device_.facts().max_anisotropy);
  SurfaceLight light{&frame_->ring(), sky_->map().view(), sky_->sampler(), &sky_->light()};
  sun_map_.reset();
  if (look.solids && s.models.shadow_texels > 0) {
    sun_map_ = std::make_unique<SunMap>(device_, s.models.shadow_texels);
    light.sun_map = sun_map_->target().depth()->view();
    light.sun_map_sampler = sun_map_->sampler();
  }
  lens_.reset();  // which draws with the surface
  surface_ = std::make_unique<Surface>(device_, shaders_, drawn, ocean_->pieces(), light, look);
  make_solids(drawn, light, look);
  spray_.reset();
  if (ocean_->spray())
    spray_ = std::make_unique<DrawnSpray>(device_, shaders_, drawn, light, s.spray.most,
                                          SprayLook{tile, surface_->depths()});
  bubbles_.reset();
  eyes_depth_m_ = {};
  const BubbleLook bubbles{tile, surface_->depths(), surface_->sides()};
  if (underwater()) bubbles_ = std::make_unique<DrawnBubbles>(device_, shaders_, drawn, light, bubbles);
  if (look.underwater) lens_ = std::make_unique<DrawnLens>(device_, shaders_, drawn, *surface_, tile);
  hands_.reset();
  if (options_.hands) hands_ = std::make_unique<DrawnHands>(device_, shaders_, drawn, light, tile, surface_->depths());
  comfort_.reset();
  if (options_.comfort) comfort_ = std::make_unique<ComfortOverlay>(device_, shaders_, picture_, frame_->ring());
  hidden_area_.reset();
  if (options_.hidden)
    hidden_area_ = std::make_unique<HiddenArea>(device_, shaders_, surface_->target(drawn), picture_, look.deferred);
  make_sky(drawn, look);
  tone_pipeline_ = {};
  if (!tile) {
    const EffectScope tone_scope(device_, "frame");
    GraphicsSpec tone;
    tone.vertex = "sky.vert";
    tone.fragment = "tone.frag";
    tone.values = {
        {gpu::value_multiview, !options_.per_eye}, {gpu::value_debug, look.debug}, {gpu::value_sky_ray, false}};
    tone.depth_test = tone.depth_write = false;
    tone_pipeline_ = make_graphics_pipeline(device_, shaders_, picture_, tone);
    lit_sampler_ = make_sampler(device_, "lit", {false, false, 1.0f});
    bind_tone();
  }
  shown_depth_.reset();
  if (const Image* kept = kept_depth())
    shown_depth_ = std::make_unique<ShownDepth>(device_, shaders_, *kept, picture_.spec(), lent_.get());
  set_area();
}

// Bodies stay where they are while their effect is off, and go on from there in whatever sea there is then.
void Experience::join_bodies() {
  if (bodies_ == nullptr) bodies_ = scene_bodies(scene_);
  if (bodies_ != nullptr && boat_shapes_ == nullptr) {
    if (add_line_things(scene_.objects, *bodies_)) loaded_models_.reset();  // there are more
    boat_shapes_ = std::make_unique<BoatShapes>(scene_.objects);
  }
  const std::shared_ptr<Sea> before = sea_of_bodies_.lock();
  const std::shared_ptr<Sea> now = bodies_ != nullptr && calls_for(scene_.effects, "boats") ? sea_ : nullptr;
  if (bodies_ != nullptr) bodies_->take(body_media(scene_.settings));
  if (before == now) return;
  if (before != nullptr) before->take_away(*bodies_);
  if (now == nullptr) bodies_->hold();
  if (now != nullptr) now->add(bodies_);
  sea_of_bodies_ = now;
}

SolidSources Experience::solid_sources() const {
  const SceneObjects& objects = scene_.objects;
  return {objects.models, objects.things, objects.lines ? &objects.lines->drawn : nullptr, loaded_models_.get(),
          solid_surroundings_.get()};
}

void Experience::make_solids(const RenderTarget& drawn, const SurfaceLight& light, const SurfaceLook& look) {
  solids_.reset();
  solid_surroundings_.reset();
  if (!look.solids) {
    loaded_models_.reset();
    return;
  }
  const bool blocks = scene_.settings.models.block_textures;
  if (loaded_models_ == nullptr || !loaded_models_->serves(blocks)) {
    loaded_models_.reset();
    loaded_models_ = std::make_unique<LoadedModels>(device_, scene_.objects.models, blocks);
  }
  solid_surroundings_ = std::make_unique<SolidSurroundings>(device_, shaders_, light);
  solids_ = std::make_unique<DrawnSolids>(
      device_, shaders_, drawn, light, solid_sources(),
      SolidLook{look.tile_shape, look.deferred ? &surface_->target(drawn) : nullptr, surface_->depths(),
                look.below ? &surface_->below() : nullptr,
                look.below && look.underwater && device_.facts().clip_distances ? &surface_->above() : nullptr,
                look.anisotropy, look.underwater, look.shapes, sun_map_.get()});
}

void Experience::bind_tone() {
  tone_bindings_ =
      Bindings(device_, tone_pipeline_,
               {{.binding = gpu::slot_frame, .buffer = &frame_->ring(), .range = sizeof(gpu::FrameData)},
                {.binding = gpu::slot_lit_picture, .view = lit_.colour().view(), .sampler = lit_sampler_.get()}},
               "tone");
}

void Experience::build_targets() {
  const RenderSettings& render = scene_.settings.render;
  const bool tile = in_tile();
  TargetSpec spec;
  spec.width = std::max(options_.width, options_.most_width);
  spec.height = std::max(options_.height, options_.most_height);
  spec.views = options_.views;
  spec.per_eye = options_.per_eye;
  spec.samples = tile ? render.msaa : 1;
  spec.depth = tile && !deferred();
  spec.stencil = spec.depth && underwater();
  spec.show_depth = options_.show_depth;
  spec.keep_depth = keeps_depth(spec);
  spec.colour = options_.colour;
  picture_ = {};
  lit_ = {};
  picture_ = RenderTarget(device_, "picture", spec, lent_.get());
  if (!tile) {
    LentImages depths;
    if (lent_) depths = {lent_->width, lent_->height, {}, lent_->depths};
    spec.colour = VK_FORMAT_R16G16B16A16_SFLOAT;
    spec.samples = render.msaa;
    spec.depth = !deferred();
    spec.stencil = spec.depth && underwater();
    spec.keep_depth = keeps_depth(spec);
    lit_ = RenderTarget(device_, "lit", spec, lent_ ? &depths : nullptr);
  }
}

// The depth of the pass that draws all, where that is not what is shown; null where it is, or nothing is.
const Image* Experience::kept_depth() const {
  if (!options_.show_depth) return nullptr;
  if (deferred()) return surface_->depths();
  const RenderTarget& drawn = in_tile() ? picture_ : lit_;
  return drawn.spec().keep_depth ? drawn.depth() : nullptr;
}

// Everything is drawn into the upper left part of what there is room for.
Lowered Experience::lowered() const {
  const double anisotropy = std::min(scene_.settings.water.anisotropy, double(device_.facts().max_anisotropy));
  return {.models = solids_ != nullptr,
          .spray = spray_ != nullptr,
          .shadows = sun_map_ != nullptr,
          .foam = ocean_->foam() != nullptr,
          .anisotropic = anisotropy > 1.0};
}

void Experience::set_area() {
  picture_.set_area(options_.width, options_.height);
  if (!in_tile()) lit_.set_area(options_.width, options_.height);
  surface_->set_area(options_.width, options_.height);
  if (shown_depth_) shown_depth_->set_area(options_.width, options_.height);
}

void Experience::take_targets() {
  surface_->resize(in_tile() ? picture_ : lit_);
  if (spray_) spray_->resize(surface_->depths());
  if (bubbles_) bubbles_->resize(surface_->depths(), surface_->sides());
  if (solids_) solids_->resize(surface_->depths());
  if (hands_) hands_->resize(surface_->depths());
  if (lens_) lens_->resize();
  if (tone_pipeline_) bind_tone();
  if (shown_depth_) shown_depth_->resize(*kept_depth(), picture_.spec(), lent_.get());
  set_area();
}

void Experience::resize(std::uint32_t width, std::uint32_t height, const glm::uvec2& room) {
  const bool other_room = room.x > 0 && room.y > 0 && room != glm::uvec2(options_.most_width, options_.most_height);
  if (other_room) {
    options_.most_width = room.x;
    options_.most_height = room.y;
  }
  if (!other_room && width == options_.width && height == options_.height) return;
  options_.width = width;
  options_.height = height;
  if (!other_room && width <= options_.most_width && height <= options_.most_height) {
    set_area();
    return;
  }
  build_targets();
  take_targets();
}

void Experience::draw_into(std::shared_ptr<const LentImages> lent) {
  if (lent == lent_) return;
  lent_ = std::move(lent);
  build_targets();
  take_targets();
}

void Experience::choose(std::size_t colour, std::size_t depth) {
  picture_.choose(colour, depth);
  if (!in_tile()) lit_.choose(0, depth);
  if (shown_depth_) shown_depth_->choose(depth);
}

const Image* Experience::shown_depth() const {
  if (shown_depth_) return shown_depth_->depth();
  return (in_tile() ? picture_ : lit_).shown_depth();
}

void Experience::apply_effects(const std::vector<std::string>& effects) {
  if (effects == scene_.effects) return;
  std::vector<std::string> before = std::exchange(scene_.effects, effects);
  try {
    (void)sea_spec(scene_);  // whose settings may not go together
  } catch (...) {
    scene_.effects = std::move(before);
    throw;
  }
  build();
  tell_remarks();
}

void Experience::apply(const Settings& settings, bool sea_at_once) {
  const bool at_once = sea_at_once || settings.sea_change_s <= 0.0;
  const bool rebuild = needs_rebuild(scene_.settings, settings, at_once),
             change = needs_change(scene_.settings, settings);
  const Settings before = std::exchange(scene_.settings, settings);
  OceanSettings drawn = ocean_->settings();
  drawn.lod = settings.lod;
  drawn.water = settings.water;
  drawn.place = settings.place;
  drawn.baked_fade_m = settings.baked.fade_m;
  if (drawn.foam) drawn.foam->settings = settings.foam;
  if (drawn.spray) drawn.spray = settings.spray;
  std::string key = sea_key(scene_);
  const bool another = key != sea_key_;
  bool same_sea = !another;
  if (another && !(change && at_once)) {
    const MadeBefore made{before, sea_->spec()};
    SeaSpec spec;
    try {
      spec = sea_spec(scene_, &made);
    } catch (...) {
      scene_.settings = before;
      throw;
    }
    if ((same_sea = sea_->takes(spec))) {
      const SeaState state = spec.state;
      ocean_->take(std::move(spec));
      if (state != sea_->state()) ocean_->change(state, settings.sea_change_s);
      sea_key_ = std::move(key);
    }
  }
  if (rebuild || !same_sea || !ocean_->takes(drawn))
    build();
  else
    ocean_->apply(drawn);
  if (bodies_ != nullptr) bodies_->take(body_media(scene_.settings));
  if (another) tell_remarks();
}

}  // namespace seascape
