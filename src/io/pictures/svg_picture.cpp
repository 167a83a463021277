#include <cstdint>
#include <string_view>

#include "base/try.h"
#include "io/base/print.h"
#include "io/pictures/vector_picture.h"

namespace vorpipe {
namespace {

constexpr std::uint32_t opaque = 0xFF;

// Few enough for viewers that are slow with long paths, but enough for a small number of paths.
constexpr std::size_t lines_of_path = 1000;

constexpr std::string_view fonts =
    " font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\"";

void put(Bytes& text, std::string_view more) { text.append(more); }

/// Appends `#rrggbb`; R is in the lowest byte.
void printColor(Bytes& text, std::uint32_t rgba) {
  print(text, FMT_COMPILE("#{:02x}{:02x}{:02x}"), rgba & 0xFF, rgba >> 8 & 0xFF, rgba >> 16 & 0xFF);
}

void printColor(Bytes& text, std::string_view name, std::uint32_t rgba) {
  print(text, FMT_COMPILE(" {}=\""), name);
  printColor(text, rgba);
  text.push_back('"');
}

void printLength(Bytes& text, std::string_view name, double pixels) {
  print(text, FMT_COMPILE(" {}=\""), name);
  printPixels(text, pixels);
  text.push_back('"');
}

/// Begins a rectangle.
void printRectangle(Bytes& text, double left, double top, double width, double height) {
  put(text, "<rect");
  printLength(text, "x", left);
  printLength(text, "y", top);
  printLength(text, "width", width);
  printLength(text, "height", height);
}

/// Appends an arc of less than half an ellipse, up to its end.
void printArc(Bytes& text, const PixelArc& arc, Point end) {
  text.push_back('A');
  printPoint(text, arc.radii);
  put(text, arc.angle > 0 ? " 0 0 1 " : " 0 0 0 ");
  printPoint(text, end);
}

/// Appends the data of a path; `end` is Z if lines are closed.
void printLines(Bytes& text, const Lines& lines, std::string_view end) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    text.push_back('M');
    bool after_arc = false;
    for (std::size_t i = 0; i < lines[k].size(); ++i) {
      const PixelArc* arc = lines.arcTo(k, i);
      if (arc != nullptr) {
        printArc(text, *arc, lines[k][i]);
      } else {
        put(text, after_arc ? "L" : i > 0 ? " " : "");
        printPoint(text, lines[k][i]);
      }
      after_arc = arc != nullptr;
    }
    put(text, end);
  }
}

void printHead(Bytes& text, const VectorPicture& picture) {
  put(text,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"");
  if (const auto& paper = picture.paper()) {
    print(text, FMT_COMPILE(" width=\"{:.6g}mm\" height=\"{:.6g}mm\" preserveAspectRatio=\"none\""),
          paper->width, paper->height);
  } else {
    print(text, FMT_COMPILE(" width=\"{}\" height=\"{}\""), picture.width(), picture.height());
  }
  print(text, FMT_COMPILE(" viewBox=\"{} {} {} {}\">\n"), -picture.sheet().left, -picture.sheet().top,
        picture.width(), picture.height());
  const Box clip = picture.clip();
  put(text, "<clipPath id=\"frame\">");
  printRectangle(text, clip.xmin, clip.ymin, clip.xmax - clip.xmin, clip.ymax - clip.ymin);
  put(text, "/></clipPath>\n");
  if (const Lines outline = picture.outline(); !outline.empty()) {
    put(text, "<clipPath id=\"outline\" clip-path=\"url(#frame)\"><path clip-rule=\"evenodd\" d=\"");
    printLines(text, outline, "Z");
    put(text, "\"/></clipPath>\n");
  }
}

/// Begins a group, a layer of Inkscape's, up to its other attributes; `clip` names a path that clips it.
void printEscaped(Bytes& text, std::string_view words) {
  for (const char letter : words) {
    put(text, letter == '<' ? "&lt;" : letter == '&' ? "&amp;" : std::string_view(&letter, 1));
  }
}

void beginLayer(Bytes& text, std::string_view name, std::string_view clip = {}) {
  print(text, FMT_COMPILE("<g id=\"{0}\" inkscape:groupmode=\"layer\" inkscape:label=\"{0}\""), name);
  if (clip.empty()) return;
  print(text, FMT_COMPILE(" clip-path=\"url(#{})\" stroke-linejoin=\"round\" stroke-linecap=\"round\""),
        clip);
}

/// The path that clips what lies over cells.
std::string_view clipOf(const VectorPicture& picture) {
  return picture.outline().empty() ? "frame" : "outline";
}

Result<void> writeCells(ByteSink& sink, Bytes& text, const VectorPicture& picture, const Diagram& diagram) {
  const bool painted = !picture.cellsShowBackground();
  beginLayer(text, "cells", "frame");
  put(text, painted ? " fill-rule=\"evenodd\"" : " fill=\"none\"");
  if (painted) printLength(text, "stroke-width", VectorPicture::seam_width);
  put(text, ">\n");
  std::size_t last = diagram.area.size(), copy = 0;
  auto written = picture.eachCell([&](std::size_t site, const Lines& rings) {
    print(text, FMT_COMPILE("<path id=\"cell-{}"), site);
    // Of a periodic domain.
    copy = site == last ? copy + 1 : 1;
    last = site;
    if (copy > 1) print(text, FMT_COMPILE("-{}"), copy);
    text.push_back('"');
    if (painted) {
      printColor(text, "fill", picture.color(site));
      printColor(text, "stroke", picture.color(site));
    }
    put(text, " d=\"");
    printLines(text, rings, "Z");
    put(text, "\"><title>");
    if (hasNames(picture.options()) && !picture.options().texts[site].empty()) {
      printEscaped(text, picture.options().texts[site]);
      put(text, ", ");
    }
    print(text, FMT_COMPILE("site {}, area {}</title></path>\n"), site, diagram.area[site]);
    return writeIfFull(sink, text);
  });
  put(text, "</g>\n");
  return written;
}

/// Begins a layer of lines that are not filled.
void beginLines(Bytes& text, std::string_view name, std::string_view clip, std::uint32_t color,
                double width) {
  beginLayer(text, name, clip);
  put(text, " fill=\"none\"");
  printColor(text, "stroke", color);
  if (const std::uint32_t alpha = color >> 24; alpha != opaque) {
    print(text, FMT_COMPILE(" stroke-opacity=\"{:.3g}\""), alpha / double{opaque});
  }
  printLength(text, "stroke-width", width);
  put(text, ">\n");
}

Result<void> writeEdges(ByteSink& sink, Bytes& text, const VectorPicture& picture) {
  beginLines(text, "edges", clipOf(picture), picture.edgeColor(), picture.edgeWidth());
  std::size_t lines_here = 0;
  auto written = picture.eachEdge([&](const Lines& lines) {
    if (lines_here == 0) put(text, "<path d=\"");
    printLines(text, lines, "");
    lines_here += lines.size();
    if (lines_here < lines_of_path) return Result<void>();
    lines_here = 0;
    put(text, "\"/>\n");
    return writeIfFull(sink, text);
  });
  if (lines_here > 0) put(text, "\"/>\n");
  if (const Lines outline = picture.outline(); !outline.empty()) {
    put(text, "<path");
    printLength(text, "stroke-width", picture.outlineWidth());
    put(text, " d=\"");
    printLines(text, outline, "Z");
    put(text, "\"/>\n");
  }
  put(text, "</g>\n");
  return written;
}

Result<void> writeDual(ByteSink& sink, Bytes& text, const VectorPicture& picture) {
  beginLines(text, "dual", clipOf(picture), dual_color, picture.edgeWidth());
  std::size_t lines_here = 0;
  for (const Line& line : picture.dual()) {
    put(text, lines_here == 0 ? "<path d=\"M" : "M");
    printPoint(text, line.from);
    put(text, "L");
    printPoint(text, line.to);
    if (++lines_here < lines_of_path) continue;
    lines_here = 0;
    put(text, "\"/>\n");
    VORPIPE_TRY(writeIfFull(sink, text));
  }
  put(text, lines_here > 0 ? "\"/>\n</g>\n" : "</g>\n");
  return {};
}

Result<void> writeDots(ByteSink& sink, Bytes& text, const VectorPicture& picture) {
  beginLayer(text, "sites", picture.hasNamedDots() ? std::string_view{} : clipOf(picture));
  printColor(text, "fill", picture.dotColor());
  const auto [radius, rim] = picture.dot();
  if (rim > 0) {
    printColor(text, "stroke", VectorPicture::rim_color);
    printLength(text, "stroke-width", rim);
  }
  put(text, ">\n");
  for (const Point& dot : picture.dots()) {
    put(text, "<circle");
    printLength(text, "cx", dot.x);
    printLength(text, "cy", dot.y);
    // Half of the line's width is inside, half outside.
    printLength(text, "r", radius - rim / 2);
    put(text, "/>\n");
    VORPIPE_TRY(writeIfFull(sink, text));
  }
  put(text, "</g>\n");
  return {};
}

void printBox(Bytes& text, const LegendBox& box) {
  printRectangle(text, box.left, box.top, box.width, box.height);
  printColor(text, "fill", box.rgba);
  if (const std::uint32_t alpha = box.rgba >> 24; alpha != opaque) {
    print(text, FMT_COMPILE(" fill-opacity=\"{:.3g}\""), alpha / double{opaque});
  }
  put(text, "/>\n");
}

/// Writes the color unless it is black.
void printText(Bytes& text, const LegendText& line) {
  constexpr std::string_view anchors[] = {"start", "middle", "end"};
  put(text, "<text");
  printLength(text, "x", line.x);
  printLength(text, "y", line.baseline);
  printLength(text, "font-size", fontSize(line.height));
  if (line.rgba != black) printColor(text, "fill", line.rgba);
  if (line.halo) {
    put(text, " paint-order=\"stroke\" stroke-linejoin=\"round\"");
    printColor(text, "stroke", *line.halo);
    printLength(text, "stroke-width", 2 * halo_part * line.height);
  }
  print(text, FMT_COMPILE(" text-anchor=\"{}\">"), anchors[static_cast<std::size_t>(line.anchor)]);
  printEscaped(text, line.text);
  put(text, "</text>\n");
}

void printLegend(Bytes& text, std::string_view layer, const Legend& legend) {
  beginLayer(text, layer);
  put(text, ">\n");
  for (const LegendBox& box : legend.boxes) printBox(text, box);
  print(text, FMT_COMPILE("<g{}>\n"), fonts);
  for (const LegendText& line : legend.texts) printText(text, line);
  put(text, "</g>\n</g>\n");
}

Result<void> writeLabels(ByteSink& sink, Bytes& text, const VectorPicture& picture) {
  beginLayer(text, "labels");
  print(text, FMT_COMPILE("{}>\n"), fonts);
  for (const SiteLabel& label : picture.labels()) {
    if (const auto box = picture.boxBelow(label)) printBox(text, *box);
    printText(text, picture.textOf(label));
    VORPIPE_TRY(writeIfFull(sink, text));
  }
  put(text, "</g>\n");
  return {};
}

Result<void> write(ByteSink& sink, const VectorPicture& picture, const Diagram& diagram) {
  Bytes text;
  printHead(text, picture);
  if (const auto background = picture.background()) {
    const auto width = static_cast<double>(picture.options().width),
               height = static_cast<double>(picture.options().height);
    beginLayer(text, "background");
    put(text, ">\n");
    printBox(text, {0, 0, width, height, background->rgba});
    put(text, "</g>\n");
  }
  VORPIPE_TRY(writeCells(sink, text, picture, diagram));
  if (picture.hasEdges()) {
    VORPIPE_TRY(writeEdges(sink, text, picture));
  }
  if (const Lines lines = picture.borders(); !lines.empty()) {
    beginLines(text, "borders", clipOf(picture), picture.edgeColor(), borderWidth(picture.options()));
    put(text, "<path d=\"");
    printLines(text, lines, "Z");
    put(text, "\"/>\n</g>\n");
  }
  if (!picture.dual().empty()) {
    VORPIPE_TRY(writeDual(sink, text, picture));
  }
  if (!picture.dots().empty()) {
    VORPIPE_TRY(writeDots(sink, text, picture));
  }
  if (const Lines lines = picture.graticule(); !lines.empty()) {
    beginLines(text, "graticule", "frame", graticule_color, picture.edgeWidth());
    put(text, "<path d=\"");
    printLines(text, lines, "");
    put(text, "\"/>\n</g>\n");
  }
  if (!picture.labels().empty()) {
    VORPIPE_TRY(writeLabels(sink, text, picture));
  }
  if (picture.legend()) printLegend(text, "legend", *picture.legend());
  if (!picture.sheet().legend.boxes.empty()) printLegend(text, "sheet", picture.sheet().legend);
  put(text, "</svg>\n");
  return writeAll(sink, text);
}

}  // namespace

Result<void> writeSvgPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads) {
  return writeShapes(sink, sites, diagram, options, threads,
                     [&](const VectorPicture& picture) { return write(sink, picture, diagram); });
}

}  // namespace vorpipe
