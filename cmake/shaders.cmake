# GLSL to SPIR-V with dependency tracking (glslangValidator --depfile) and validation (spirv-val). The results stand
# beside the executable in shaders/, one NAME.spv for each shaders/NAME.{vert,frag,comp}, and for each of tests/shaders where tests are
# built.
find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
file(GLOB SHADER_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.vert ${CMAKE_SOURCE_DIR}/shaders/*.frag
  ${CMAKE_SOURCE_DIR}/shaders/*.comp)
if(SEASCAPE_TESTS)
  file(GLOB TEST_SHADER_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/shaders/*.comp)
endif()
set(SHADER_OUTPUTS)
# Paths are relative to the build folder: a dependency file does not survive a space in the path of the project.
file(RELATIVE_PATH SHADER_FOLDER ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR}/shaders)
foreach(source ${SHADER_SOURCES} ${TEST_SHADER_SOURCES})
  get_filename_component(name ${source} NAME)
  file(RELATIVE_PATH relative_source ${CMAKE_BINARY_DIR} ${source})
  set(output ${CMAKE_BINARY_DIR}/shaders/${name}.spv)
  set(relative shaders/${name}.spv)
  add_custom_command(OUTPUT ${output}
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.1 -g0 -I${SHADER_FOLDER} --depfile ${relative}.d
      -o ${relative}.tmp ${relative_source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${relative}.tmp
    COMMAND ${CMAKE_COMMAND} -E rename ${relative}.tmp ${relative}
    COMMAND sed -i "s|^[^:]*:|${relative}:|" ${relative}.d
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
    DEPENDS ${source} DEPFILE ${output}.d COMMENT "Shader ${name}" VERBATIM)
  list(APPEND SHADER_OUTPUTS ${output})
endforeach()
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/shaders)
add_custom_target(seascape_shaders DEPENDS ${SHADER_OUTPUTS})
