#include "app/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "app/report_page.h"

namespace seascape {

namespace {
constexpr int colours = 8;

// Writes the light colour before each that is a variable. Viewers that know variables take the last declaration.
std::string with_plain_colours(const std::string& text) {
  const std::string_view light = std::string_view(page_colours).substr(0, std::string_view(page_colours).find('}'));
  static const std::regex variable("(fill|stroke):var\\((--[a-z0-9]+)\\)");
  std::string all;
  auto from = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), variable), end; found != end; ++found) {
    const std::string name = (*found)[2].str() + ":";
    const std::size_t at = light.find(name);
    all.append(from, (*found)[0].first);
    if (at != std::string_view::npos)
      all += (*found)[1].str() + ":" + std::string(light.substr(at + name.size(), std::string_view("#rrggbb").size())) +
             ";";
    all += (*found)[0].str();
    from = (*found)[0].second;
  }
  return all.append(from, text.end());
}
}  // namespace

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') ? '?' : c;
    }
  }
  return escaped;
}

std::string colour(std::size_t index) { return fmt::format("var(--c{})", index % colours); }

std::string open_svg(double height, const std::string& description) {
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", plot_width, height,
                     html_escaped(description));
}

std::string text_at(double x, double y, const std::string& text, const char* anchor, bool quiet,
                    const std::string& fill) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}{}>{}</text>\n", x, y, anchor,
                     quiet ? " class=\"quiet\"" : "", fill.empty() ? "" : fmt::format(" style=\"fill:{}\"", fill),
                     html_escaped(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0, x1, y1,
                     kind);
}

double round_step(double span, int most) {
  const double least = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-12)) return factor * power;
  return 10.0 * power;
}

std::string tick_text(double value, double step) {
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value, digits);
}

std::string legend(const std::vector<Legend>& entries, double y) {
  std::string text;
  double x = left_edge;
  for (const Legend& entry : entries) {
    const double width = 28.0 + 8.0 * static_cast<double>(entry.name.size());
    if (x + width > plot_width) {
      x = left_edge;
      y += 20.0;
    }
    text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"12\" rx=\"2\" style=\"fill:{}\"/>\n", x,
                        y - 11.0, entry.fill);
    text += text_at(x + 18.0, y, entry.name, "start", false);
    x += width + 8.0;
  }
  return text;
}

double legend_height(const std::vector<Legend>& entries) {
  double x = left_edge, height = 24.0;
  for (const Legend& entry : entries) {
    const double width = 28.0 + 8.0 * static_cast<double>(entry.name.size());
    if (x + width > plot_width) {
      x = left_edge;
      height += 20.0;
    }
    x += width + 8.0;
  }
  return height;
}

std::string standalone_svg(const std::string& figure_text) {
  const std::size_t from = figure_text.find("<svg "), to = figure_text.rfind("</svg>");
  if (from == std::string::npos || to == std::string::npos) return {};
  const std::size_t open_end = figure_text.find('>', from);
  return with_plain_colours("<svg xmlns=\"http://www.w3.org/2000/svg\" " +
                            figure_text.substr(from + 5, open_end - from - 5) + "><style>" + page_colours +
                            "</style><rect width=\"100%\" height=\"100%\" style=\"fill:var(--page)\"/>" +
                            figure_text.substr(open_end + 1, to - open_end - 1) + "</svg>\n");
}

}  // namespace seascape
