# What needs Vulkan (or a window). All else is pure: the sanitizers and fuzzers build just that. A new file that touches
# Vulkan is named here.
string(CONCAT VULKAN_SOURCES_REGEX "^("
  "engine/(barrier|device|device_cache|device_objects|frame|memory|multiview_check|pipeline|render_target|resources|shader)|"
  "platform/(display|headless|headset.*|overlay_drawing|simulated.*|window.*|xr_api|xr_pose)|"
  "ocean/ocean|ocean/drawn/.*|ocean/surface/(drawn_bubbles|drawn_lens|drawn_spray|near_lines|surface)|"
  "app/solids/(drawn_solids|loaded_models|solid_pictures|solid_surroundings|sun_map)|app/boats/path_on_body|app/lab/(drawn_curves|frame_curve|lab_command|lever_curve)|"
  "app/(calibrate|capture|comfort_overlay|doctor|drawn_hands|effect_costs|experience|experience_head|experience_sky|explore|eyes_in_water|explorer|explorer_boat|explorer_input|explorer_mirror|explorer_move|explorer_scene|frame|frame_times|hidden_area|measured_display|measured_presets|mirror|mirror_widgets|outside_view|panel|picture_copy|plan|program|replay|scene_loader|shown_depth|sky)"
  ")\\.cpp$")
