// "1440x1584": the size of a picture as options and files have it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "engine/text.h"

namespace seascape {

// Two whole numbers from 1 to 16384; else nothing, and `fault` says why: "is out of range" or "is not WIDTHxHEIGHT".
inline std::optional<std::array<int, 2>> picture_size_from(std::string_view text, std::string& fault) {
  const std::size_t cross = text.find('x');
  const auto width = integer_from(text.substr(0, cross));
  const auto height = cross == std::string_view::npos ? std::nullopt : integer_from(text.substr(cross + 1));
  if (width && height && *width >= 1 && *height >= 1 && *width <= 16384 && *height <= 16384)
    return std::array{static_cast<int>(*width), static_cast<int>(*height)};
  fault = width && height ? "is out of range" : "is not WIDTHxHEIGHT";
  return std::nullopt;
}

}  // namespace seascape
