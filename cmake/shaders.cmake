# GLSL to SPIR-V with dependency tracking (glslangValidator --depfile) and validation (spirv-val). The results stand
# beside the executable in shaders/, one NAME.spv for each shaders/NAME.{vert,frag,comp}.
find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
file(GLOB SHADER_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.vert ${CMAKE_SOURCE_DIR}/shaders/*.frag
  ${CMAKE_SOURCE_DIR}/shaders/*.comp)
set(SHADER_OUTPUTS)
foreach(source ${SHADER_SOURCES})
  get_filename_component(name ${source} NAME)
  set(output ${CMAKE_BINARY_DIR}/shaders/${name}.spv)
  add_custom_command(OUTPUT ${output}
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.1 -g0 -I${CMAKE_SOURCE_DIR}/shaders --depfile ${output}.d -o ${output}.tmp ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output}.tmp
    COMMAND ${CMAKE_COMMAND} -E rename ${output}.tmp ${output}
    COMMAND sed -i "s|^[^:]*:|${output}:|" ${output}.d
    DEPENDS ${source} DEPFILE ${output}.d COMMENT "Shader ${name}" VERBATIM)
  list(APPEND SHADER_OUTPUTS ${output})
endforeach()
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/shaders)
add_custom_target(seascape_shaders DEPENDS ${SHADER_OUTPUTS})
