// A scene built for a device: the ocean, the sky and the targets that its frames are drawn into.
#pragma once
#include <functional>
#include <memory>

#include "app/adaptive/live_levers.h"
#include "app/boats/boat_shape.h"
#include "app/boats/scene_bodies.h"
#include "app/comfort_overlay.h"
#include "app/drawn_hands.h"
#include "app/drawn_quality.h"
#include "app/hidden_area.h"
#include "app/scene.h"
#include "app/shown_depth.h"
#include "app/sky.h"
#include "app/solids/drawn_solids.h"
#include "app/solids/sun_map.h"
#include "app/wet_lens.h"
#include "ocean/ocean.h"
#include "ocean/surface/breath.h"
#include "ocean/surface/drawn_bubbles.h"
#include "ocean/surface/drawn_lens.h"
#include "ocean/surface/drawn_spray.h"

namespace seascape {

struct ExperienceOptions {
  std::uint32_t width = 1280, height = 720;  // pixels an eye
  int views = 2;
  bool per_eye = false;         // a pass per eye: for drivers whose multiview is at fault, and to compare
  bool probe = false;           // record vertex positions (tests)
  bool linear_picture = false;  // the light before tone mapping is asked for
  // Room for larger pictures, so that another size makes nothing; 0: for the size that is drawn.
  std::uint32_t most_width = 0, most_height = 0;
  VkFormat colour = VK_FORMAT_R8G8B8A8_SRGB;  // of the finished picture: an sRGB one
  bool hands = false;                         // hands and where they aim can be shown (show_hands, show_aim)
  bool show_depth = false;                    // whoever shows the picture gets its depth too
  bool comfort = false;                       // a vignette and a horizon line can be shown (show_comfort)
  bool hidden = false;                        // parts of the pictures can be told that no eye sees (hide)
  bool seen_elsewhere = false;                // another viewer may draw its sea in frames of his own, one at a time
};

class Experience {
 public:
  // Builds everything the scene names; throws Error. The settings' msaa is lowered to what the device has, with a
  // notice.
  Experience(Device& device, ShaderLibrary& shaders, const Scene& scene, const ExperienceOptions& options,
             std::shared_ptr<Sea> sea = nullptr);
  ~Experience();

  // Other picture size: new targets where there is no room (ExperienceOptions::most_width), the same pipelines. `room`:
  // another most size from now on; 0: as before.
  void resize(std::uint32_t width, std::uint32_t height, const glm::uvec2& room = {0, 0});
  // How the frames from now on are drawn, the picture's scale apart. Makes nothing, and outlives a rebuild.
  void draw_at(const DrawnQuality& quality) { quality_ = quality; }
  Lowered lowered() const;  // what of it there is that draw_at() may lower
  // From now on the picture is drawn into these images, of options().colour and of the room's size or larger; null: its
  // own. They outlive it, or the next call. Makes nothing where it has them already.
  void draw_into(std::shared_ptr<const LentImages> lent);
  // Which of them the next frame is drawn into.
  void choose(std::size_t colour, std::size_t depth);
  // How near all that is drawn lies in the picture, a layer a view, with options().show_depth, in the layout of
  // Access::depth_target once a frame is drawn; null where the device cannot give it.
  const Image* shown_depth() const;
  // Other settings: what only needs numbers is taken at once, another wind or swell comes over the sea (waves.change_s,
  // or at once if wished), what needs objects is built anew.
  void apply(const Settings& settings, bool sea_at_once = false);

  // Other effects, of those that are built (effect_is_built): its objects are built anew. Throws Error, and stays as it
  // was, where an effect's settings do not go together.
  void apply_effects(const std::vector<std::string>& effects);

  // Where a shader has changed on disk, builds its objects anew from it. Throws Error where one cannot be read, and
  // stays as it was.
  void reload_shaders();

  // Asked before its objects are built anew or go, by who draws with them too.
  void before_build(std::function<void()> asked) { before_build_ = std::move(asked); }

  // Sea::go_on, for this sea and those that come after it.
  void go_on();

  // What is drawn over the pictures from the next frame on, where options().comfort has made what draws it. Makes
  // nothing, and outlives a rebuild.
  void show_comfort(const ComfortShown& shown);

  // The hands of the frames from now on; with options().hands.
  void show_hands(std::vector<ShownHand> hands);
  // Where a teleport of the frames from now on goes; nothing: none is aimed. With options().hands.
  void show_aim(const std::optional<ShownAim>& aim);

  // What frames before the next one, drawn or not, have left on the eyes' lenses: a frame that nobody draws, of these
  // views and at this time of the sea. Frames that are drawn call it themselves; `in_air`: surely no eye is in the
  // water.
  void wet_lenses(const Viewpoint& viewpoint, double time_s, bool in_air = false);

  // The fist that may hold the dive light in the frames from now on, in the world; nothing: no hand is tracked.
  void hold_lamp(const std::optional<Pose>& hand) { lamp_hand_ = hand; }
  const std::optional<Pose>& lamp_hand() const { return lamp_hand_; }

  // Where the eyes of the frame drawn last are: metres below the water; nothing: in the air for sure, or where there is
  // no water.
  std::span<const std::optional<double>> eyes_depth_m() const { return eyes_depth_m_; }
  bool under_water() const;  // any of them

  // Has a diver's bubbles go on to a time with his head there, as each frame does: for frames that nobody draws. Does
  // nothing without the effect underwater.
  void breathe(double time_s, const Pose& head);
  const Breath& breath() const { return breath_; }
  // Null without the effect underwater.
  const DrawnBubbles* bubbles() const { return bubbles_.get(); }

  // What no eye sees of the frames from now on: it is left black and unlit. With options().hidden; makes nothing.
  void hide(const HiddenMesh& mesh);

  // How many times its objects were built.
  std::uint64_t builds() const { return builds_; }

  // The frame loop, whose ring the shaders read.
  Frame& frame() { return *frame_; }
  const Scene& scene() const { return scene_; }
  const ExperienceOptions& options() const { return options_; }
  Ocean& ocean() { return *ocean_; }
  // The sea that is drawn. It stays as it is while only its drawing is built anew.
  const std::shared_ptr<Sea>& sea() const { return sea_; }
  // The bodies of the scene's things that float; null where none do. They outlive changes of the sea.
  const std::shared_ptr<SeaBodies>& bodies() const { return bodies_; }
  Sky& sky() { return *sky_; }
  const Surface& surface() const { return *surface_; }
  // Null where there are no things.
  const DrawnSolids* solids() const { return solids_.get(); }
  // What they are drawn from, where there are any, for whoever draws them elsewhere; and the map of the sun, which may
  // be null.
  SolidSources solid_sources() const;
  const SunMap* sun_map() const { return sun_map_.get(); }
  // Null where there is none, or a debug view shows something else than light.
  const DrawnSpray* spray() const { return spray_.get(); }
  // Null where no eye may come into the water.
  const DrawnLens* lens() const { return lens_.get(); }
  // The finished picture, one layer a view, sRGB.
  const RenderTarget& picture() const { return picture_; }
  // The desktop frame's scene light before tone mapping; null in the tile frame.
  const RenderTarget* lit() const { return in_tile() ? nullptr : &lit_; }
  // Whether a frame is tone mapped where it is drawn, without a picture of its light.
  bool in_tile() const;
  // Whether the sea's pixels are lit once, after all its triangles are drawn.
  bool deferred() const;
  // Whether eyes may come into the water.
  bool underwater() const { return underwater_; }
  // Whether the water has pockets of air in it or is seen through portals.
  bool shaped() const { return shaped_; }

 private:
  friend void draw_frame(Experience&, Frame&, const Viewpoint&, double time_s);
  void build();
  void join_bodies();
  void build_targets();
  void make_solids(const RenderTarget& drawn, const SurfaceLight& light, const SurfaceLook& look);
  const Image* kept_depth() const;
  void take_targets();  // by all that draws into them or reads them
  void bind_tone();
  void make_sky(const RenderTarget& drawn, const SurfaceLook& look);
  void update_head(Frame& frame, const Viewpoint& viewpoint, const Ocean::EyesSide& side, double time_s);
  void draw_sky(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const;
  void set_area();
  // The viewer wishes no water on his lenses.
  bool clear_lens() const { return scene_.settings.comfort.on && scene_.settings.comfort.clear_lens; }
  // Warns of what there was nothing of to tell before the last change (remarks_of).
  void tell_remarks();
  Device& device_;
  ShaderLibrary& shaders_;
  Scene scene_;
  ExperienceOptions options_;
  std::unique_ptr<Frame> frame_;
  std::shared_ptr<Sea> sea_;
  std::shared_ptr<SeaBodies> bodies_;
  std::unique_ptr<BoatShapes> boat_shapes_;  // with the bodies
  std::weak_ptr<Sea> sea_of_bodies_;         // whose actor they are
  std::string sea_key_;                      // of the scene that it was made of, or has grown into
  std::unique_ptr<Ocean> ocean_;
  std::unique_ptr<Sky> sky_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<DrawnSpray> spray_;
  std::unique_ptr<DrawnBubbles> bubbles_;
  std::unique_ptr<DrawnLens> lens_;
  WetLens wet_lens_;
  std::unique_ptr<LoadedModels> loaded_models_;  // kept while other objects are built anew
  std::unique_ptr<SolidSurroundings> solid_surroundings_;
  std::unique_ptr<SunMap> sun_map_;  // where solid things throw shadows
  std::unique_ptr<DrawnSolids> solids_;
  std::unique_ptr<ComfortOverlay> comfort_;
  std::unique_ptr<DrawnHands> hands_;
  std::unique_ptr<HiddenArea> hidden_area_;
  HiddenMesh hidden_mesh_;
  std::vector<ShownHand> shown_hands_;
  std::optional<ShownAim> shown_aim_;
  std::optional<Pose> lamp_hand_;
  std::array<std::optional<double>, 2> eyes_depth_m_;
  Breath breath_;
  ComfortShown comfort_shown_;
  DrawnQuality quality_;
  RenderTarget picture_, lit_;  // lit_: the desktop frame's HDR picture
  std::shared_ptr<const LentImages> lent_;
  std::unique_ptr<ShownDepth> shown_depth_;  // where no pass draws into the depth that is shown
  Owned<VkSampler> lit_sampler_;
  // For eyes that may be in the water: what those in the air see, and those in the water.
  Pipeline sky_over_water_, sky_underwater_;
  Pipeline sky_pipeline_, tone_pipeline_;
  Bindings sky_bindings_, sky_over_water_bindings_, sky_underwater_bindings_, tone_bindings_;
  std::uint64_t builds_ = 0;
  bool goes_on_ = false, underwater_ = false, shaped_ = false;
  std::function<void()> before_build_;
  std::vector<std::string> told_;  // remarks
};

// What a device's multiview check and the user's wish come to, with a notice when the driver fails it.
bool draw_per_eye(Device& device, ShaderLibrary& shaders, StereoMode mode, int views);

}  // namespace seascape
