#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/try.h"
#include "io/base/print.h"
#include "io/pictures/deflate.h"
#include "io/pictures/pdf_font.h"
#include "io/pictures/vector_picture.h"

// PDF Reference, third edition (1.4): 3.4 (the file), 4.3 and 4.4 (drawing), 5.2 and 5.3 (text).

namespace vorpipe {
namespace {

constexpr double opaque = 0xFF;

/// Writes the objects of a file, and keeps their offsets for the table at its end.
class PdfFile final : public ByteSink {
 public:
  explicit PdfFile(ByteSink& to) : ByteSink(to.name()), to_(&to) {}

  Result<void> write(std::string_view bytes) override {
    size_ += bytes.size();
    return to_->write(bytes);
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Begins the next object, which ends with endobj; they are numbered from 1.
  Result<void> begin() {
    offsets_.push_back(size_);
    return write(fmt::format("{} 0 obj\n", offsets_.size()));
  }
  Result<void> add(std::string_view object) {
    VORPIPE_TRY(begin());
    VORPIPE_TRY(write(object));
    return write("\nendobj\n");
  }

  /// Ends the file; object 1 is its catalog.
  Result<void> finish() {
    const std::uint64_t table = size_;
    Bytes text;
    print(text, FMT_COMPILE("xref\n0 {}\n0000000000 65535 f \n"), offsets_.size() + 1);
    for (const std::uint64_t offset : offsets_) print(text, FMT_COMPILE("{:010} 00000 n \n"), offset);
    print(text, FMT_COMPILE("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n"),
          offsets_.size() + 1, table);
    return writeAll(*this, text);
  }

 private:
  ByteSink* to_;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> offsets_;
};

void put(Bytes& text, std::string_view more) { text.append(more); }

/// Sets a color, R in the lowest byte, by `rg` (fill) or `RG` (stroke).
void printColor(Bytes& text, std::uint32_t rgba, std::string_view operation) {
  const auto channel = [&](int shift) { return (rgba >> shift & 0xFF) / opaque; };
  print(text, FMT_COMPILE("{:.4g} {:.4g} {:.4g} {}\n"), channel(0), channel(8), channel(16), operation);
}

void printLength(Bytes& text, double pixels, std::string_view operation) {
  printPixels(text, pixels);
  print(text, FMT_COMPILE(" {}\n"), operation);
}

void printBox(Bytes& text, double left, double top, double width, double height) {
  printPoint(text, {left, top});
  text.push_back(' ');
  printPoint(text, {width, height});
  put(text, " re\n");
}

/// Appends a short arc up to its end.
void printArc(Bytes& text, const PixelArc& arc, Point end) {
  for (const Point handle : arc.handles()) {
    printPoint(text, handle);
    text.push_back(' ');
  }
  printPoint(text, end);
  put(text, " c\n");
}

void printLines(Bytes& text, const Lines& lines, bool closed) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto line = lines[k];
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (const PixelArc* arc = lines.arcTo(k, i)) {
        printArc(text, *arc, line[i]);
        continue;
      }
      printPoint(text, line[i]);
      put(text, i == 0 ? " m\n" : " l\n");
    }
    if (closed) put(text, "h\n");
  }
}

/// Names of resources for drawing: a dot, the font, and an opacity out of 255.
constexpr std::string_view dot_name = "/Dot", font_name = "/Font";
std::string opacityName(std::uint32_t rgba) { return fmt::format("/Alpha{}", rgba >> 24); }

Result<void> writeCells(ByteSink& page, Bytes& text, const VectorPicture& picture) {
  if (picture.cellsShowBackground()) return {};
  printLength(text, VectorPicture::seam_width, "w");
  std::uint32_t last = 0;
  return picture.eachCell([&](std::size_t site, const Lines& rings) {
    const std::uint32_t color = picture.color(site);
    if (color != last) {
      printColor(text, color, "rg");
      printColor(text, color, "RG");
      last = color;
    }
    printLines(text, rings, /*closed=*/true);
    put(text, "B*\n");
    return writeIfFull(page, text);
  });
}

Result<void> writeEdges(ByteSink& page, Bytes& text, const VectorPicture& picture) {
  printColor(text, picture.edgeColor(), "RG");
  printLength(text, picture.edgeWidth(), "w");
  VORPIPE_TRY(picture.eachEdge([&](const Lines& lines) {
    printLines(text, lines, /*closed=*/false);
    put(text, "S\n");
    return writeIfFull(page, text);
  }));
  if (const Lines outline = picture.outline(); !outline.empty()) {
    printLength(text, picture.outlineWidth(), "w");
    printLines(text, outline, /*closed=*/true);
    put(text, "S\n");
  }
  return {};
}

Result<void> writeDual(ByteSink& page, Bytes& text, const VectorPicture& picture) {
  printColor(text, dual_color, "RG");
  printLength(text, picture.edgeWidth(), "w");
  for (const Line& line : picture.dual()) {
    printPoint(text, line.from);
    put(text, " m\n");
    printPoint(text, line.to);
    put(text, " l\nS\n");
    VORPIPE_TRY(writeIfFull(page, text));
  }
  return {};
}

Result<void> writeDots(ByteSink& page, Bytes& text, const VectorPicture& picture) {
  for (const Point& dot : picture.dots()) {
    put(text, "q 1 0 0 1 ");
    printPoint(text, dot);
    print(text, FMT_COMPILE(" cm {} Do Q\n"), dot_name);
    VORPIPE_TRY(writeIfFull(page, text));
  }
  return {};
}

/// Writes it in one stroke, so that lines are no darker where they meet.
Result<void> writeGraticule(ByteSink& page, Bytes& text, const VectorPicture& picture) {
  const Lines lines = picture.graticule();
  if (lines.empty()) return {};
  const Box clip = picture.clip();
  put(text, "q\n");
  printBox(text, clip.xmin, clip.ymin, clip.xmax - clip.xmin, clip.ymax - clip.ymin);
  print(text, FMT_COMPILE("W n\n{} gs\n"), opacityName(graticule_color));
  printColor(text, graticule_color, "RG");
  printLength(text, picture.edgeWidth(), "w");
  printLines(text, lines, /*closed=*/false);
  put(text, "S\nQ\n");
  return writeIfFull(page, text);
}

void printText(Bytes& text, const PdfFont& font, const LegendText& line) {
  const double size = line.height / PdfFont::capital_height, width = size * font.widthOf(line.text);
  const double left = line.x - (line.anchor == Anchor::start ? 0
                                : line.anchor == Anchor::end ? width
                                                             : width / 2);
  // The page's y goes downward, but that of letters upward.
  print(text, FMT_COMPILE("BT {} {:.6g} Tf 1 0 0 -1 "), font_name, size);
  printPoint(text, {left, line.baseline});
  put(text, " Tm ");
  font.print(text, line.text);
  put(text, " Tj ET\n");
}

/// Paints a box by its color's opacity, which stays set.
void paintBox(Bytes& text, const LegendBox& box) {
  print(text, FMT_COMPILE("{} gs\n"), opacityName(box.rgba));
  printColor(text, box.rgba, "rg");
  printBox(text, box.left, box.top, box.width, box.height);
  put(text, "f\n");
}

void printLegend(Bytes& text, const PdfFont& font, const Legend& legend) {
  for (const LegendBox& box : legend.boxes) paintBox(text, box);
  std::uint32_t last = black;
  put(text, "0 g\n");
  for (const LegendText& line : legend.texts) {
    if (line.rgba != last) printColor(text, line.rgba, "rg");
    last = line.rgba;
    printText(text, font, line);
  }
}

Result<void> writeLabels(ByteSink& page, Bytes& text, const PdfFont& font, const VectorPicture& picture) {
  for (const SiteLabel& label : picture.labels()) {
    const std::uint32_t color = picture.color(label.site);
    if (const auto box = picture.boxBelow(label)) {
      printColor(text, color, "rg");
      printBox(text, box->left, box->top, box->width, box->height);
      put(text, "f\n");
    }
    const LegendText line = picture.textOf(label);
    if (line.halo) {
      printColor(text, *line.halo, "RG");
      printLength(text, 2 * halo_part * line.height, "w");
      put(text, "1 Tr\n");
      printText(text, font, line);
      put(text, "0 Tr\n");
    }
    printColor(text, line.rgba, "rg");
    printText(text, font, line);
    VORPIPE_TRY(writeIfFull(page, text));
  }
  return {};
}

/// The size of a pixel in points.
struct Points {
  double across, down;

  static Points of(const VectorPicture& picture) {
    if (const auto& paper = picture.paper()) {
      constexpr double of_millimeter = 72 / 25.4;
      return {of_millimeter * paper->width / picture.width(),
              of_millimeter * paper->height / picture.height()};
    }
    constexpr double of_pixel = 0.75, most = 14400;
    const double points = std::min(of_pixel, most / std::max(picture.width(), picture.height()));
    return {points, points};
  }
};

/// Writes the page's contents; the unit is a pixel, and y goes downward.
Result<void> writeContents(ByteSink& page, const VectorPicture& picture, const PdfFont& font,
                           const Points& points) {
  Bytes text;
  print(text, FMT_COMPILE("{} 0 0 -{} {} {} cm 1 j 1 J\nq\n"), points.across, points.down,
        points.across * picture.sheet().left, points.down * (picture.height() - picture.sheet().top));
  if (const auto background = picture.background()) {
    const LegendBox paper{0, 0, static_cast<double>(picture.options().width),
                          static_cast<double>(picture.options().height), background->rgba};
    paintBox(text, paper);
    put(text, "Q q\n");
  }
  const Box clip = picture.clip();
  printBox(text, clip.xmin, clip.ymin, clip.xmax - clip.xmin, clip.ymax - clip.ymin);
  put(text, "W n\n");
  VORPIPE_TRY(writeCells(page, text, picture));
  if (const Lines outline = picture.outline(); !outline.empty()) {
    printLines(text, outline, /*closed=*/true);
    put(text, "W* n\n");
  }
  if (picture.hasEdges()) {
    VORPIPE_TRY(writeEdges(page, text, picture));
  }
  if (const Lines lines = picture.borders(); !lines.empty()) {
    printColor(text, picture.edgeColor(), "RG");
    printLength(text, borderWidth(picture.options()), "w");
    printLines(text, lines, /*closed=*/true);
    put(text, "S\n");
  }
  if (!picture.dual().empty()) {
    VORPIPE_TRY(writeDual(page, text, picture));
  }
  if (!picture.hasNamedDots()) {
    VORPIPE_TRY(writeDots(page, text, picture));
  }
  put(text, "Q\n");
  VORPIPE_TRY(writeGraticule(page, text, picture));
  if (picture.hasNamedDots()) {
    VORPIPE_TRY(writeDots(page, text, picture));
  }
  VORPIPE_TRY(writeLabels(page, text, font, picture));
  if (picture.legend()) printLegend(text, font, *picture.legend());
  if (!picture.sheet().legend.boxes.empty()) printLegend(text, font, picture.sheet().legend);
  return writeAll(page, text);
}

/// Appends a circle about the origin, of four curves, exact to a quarter of a thousandth.
void printCircle(Bytes& text, double radius) {
  constexpr double handle = 0.5522847498;
  const double r = radius, h = handle * radius;
  const Point quarters[4][3] = {{{r, h}, {h, r}, {0, r}},
                                {{-h, r}, {-r, h}, {-r, 0}},
                                {{-r, -h}, {-h, -r}, {0, -r}},
                                {{h, -r}, {r, -h}, {r, 0}}};
  printPoint(text, {r, 0});
  put(text, " m\n");
  for (const auto& quarter : quarters) {
    join(text, 3, " ", [&](Bytes& out, std::size_t k) { printPoint(out, quarter[k]); });
    put(text, " c\n");
  }
}

/// Returns a dot about the origin, as an object of its own.
std::string dotObject(const VectorPicture& picture) {
  Bytes text;
  const auto [radius, rim] = picture.dot();
  printColor(text, picture.dotColor(), "rg");
  if (rim > 0) {
    printColor(text, VectorPicture::rim_color, "RG");
    printLength(text, rim, "w");
  }
  // Half of the line's width is inside, half outside.
  printCircle(text, radius - rim / 2);
  put(text, rim > 0 ? "b\n" : "f\n");
  return fmt::format(
      "<< /Type /XObject /Subtype /Form /BBox [{0} {0} {1} {1}] /Resources << >> /Length {2} >>\n"
      "stream\n{3}\nendstream",
      -radius - 1, radius + 1, text.size(), std::string_view(text.data(), text.size()));
}

/// Numbers of the page, its contents, and the objects after them.
constexpr int page_object = 3, contents_object = 4, length_object = 5, dot_object = 6, font_object = 7;

bool hasText(const VectorPicture& picture) {
  return picture.legend() || !picture.labels().empty() || !picture.sheet().legend.texts.empty();
}

std::string pageObject(const VectorPicture& picture, const Points& points) {
  std::set<std::uint32_t> opacities;
  if (picture.background()) opacities.insert(picture.background()->alpha());
  if (picture.legend()) {
    for (const LegendBox& box : picture.legend()->boxes) opacities.insert(box.rgba >> 24);
  }
  for (const LegendBox& box : picture.sheet().legend.boxes) opacities.insert(box.rgba >> 24);
  const bool has_graticule = !picture.graticule().empty();
  if (has_graticule) opacities.insert(graticule_color >> 24);
  std::string states;
  for (const std::uint32_t opacity : opacities) {
    const double part = opacity / opaque;
    states += fmt::format("{} << /ca {:.3g} ", opacityName(opacity << 24), part);
    states += has_graticule ? fmt::format("/CA {:.3g} >> ", part) : ">> ";
  }
  const std::string fonts =
      hasText(picture) ? fmt::format("/Font << {} {} 0 R >> ", font_name, font_object) : std::string();
  return fmt::format(
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents {} 0 R\n"
      "/Resources << {}/XObject << {} {} 0 R >> /ExtGState << {}>> >> >>",
      points.across * picture.width(), points.down * picture.height(), contents_object, fonts, dot_name,
      dot_object, states);
}

Result<void> writeFile(ByteSink& sink, const VectorPicture& picture) {
  const Points points = Points::of(picture);
  const PdfFont font;
  PdfFile file(sink);
  // Bytes above 127 show file transfer programs that this is no text.
  VORPIPE_TRY(file.write("%PDF-1.4\n%\xE2\xE3\xCF\xD3\n"));
  VORPIPE_TRY(file.add("<< /Type /Catalog /Pages 2 0 R >>"));
  VORPIPE_TRY(file.add(fmt::format("<< /Type /Pages /Kids [{} 0 R] /Count 1 >>", page_object)));
  VORPIPE_TRY(file.add(pageObject(picture, points)));
  VORPIPE_TRY(file.begin());
  VORPIPE_TRY(file.write(fmt::format("<< /Length {} 0 R /Filter /FlateDecode >>\nstream\n", length_object)));
  const std::uint64_t begin = file.size();
  DeflateSink page(file);
  VORPIPE_TRY(writeContents(page, picture, font, points));
  VORPIPE_TRY(page.finish());
  const std::uint64_t length = file.size() - begin;
  VORPIPE_TRY(file.write("\nendstream\nendobj\n"));
  VORPIPE_TRY(file.add(std::to_string(length)));
  VORPIPE_TRY(file.add(dotObject(picture)));
  if (hasText(picture)) {
    for (const std::string& object : font.objects(font_object)) {
      VORPIPE_TRY(file.add(object));
    }
  }
  return file.finish();
}

}  // namespace

Result<void> writePdfPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads) {
  const PdfFont font;
  VORPIPE_TRY(
      checkLetters(options, "the font of a .pdf", [&](std::string_view text) { return font.has(text); }));
  return writeShapes(sink, sites, diagram, options, threads,
                     [&](const VectorPicture& picture) { return writeFile(sink, picture); });
}

}  // namespace vorpipe
