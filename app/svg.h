// Pieces of plots, as SVG text that takes its colours from the page.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

inline constexpr double plot_width = 1000.0, left_edge = 64.0,
                        right_edge = 112.0;  // of the whole picture; units are SVG's

// For text between tags and in attributes.
std::string html_escaped(std::string_view text);

// One of the eight colours of the page, in turn.
std::string colour(std::size_t index);

std::string open_svg(double height, const std::string& description);
// `quiet`: in the page's colour of side notes. `fill`: another colour; empty: the class's.
std::string text_at(double x, double y, const std::string& text, const char* anchor = "start", bool quiet = true,
                    const std::string& fill = "");
// `kind`: a class of the page, "axis" or "budget".
std::string line(double x0, double y0, double x1, double y1, const char* kind);

// A round step (1, 2 or 5 times a power of ten) that divides `span` into at most `most` parts.
double round_step(double span, int most);
std::string tick_text(double value, double step);

struct Legend {
  std::string name, fill;
};
std::string legend(const std::vector<Legend>& entries, double y);
double legend_height(const std::vector<Legend>& entries);

// The picture of a <figure> as a file of its own with the page's colours. Viewers that know no CSS variables show the
// light ones. Empty where there is no picture.
std::string standalone_svg(const std::string& figure_text);

}  // namespace seascape
