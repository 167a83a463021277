#include "bench/measured.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vorpipe::bench {
namespace {

// In pixels; a panel has its margins inside.
constexpr double panel_width = 480, panel_height = 330;
constexpr double left = 64, right = 20, top = 52, bottom = 44;
constexpr double legend_height = 44, caption_height = 36, margin = 16, marker = 3.2;
constexpr double legend_line = 24, letter_width = 7.2, legend_gap = 28;
/// An axis ends at this multiple of the greatest value along it, and begins at the least divided by it.
constexpr double beyond = 1.25;

// Okabe and Ito's colors, which the color-blind tell apart; black is for other programs (Curve::theirs).
constexpr std::array<const char*, 7> colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                               "#E69F00", "#56B4E9", "#999999"};

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      safe += c;
    }
  }
  return safe;
}

std::string textAt(double x, double y, std::string_view style, std::string_view text) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' {}>{}</text>\n", x, y, style, escaped(text));
}

std::string lineFrom(double x, double y, double to_x, double to_y, std::string_view style) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>\n", x, y, to_x, to_y, style);
}

/// A logarithmic axis from low to high, drawn from `begin` to `end`.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  double begin, end;

  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double at(double value) const {
    const double from = low / beyond, to = high * beyond;
    return begin + (end - begin) * std::log(value / from) / std::log(to / from);
  }
  /// Powers of ten, and where those are few some between them.
  [[nodiscard]] std::vector<double> ticks() const {
    const double range = high / low;
    const auto fits = [range](int times) {
      return times == 1 || range < 4 || (range < 200 && (times == 2 || times == 5));
    };
    const double reach = range < 4 && range > 1 ? 1.05 : beyond;
    std::vector<double> found;
    for (int power = static_cast<int>(std::floor(std::log10(low))) - 1; std::pow(10, power) < high * beyond;
         ++power) {
      for (int times = 1; times < 10; ++times) {
        const double tick = times * std::pow(10, power);
        if (fits(times) && tick >= low / reach && tick <= high * reach) found.push_back(tick);
      }
    }
    return found;
  }
};

std::string tickText(double value) {
  constexpr double thousand = 1e3, million = 1e6;
  if (value >= million) return fmt::format("{:g}M", value / million);
  if (value >= thousand) return fmt::format("{:g}k", value / thousand);
  return fmt::format("{:g}", value);
}

std::vector<std::string> namesIn(std::span<const Plot> plots) {
  std::vector<std::string> names;
  for (const Plot& plot : plots) {
    for (const Curve& curve : plot.curves) {
      if (!curve.points.empty() && std::ranges::find(names, curve.name) == names.end())
        names.push_back(curve.name);
    }
  }
  return names;
}

std::string styleOf(const Curve& curve, std::span<const std::string> names) {
  if (curve.theirs) return "stroke='#000' stroke-dasharray='5 4'";
  const auto index = static_cast<std::size_t>(std::ranges::find(names, curve.name) - names.begin());
  return fmt::format("stroke='{}'", colors[index % colors.size()]);
}

std::string drawAxes(const Plot& plot, const Axis& x, const Axis& y) {
  std::string text;
  for (const double tick : x.ticks()) {
    text += lineFrom(x.at(tick), y.begin, x.at(tick), y.end, "class='grid'");
    text += textAt(x.at(tick), y.begin + 17, "class='tick' text-anchor='middle'", tickText(tick));
  }
  for (const double tick : y.ticks()) {
    text += lineFrom(x.begin, y.at(tick), x.end, y.at(tick), "class='grid'");
    text += textAt(x.begin - 8, y.at(tick) + 4, "class='tick' text-anchor='end'", tickText(tick));
  }
  text += lineFrom(x.begin, y.begin, x.end, y.begin, "class='axis'");
  text += lineFrom(x.begin, y.begin, x.begin, y.end, "class='axis'");
  text += textAt(x.begin - left + 12, y.end - 32, "class='title'", plot.title);
  text += textAt(x.begin - left + 12, y.end - 12, "class='label'", plot.y);
  text += textAt(x.end, y.begin + 34, "class='label' text-anchor='end'", plot.x);
  return text;
}

std::string drawCurve(const Curve& curve, const std::string& style, const Axis& x, const Axis& y) {
  auto points = curve.points;
  std::ranges::sort(points);
  std::string places, dots;
  for (const auto& [px, py] : points) {
    places += fmt::format("{:.1f},{:.1f} ", x.at(px), y.at(py));
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' stroke-dasharray='none'/>", x.at(px),
                        y.at(py), marker);
  }
  return fmt::format("<g {} class='curve'><title>{}</title><polyline points='{}' fill='none'/>{}</g>\n",
                     style, escaped(curve.name), places, dots);
}

std::string drawPanel(const Plot& plot, std::span<const std::string> names, double at_x, double at_y) {
  Axis x, y;
  x.begin = at_x + left;
  x.end = at_x + panel_width - right;
  y.begin = at_y + panel_height - bottom;
  y.end = at_y + top;
  for (const Curve& curve : plot.curves) {
    for (const auto& [px, py] : curve.points) {
      x.take(px);
      y.take(py);
    }
  }
  std::string text = drawAxes(plot, x, y);
  for (const Curve& curve : plot.curves) {
    if (!curve.points.empty()) text += drawCurve(curve, styleOf(curve, names), x, y);
  }
  return text;
}

std::string drawLegend(std::span<const Plot> plots, std::span<const std::string> names) {
  std::string text;
  double at = margin + 12;
  for (const auto& name : names) {
    const Curve* found = nullptr;
    for (const Plot& plot : plots) {
      for (const Curve& curve : plot.curves) {
        if (curve.name == name) found = &curve;
      }
    }
    const double y = margin + 14;
    text += fmt::format("<g {} class='curve'>{}<circle cx='{:.1f}' cy='{:.1f}' r='{}'/></g>\n",
                        styleOf(*found, names), lineFrom(at, y, at + legend_line, y, ""),
                        at + legend_line / 2, y, marker);
    text += textAt(at + legend_line + 7, y + 4, "class='label'", name);
    at += legend_line + legend_gap + letter_width * static_cast<double>(name.size());
  }
  return text;
}

}  // namespace

std::string svg(std::span<const Plot> plots, const std::string& caption) {
  const auto names = namesIn(plots);
  std::vector<const Plot*> shown;
  for (const Plot& plot : plots) {
    if (std::ranges::any_of(plot.curves, [](const Curve& curve) { return !curve.points.empty(); }))
      shown.push_back(&plot);
  }
  const std::size_t rows = (shown.size() + 1) / 2;
  const double width = 2 * margin + (shown.size() > 1 ? 2 : 1) * panel_width;
  const double height =
      2 * margin + legend_height + static_cast<double>(rows) * panel_height + caption_height;
  std::string text = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
      "{1:.0f}' "
      "role='img' font-family='Helvetica, Arial, sans-serif'>\n<title>vorpipe bench</title>\n"
      "<style>.title{{font-size:14px;font-weight:bold;fill:#222}}.label{{font-size:12px;fill:#444}}"
      ".tick{{font-size:11px;fill:#666}}.grid{{stroke:#e4e4e4}}.axis{{stroke:#888}}"
      ".curve{{stroke-width:2;fill:#fff;stroke-linejoin:round}}</style>\n"
      "<rect width='100%' height='100%' fill='#fff'/>\n",
      width, height);
  text += drawLegend(plots, names);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::size_t row = i / 2, column = i % 2;
    text += drawPanel(*shown[i], names, margin + static_cast<double>(column) * panel_width,
                      margin + legend_height + static_cast<double>(row) * panel_height);
  }
  text += textAt(margin + 12, height - margin, "class='tick'", caption);
  return text + "</svg>\n";
}

}  // namespace vorpipe::bench
