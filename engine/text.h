// Numbers and names as text, the same in every locale.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace seascape {

// The whole of `text` as a finite number, or nothing. A point is the decimal mark whatever the locale says.
std::optional<double> real_from(std::string_view text);
std::optional<std::int64_t> integer_from(std::string_view text);

// The shortest text that reads back as the same double; without an exponent from 1e-5 to 1e15.
std::string text_from(double value);

// `text` on one line whatever it holds (control characters as \xNN), cut after `longest` bytes.
std::string one_line(std::string_view text, std::size_t longest);
// The same in quotes, for a message.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

// The one of `names` that `name` is most likely a slip of, or "" where none is near.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names);

// " (did you mean 'NAME'?)" or "".
std::string did_you_mean(std::string_view name, std::span<const std::string_view> names);

// "a, b or c".
std::string listed(std::span<const std::string_view> names, std::string_view last = "or");

}  // namespace seascape
