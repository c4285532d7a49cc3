// Lets one header declare the same structs for C++ (namespace seascape::gpu) and GLSL.
#ifndef SEASCAPE_GPU_TYPES_H
#define SEASCAPE_GPU_TYPES_H
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace seascape::gpu {
using glm::ivec2;
using glm::ivec4;
using glm::mat4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec4;
using uint = std::uint32_t;
}  // namespace seascape::gpu
#define SEASCAPE_SHARED_BEGIN namespace seascape::gpu {
#define SEASCAPE_SHARED_END }
#define SEASCAPE_CONST inline constexpr
#define SEASCAPE_FUNCTION inline
// Of formulas that C++ has in double too: `Real` is float in GLSL.
#define SEASCAPE_REAL_FUNCTION \
  template <class Real>        \
  inline
#define SEASCAPE_REAL2 glm::vec<2, Real>
#else
#define SEASCAPE_SHARED_BEGIN
#define SEASCAPE_SHARED_END
#define SEASCAPE_CONST const
#define SEASCAPE_FUNCTION
#define SEASCAPE_REAL_FUNCTION
#define SEASCAPE_REAL2 vec2
#define Real float
#endif
#endif
