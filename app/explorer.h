// Explore: the loop that turns what is done before a display into the camera's and the sea's movement.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/adaptive/rate_keeper.h"
#include "app/boats/crew.h"
#include "app/calibration.h"
#include "app/comfort.h"
#include "app/explore_camera.h"
#include "app/eye_crossings.h"
#include "app/hands_in_water.h"
#include "app/mirror.h"
#include "app/panel.h"
#include "app/path_recorder.h"
#include "app/picture_copy.h"
#include "app/program.h"
#include "app/scene_loader.h"
#include "app/swim.h"
#include "platform/display.h"

namespace seascape {

// Where somebody was, to go on from there before another display.
struct LeftOff {
  Scene scene;  // its settings as they were
  std::string preset;
  Pose head;
  Travel travel = Travel::fly;
  double sea_elapsed_s = 0.0;  // since time.start_s
  bool paused = false;
};

// Of mouse travel, times the vertical field of view: a picture's height turns 2 fields.
inline constexpr double degrees_a_pixel = 0.0025;

class Explorer {
 public:
  // All outlive it.
  // `desktop`: what shows a mirror of a display that tracks a head; null: none.
  Explorer(const Arguments& arguments, Program& program, Display& display, WindowSystem* desktop = nullptr);
  // Until the display is closed, or --frames pictures have been shown. Throws Error.
  void run();
  // One of its frames; false, and none, where it has come to its end.
  bool frame();
  // What was asked for in a panel; taken before the next frame.
  void obey(const PanelWish& wish);
  const Scene& scene() const { return experience_->scene(); }  // that is shown
  LeftOff left_off() const;
  void go_on_from(const LeftOff& before);  // whose scene the program has

 private:
  void build(const Scene& scene);
  // Between two frames: what was asked for since the last ones, however long it takes.
  void make_changes();
  void wait_at_sea();  // until the scene that the program has is loaded
  ExperienceOptions options(const Scene& scene) const;
  void take_experience();
  void serve_desk();
  void show_desk(const DisplayFrame& shown, double dt_s);
  void next_mirror_view();
  void obey(const Input& input);  // what was pressed
  void look(const Input& input);
  void suit_wearer();  // whom the display is set for
  void keep_rate();    // of another experience
  std::vector<Lever> loading_levers_here() const;
  void hold_rate();  // what the next frame is drawn with
  void move(const Input& input, double dt_s);
  // Has the camera moved gently, where it is worn on a head.
  void soften(const Input& input, double dt_s, double water_m, CameraWish& wish);
  void board();                   // or steps off
  void work_boat(Action action);  // moors, anchors or puts her back
  void step_ashore(const Pose& was);
  void look_from_boat(BoatView view);
  void sail(const Input& input, double dt_s);
  Pose carrier_aboard() const;
  void tell_of_bodies();
  void tell_of_eyes();
  void record(const Input& input, const Pose& head);
  void show_hands(const Input& input);
  std::array<std::optional<Pose>, 2> hands(const Input& input) const;  // in the world
  Pose carrier() const;
  Pose head() const;  // before a frame is drawn: as it was last
  std::optional<std::size_t> pointing_hand(const Input& input) const;
  Pose pointer(const Input& input) const;
  void leave();
  void jump(const glm::dvec3& to_m);
  void aim(const Input& input);  // a teleport, and goes when it is let go
  ShownAim shown_aim(const Input& input, const SeaView& water) const;
  void feel(std::optional<std::size_t> hand, double strength, double seconds);  // a buzz, in a hand if there is one
  bool swims(const Input& input) const { return !types() && input.held(Action::swim); }
  CameraWish::Swum swim(const Input& input, double dt_s);
  bool types() const { return overlay_ && overlay_->wants_keyboard(); }
  bool points_at_widgets() const { return mirror_ ? mirror_->takes_pointer() : overlay_ && overlay_->wants_pointer(); }
  void step(const DisplayFrame& shown);  // a begun frame, to its end
  void draw(const DisplayFrame& shown, double dt_s);
  PanelFacts facts(const DisplayFrame& shown) const;
  // The settings as they will be after make_changes(), and others for it to take.
  const Settings& asked() const { return wanted_ ? *wanted_ : settings(); }
  void ask(const Settings& settings) { wanted_ = settings; }
  void apply(const Settings& settings);
  void apply_effects(const std::vector<std::string>& effects);
  void change_scene(const std::string& name);  // once it is loaded, with what holds the rate in it
  void load_scene_with(const std::string& name, const LoadedWith& with);  // samples 0: as the preset has them
  void load(const std::string& name, std::function<Scene()> read);
  std::unique_ptr<Experience> loaded_scene();
  void take(std::unique_ptr<Experience> loaded);
  void set_travel(Travel travel);  // aboard: how one looks
  void toggle_pause();
  void scale_time(double factor);
  void next_debug_view();
  void toggle_comfort();
  void toggle_light();
  void take_screenshot();  // of the copy that the frame made
  void reload_shaders();   // where one has changed on disk
  void toggle_recording();
  // On the terminal and, for a few seconds, in the picture.
  void tell(const std::string& line);
  void tell_fault(const std::string& line);
  // Makes a file of a free name, has it written, and tells of it; no empty one is left by a fault.
  void keep(const std::string& what, const std::string& stem, const std::string& ending,
            const std::function<void(const std::filesystem::path&)>& write);

  double sea_time_s() const;
  void begin_time();  // as a scene begins
  void scrub(double by_s);
  double scene_time_s() const;  // as a path of this scene counts it
  const Settings& settings() const { return experience_->scene().settings; }

  const Arguments& arguments_;
  Program& program_;
  Display& display_;
  WindowSystem* desktop_;           // null: no mirror, or no more
  std::unique_ptr<Mirror> mirror_;  // outlives what it draws; null: not yet asked for
  std::unique_ptr<Experience> experience_;
  PictureCopy copy_;  // of the last frame that anybody wanted to keep
  SceneLoader loader_;
  std::string loading_;               // the scene asked for last
  std::unique_ptr<Overlay> overlay_;  // null: nowhere to show one
  Panel panel_;
  std::unique_ptr<RateKeeper> keeper_;  // of the experience
  bool whole_ = false;                  // the frame is drawn as the preset has it, whatever the keeper says
  DrawnQuality quality_;                // of the frame
  ExploreCamera camera_;
  Crew crew_;
  int holds_ = 0;             // of the bodies, that are told of
  Pose eyes_aboard_;          // whose who is aboard, before he looks around
  glm::dvec2 look_deg_{0.0};  // to the right of them, and up
  Comfort comfort_;
  HandsInWater hands_;
  Swim swim_;
  EyeCrossings eyes_;  // in and out of the water
  bool swam_ = false;  // in the frame before
  // Of a swimmer in that frame, over the floor: his hands, and where they were from his head one frame earlier; for the
  // head is known once a frame is drawn.
  struct Strokes {
    std::array<std::optional<glm::dvec3>, 2> hands_m, from_head_m;
    double dt_s = 0.0;
  } strokes_;
  PathRecorder recorder_;
  bool recording_began_ = false;  // with this frame
  Input input_;                   // of this frame: the display's, and what was done at the desk
  std::vector<Action> wished_;    // in the panel: pressed in the next frame, so that a recording has them
  std::vector<std::string> scenes_;
  std::vector<PresetCosts> costs_;  // of shipped scenes' presets
  Calibration calibration_;         // of the device
  std::string finest_preset_;       // that a scene may be loaded with
  std::optional<Settings> wanted_;
  std::optional<std::vector<std::string>> wanted_effects_;
  bool at_sea_ = false;  // in the calm that stands for the first scene until it is loaded
  bool paused_ = false, look_by_button_ = false, look_by_key_ = false, button_was_down_ = false;
  bool told_to_stay_above_ = false;  // the water
  bool told_how_to_swim_ = false;
  bool aiming_ = false;                   // a teleport is held
  std::optional<glm::dvec3> aimed_at_m_;  // where it would go
  bool screenshot_wanted_ = false, leaving_ = false;
  int drawn_ = 0;                  // frames of a scene
  std::optional<double> last_s_;   // of the frame before, by the display
  double now_s_ = 0.0;             // the display's clock, what a hidden display waited left out
  double sea_elapsed_s_ = 0.0;     // the sea's time since time.start_s
  double period_s_ = 0.0;          // from frame to frame, as the display says
  std::optional<Pose> head_;       // of the frame drawn last
  bool recording_wanted_ = false;  // with the next frame
  double recording_began_s_ = 0.0, message_until_s_ = 0.0, shaders_looked_at_s_ = 0.0;
  double frame_ms_ = 0.0, cpu_ms_ = 0.0;
  std::size_t patches_ = 0;
  std::uint64_t dropped_ = 0;
  bool was_shown_ = false, focused_ = true;  // the frame before
  std::string message_;
};

}  // namespace seascape
