#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <bit>

#include "arrays.h"
#include "errors.h"
#include "io/files/extension.h"
#include "io/files/output_file.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"
#include "results.h"

namespace vorpipe::python {
namespace {

static_assert(std::endian::native == std::endian::little, "R is the lowest byte of a pixel, and its first");

using Shared = std::shared_ptr<PictureResult>;

std::shared_ptr<const PictureResult> asOwner(const Shared& result) { return result; }

py::array rgbaOf(const Shared& result) {
  const Image& image = result->rendering.image;
  return viewOf<std::uint8_t>(image.rgba.data(), {image.height, image.width, 4}, asOwner(result));
}

py::array idsOf(const Shared& result) {
  const Image& image = result->rendering.image;
  return viewOf<std::uint32_t>(image.ids.data(), {image.height, image.width}, asOwner(result));
}

Result<void> writeFile(const Image& image, const std::string& path, bool as_png) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  auto written = as_png ? writePng(*file, image.width, image.height, image.rgba)
                        : writeNpyIds(*file, image.width, image.height, image.ids);
  return written ? file->commit() : written;
}

void save(const PictureResult& result, const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension != ".png" && extension != ".npy") {
    raiseInput("path", path + ": unknown kind of file for pictures; known are .png, and .npy for the ids");
  }
  auto written = [&] {
    const py::gil_scoped_release no_gil;
    return writeFile(result.rendering.image, path, extension == ".png");
  }();
  valueOf(std::move(written));
}

}  // namespace

void definePicture(py::module_& module) {
  py::class_<PictureResult, Shared>(module, "Picture", "The arrays of a picture.")
      .def_property_readonly(
          "input", [](const PictureResult& result) { return std::const_pointer_cast<Input>(result.input); })
      .def_property_readonly(
          "report",
          [](const Shared& result) { return std::shared_ptr<Report>(result, &result->rendering.report); })
      .def_property_readonly("rgba", &rgbaOf)
      .def_property_readonly("ids", &idsOf)
      .def_property_readonly("status",
                             [](const Shared& result) {
                               return viewOf<std::uint8_t>(result->rendering.status, asOwner(result));
                             })
      .def_property_readonly("owner",
                             [](const Shared& result) {
                               return viewOf<std::uint32_t>(result->rendering.owner, asOwner(result));
                             })
      .def("save", &save, py::arg("path"));
  module.def("colormaps", &colormaps);
}

}  // namespace vorpipe::python
