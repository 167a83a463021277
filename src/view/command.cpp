#include "view/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "base/option_rows.h"

namespace vorpipe::view {
namespace {

/// Collects the arguments of a command line.
class Arguments {
 public:
  explicit Arguments(std::vector<std::string> first) : all_(std::move(first)) {}

  void flag(bool is_set, std::string_view name) {
    if (is_set) all_.emplace_back(name);
  }
  /// A value that begins like an option is joined to its name with =.
  template <class Value>
  void add(std::string_view name, const Value& value) {
    std::string text = fmt::format("{}", value);
    if (text.starts_with('-')) {
      all_.push_back(fmt::format("{}={}", name, text));
    } else {
      all_.emplace_back(name);
      all_.push_back(std::move(text));
    }
  }
  /// A value that differs from the default.
  template <class Value>
  void option(std::string_view name, const Value& value, const Value& usual) {
    if (value != usual) add(name, value);
  }
  void box(std::string_view name, const Box& box) {
    add(name, fmt::format("{},{},{},{}", box.xmin, box.ymin, box.xmax, box.ymax));
  }
  void append(const std::vector<std::string>& more) { all_.insert(all_.end(), more.begin(), more.end()); }
  std::vector<std::string> take() { return std::move(all_); }

 private:
  std::vector<std::string> all_;
};

void addSites(Arguments& to, const Document& document, const CommandFiles& files) {
  const Opened& opened = document.opened();
  if (document.isAsOpened() && !opened.arguments.empty()) return to.append(opened.arguments);
  to.add("--sites", files.sites);
  if (opened.outline.empty()) {
    to.box("--domain", opened.domain);
  } else {
    to.add("--domain", files.outline);
  }
  if (opened.periodic != Periodic::none) to.add("--periodic", nameOf(opened.periodic));
}

void addColors(Arguments& to, const RenderOptions& picture) {
  to.flag(!picture.fill, "--no-fill");
  if (picture.color != ColorBy::site) to.add("--color", nameOf(picture.color));
  if (picture.colors.empty()) {
    to.option("--colormap", colormapOf(picture), colormapOf({}));
  } else {
    std::vector<std::string> colors;
    for (const Color& color : picture.colors) colors.push_back(textOf(color));
    to.add("--colormap", fmt::format("{}", fmt::join(colors, ",")));
  }
  if (picture.color_scale != ColorScale::automatic) {
    to.add("--color-scale", nameOf(picture.color_scale));
  }
  if (picture.color_range) {
    to.add("--color-range", fmt::format("{},{}", picture.color_range->low, picture.color_range->high));
  }
  to.flag(picture.legend, "--legend");
}

void addMarks(Arguments& to, const RenderOptions& picture) {
  forEachRow(picture_rows, [&](const auto& row) {
    const auto& value = picture.*row.member;
    if constexpr (requires { row.of; }) {
      const auto draws = [&](const auto* flag) { return flag != nullptr && picture.*flag->member; };
      if (row.of[0] == nullptr || draws(row.of[0]) || draws(row.of[1])) {
        if constexpr (requires { textOf(*value); }) {
          if (value) to.add(flagOf(row), textOf(*value));
        } else {
          to.option(flagOf(row), value, RenderOptions{}.*row.member);
        }
      }
    } else {
      to.flag(value, flagOf(row));
    }
  });
  if (const SearchOptions& search = picture.search; search.method == Search::flann) {
    to.add("--search", fmt::format("flann:{}", search.neighbors));
  }
}

void addBackend(Arguments& to, const BackendOptions& backend) {
  const BackendOptions usual{};
  to.option("--backend", backend.name, usual.name);
  to.option("--device", backend.device, usual.device);
  if (backend.threads > 0) to.add("--threads", backend.threads);
  for (const std::string& feature : backend.mask.disabled) to.add("--disable", feature);
  for (const auto& [name, value] : backend.mask.limits) to.add("--limit", fmt::format("{}={}", name, value));
}

void addPicture(Arguments& to, const RenderOptions& picture, const BackendOptions& backend) {
  if (picture.view) to.box("--view", *picture.view);
  to.add("--size", fmt::format("{}x{}", picture.width, picture.height));
  // The view already has the picture's aspect ratio.
  to.add("--fit", "stretch");
  addColors(to, picture);
  addMarks(to, picture);
  addBackend(to, backend);
}

}  // namespace

std::vector<std::string> commandFor(const Document& document, const RenderOptions& picture,
                                    const BackendOptions& backend, const CommandFiles& files) {
  Arguments arguments({"vorpipe", "render"});
  addSites(arguments, document, files);
  addPicture(arguments, picture, backend);
  arguments.add("-o", files.picture);
  return arguments.take();
}

std::vector<std::string> commandForFluid(const std::string& checkpoint, const RenderOptions& picture,
                                         FlowColor color, const BackendOptions& backend) {
  Arguments arguments({"vorpipe", "fluid"});
  arguments.add("--resume", checkpoint);
  arguments.add("--steps", 100);
  // `vorpipe fluid` takes no masks.
  BackendOptions unmasked = backend;
  unmasked.mask = {};
  addPicture(arguments, picture, unmasked);
  arguments.add("--flow-color", nameOf(color));
  arguments.add("--frames", "frames");
  return arguments.take();
}

}  // namespace vorpipe::view
