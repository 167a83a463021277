#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "io/base/extension.h"
#include "io/pictures/georeference.h"
#include "io/pictures/picture_file.h"
#include "io/pictures/png_file.h"
#include "look.h"
#include "members.h"
#include "results.h"
#include "saving.h"

namespace vorpipe::python {
namespace {

static_assert(std::endian::native == std::endian::little, "R is the lowest byte of a pixel, and its first");

using SharedPicture = std::shared_ptr<PictureResult>;

std::shared_ptr<const PictureResult> asOwner(const SharedPicture& result) { return result; }

py::array rgbaOf(const SharedPicture& result) {
  const Image& image = result->rendering.image;
  return viewOf<std::uint8_t>(image.rgba.data(), {image.height, image.width, 4}, asOwner(result));
}

py::array idsOf(const SharedPicture& result) {
  const Image& image = result->rendering.image;
  return viewOf<std::uint32_t>(image.ids.data(), {image.height, image.width}, asOwner(result));
}

/// Where the picture lies: xmin, xmax, ymin, ymax. The domain or the view, and what stands beside it.
std::array<double, 4> extentOf(const PictureResult& result) {
  const auto& [width, height] = std::pair(result.options.width, result.options.height);
  const PixelGrid grid = pixelGridOf(shownBox(result.options), shownFrame(result.options));
  return {grid.left, grid.left + width * grid.width, grid.top - height * grid.height, grid.top};
}

/// Of pixels, and then of ids.
std::string pixelExtensions() {
  std::vector<std::string_view> extensions;
  for (const std::string_view extension : pictureExtensions()) {
    if (!(*pictureFormatOf("picture" + std::string(extension)))->of_shapes) extensions.push_back(extension);
  }
  return fmt::format("{}, and for the ids {}", fmt::join(extensions, ", "), fmt::join(idsExtensions(), ", "));
}

void savePicture(const PictureResult& result, const std::string& path) {
  const PictureOutput output{
      result.input->sites, result.options, &result.rendering.image, nullptr, result.input->system, 0,
      result.rendering.key};
  if (const auto ids = idsFormatOf(path)) {
    saveFile(path, result.input->files, [&](ByteSink& sink) { return (*ids)->write(sink, output); });
    return;
  }
  const auto format = pictureFormatOf(path);
  if (!format) {
    raiseInput("path",
               fmt::format("{}: unknown kind of file for pictures; known are {}", path, pixelExtensions()));
  }
  if ((*format)->of_shapes) {
    raiseInput("path", fmt::format("{}: is made of cells, not of pixels: call vorpipe.draw", path));
  }
  saveFile(path, result.input->files, [&](ByteSink& sink) { return (*format)->write(sink, output); });
}

void defineKey(py::module_& module) {
  py::class_<ColorKey>(module, "ColorKey", "What the colors of a picture stand for.")
      .def_property_readonly("color",
                             [](const ColorKey& key) {
                               return key.color == ColorBy::value ? std::string_view("values")
                                                                  : nameOf(key.color);
                             })
      .def_property_readonly("scale", [](const ColorKey& key) { return nameOf(key.scale); })
      .def_property_readonly("range",
                             [](const ColorKey& key) { return std::pair(key.range.low, key.range.high); })
      .def_readonly("ticks", &ColorKey::ticks)
      .def_readonly("title", &ColorKey::title)
      .def_readonly("names", &ColorKey::names)
      .def(pickles<ColorKey>());
}

/// Draws cells of SharedSession::shapes, with the same look.
void saveShapes(const CellsResult& cells, const Look& look, const std::string& path, int threads) {
  const PictureFormat& format = shapesFormatOf(path);
  const Input& input = *cells.input;
  RenderOptions options = renderOptionsOf(look, input);
  valueOf(takeColors(look, input, threads, options));
  const PictureOutput output{input.sites, options, nullptr, &cells.diagram, input.system, threads};
  saveFile(path, input.files, [&](ByteSink& sink) { return format.write(sink, output); });
}

/// Pixels of shape (H, W, 4) as the bytes of a PNG.
py::bytes pngOf(const py::array_t<std::uint8_t, py::array::c_style>& rgba) {
  const auto height = static_cast<int>(rgba.shape(0)), width = static_cast<int>(rgba.shape(1));
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(rgba.size()) / 4);
  std::memcpy(pixels.data(), rgba.data(), static_cast<std::size_t>(rgba.size()));
  MemorySink sink(".png");
  auto written = [&] {
    const WithoutGil no_gil;
    return writePng(sink, width, height, pixels);
  }();
  valueOf(std::move(written));
  return sink.take();
}

}  // namespace

const PictureFormat& shapesFormatOf(const std::string& path) {
  const auto format = pictureFormatOf(path);
  if (format && (*format)->of_shapes) return **format;
  std::vector<std::string_view> extensions;
  for (const std::string_view extension : pictureExtensions()) {
    if ((*pictureFormatOf("picture" + std::string(extension)))->of_shapes) extensions.push_back(extension);
  }
  raiseInput("path", fmt::format("{}: unknown kind of file for drawings; known are {}; of pixels "
                                 "vorpipe.render makes pictures",
                                 path, fmt::join(extensions, ", ")));
}

void definePicture(py::module_& module) {
  defineKey(module);
  py::class_<PictureResult, SharedPicture>(module, "Picture", "The arrays of a picture.")
      .def_property_readonly(
          "input", [](const PictureResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly("report",
                             [](const SharedPicture& result) {
                               return std::shared_ptr<Report>(result, &result->rendering.report);
                             })
      .def_property_readonly("rgba", &rgbaOf)
      .def_property_readonly("ids", &idsOf)
      .def_property_readonly("extent", &extentOf)
      .def_property_readonly("key", [](const PictureResult& result) { return result.rendering.key; })
      .def_property_readonly("status",
                             [](const SharedPicture& result) {
                               return viewOf<std::uint8_t>(result->rendering.status, asOwner(result));
                             })
      .def_property_readonly("owner",
                             [](const SharedPicture& result) {
                               return viewOf<std::int32_t>(result->rendering.owner, asOwner(result));
                             })
      .def("save", &savePicture, py::arg("path"))
      .def(pickles<PictureResult>());
  module.def("png_of", &pngOf, py::arg("rgba"));
  module.def("save_shapes", &saveShapes, py::arg("cells"), py::arg("look"), py::arg("path"),
             py::arg("threads"));
  module.def("colormaps", &colormaps);
}

}  // namespace vorpipe::python
