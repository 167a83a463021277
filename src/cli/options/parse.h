/// Parses the values of options. The error says what is wrong with the text, and continues "--option: ".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::cli {

template <class T>
using Parsed = tl::expected<T, std::string>;

/// The path of standard output, which `-` stands for.
inline constexpr std::string_view standard_output = "/dev/stdout";

/// A whole number from low to high.
Parsed<std::uint64_t> parseWhole(std::string_view text, std::uint64_t low, std::uint64_t high);

/// "a, b or c", as help and messages name them.
std::string anyOf(std::span<const std::string> words);

/// The names that parsePeriodic, parseSearch (which accepts more) and parseColor accept.
std::vector<std::string> periodicNames();
std::vector<std::string> searchNames();
std::vector<std::string> colorNames();

/// A box, in the plane or in space, the name of a file with an outline, or the hull of the sites; none of
/// them if not given.
struct DomainChoice {
  std::optional<Box> box{};
  std::optional<Box3> space{};
  std::string file{};  ///< empty: there is none
  bool hull = false;
};

/// A number of bytes above 0, with a unit or none: B; kB, MB, GB, TB, powers of 1000; KiB, MiB, GiB, TiB,
/// powers of 1024.
Parsed<std::uint64_t> parseBytes(std::string_view text);

/// `LON,LAT`, degrees of a place on the Earth.
Parsed<Point> parsePlace(std::string_view text);

/// `XMIN,YMIN,XMAX,YMAX`, a valid box.
Parsed<Box> parseBox(std::string_view text);

/// `XMIN,YMIN,XMAX,YMAX` or `XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX`, a valid box, `hull`, or a file name that ends in
/// .geojson, .json or .wkt.
Parsed<DomainChoice> parseDomain(std::string_view text);

/// Axes along which a domain repeats itself: of the plane, and of space.
struct AxesChoice {
  Periodic plane = Periodic::none;
  bool z = false;
  [[nodiscard]] bool any() const { return z || plane != Periodic::none; }
  [[nodiscard]] std::array<bool, 3> inSpace() const {
    return {plane == Periodic::x || plane == Periodic::xy, plane == Periodic::y || plane == Periodic::xy, z};
  }
  /// As parsePeriodic reads it.
  [[nodiscard]] std::string name() const;
};

/// Some of x, y and z, in this order, with or without commas.
Parsed<AxesChoice> parsePeriodic(std::string_view text);

/// Nine numbers: the vectors of a lattice.
Parsed<Lattice> parseLattice(std::string_view text);

struct WeightRange {
  double low = 0, high = 0;
};

/// `LO,HI`, LO not above HI.
Parsed<WeightRange> parseWeightRange(std::string_view text);

/// `WxH`, 1 to largest_side each.
Parsed<PictureSize> parseSize(std::string_view text);

/// `grid`, `flann` or `flann:K`.
Parsed<SearchOptions> parseSearch(std::string_view text);

/// One of backendNames().
Parsed<std::string> parseBackend(std::string_view text);

/// One of featureNames().
Parsed<std::string> parseFeature(std::string_view text);

/// `NAME=VALUE`, NAME one of limitNames().
Parsed<std::pair<std::string, std::uint64_t>> parseLimit(std::string_view text);

/// One of colorNames().
Parsed<ColorBy> parseColor(std::string_view text);

/// Own colors, the file with them, or the name of a map.
struct ColormapChoice {
  std::string name, file;
  std::vector<Color> colors;
};

/// A color without transparency.
Parsed<Color> parseOpaqueColor(std::string_view text);

/// One of colormaps(), two or more colors with commas between them, or a file.
Parsed<ColormapChoice> parseColormap(std::string_view text);

/// Different backendNames(), separated by commas.
Parsed<std::vector<std::string>> parseBackendList(std::string_view text);

/// A backend and one of its devices, as in `vulkan-compute:0`.
struct BackendDevice {
  std::string text;     ///< as it was given
  std::string backend;  ///< one of backendNames()
  std::string device;   ///< an index, or a part of a name; empty: not given
};

/// Different `NAME` or `NAME:DEVICE`, separated by commas.
Parsed<std::vector<BackendDevice>> parseBackendDevices(std::string_view text);

/// A file name with `extension`, such as ".png", or without any (/dev/stdout); any name if `extension` is
/// empty.
Parsed<std::string> parseFile(std::string_view text, std::string_view extension);

/// What pictures or files of steps go to.
enum class StepsTo : std::uint8_t { folder, folder_or_film };

/// Parses the name of a folder, or of a film, which ends in view::film_extension. The fault: it has the
/// extension of a file, and no such folder is there.
Parsed<std::string> parseFolder(std::string_view text, StepsTo to);

/// Parses @NAME, an attribute of the sites; returns its name.
Parsed<std::string> parseAttribute(std::string_view text);

/// The same, where the name may also stand without the @.
Parsed<std::string> parseAttributeWord(std::string_view text);

/// The formats of standard input and output, as extensions without the dot; empty if not given.
struct FormatChoice {
  std::string input, output;
};

/// Parses `KIND`, for both, or `IN,OUT`; any case. Whether a kind exists is checked by its reader or writer.
Parsed<FormatChoice> parseFormat(std::string_view text);

}  // namespace vorpipe::cli
