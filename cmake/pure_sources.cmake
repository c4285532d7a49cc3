# What may be built without Vulkan: the sanitizers and fuzzers build just this. A new pure file is added here.
string(CONCAT PURE_SOURCES_REGEX "^("
  "engine/(error|exr_header|files|gltf[a-z_]*|image_file[a-z_]*|math|text|tinygltf_library|view)|"
  "ocean/waves/(sea_state|spectrum|ladder|gaussian|phase|fft|wave_field|wave_bins|sea_statistics|wave_tile|query|tile_sampler)[a-z_]*|"
  "ocean/lod/(quadtree|patch_mesh|culling|horizon)[a-z_]*|"
  "ocean/effects|"
  "app/(settings|scene|camera_path|quality|arguments|validate|query_command|report|trace|statistics|content|csv|located_json|progress)[a-z_]*"
  ")\\.cpp$")
