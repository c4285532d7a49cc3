# What may be built without Vulkan: the sanitizers and fuzzers build just this. A new pure file is added here.
set(PURE_SOURCES_REGEX
  "^(engine/(error|files|image_file|gltf|math|text|view)\\.cpp|ocean/waves/(sea_state|spectrum|ladder|gaussian|phase|fft|wave_field|wave_bins|sea_statistics|wave_tile|query|tile_sampler)[a-z_]*\\.cpp|ocean/lod/(quadtree|patch_mesh|culling|horizon)[a-z_]*\\.cpp|ocean/effects\\.cpp|app/(settings|scene|camera_path|quality|arguments|validate|query_command|report|trace|statistics|content|csv|doc)[a-z_]*\\.cpp)$")
