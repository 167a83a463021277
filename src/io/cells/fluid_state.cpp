#include "io/cells/fluid_state.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/option_names.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/npy_array.h"
#include "io/base/quoted.h"
#include "io/cells/npz_arrays.h"

namespace vorpipe {
namespace {

template <class Value>
std::span<const Value> one(const Value& value) {
  return {&value, 1};
}

std::vector<Point> pointsOf(const std::vector<double>& numbers) {
  std::vector<Point> points;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) points.push_back({numbers[k], numbers[k + 1]});
  return points;
}

constexpr std::array<std::string_view, 28> array_names{
    "sites",    "weights", "velocity",         "volume",       "density",   "pressure",
    "trend",    "order",   "domain",           "gravity",      "carried",   "time",
    "until",    "length",  "epsilon",          "tolerance",    "step",      "diagrams",
    "periodic", "surface", "scheme",           "viscosity",    "centering", "walls",
    "case",     "outline", "outline_polygons", "outline_rings"};

/// Refuses unknown arrays. A state is all that later steps depend on, so an unknown array is probably a
/// misspelled one.
Result<void> checkNames(const NpzFile& file) {
  for (const std::string& name : file.names()) {
    if (std::ranges::find(array_names, name) != array_names.end()) continue;
    // Also finds plurals and longer words.
    constexpr std::size_t same = 3;
    const auto meant = std::ranges::find_if(
        array_names, [&](std::string_view known) { return name.substr(0, same) == known.substr(0, same); });
    return inputError(fmt::format("{}: a fluid has no array {}; {}", file.name(), inQuotes(name),
                                  meant != array_names.end()
                                      ? fmt::format("did you mean {}?", *meant)
                                      : fmt::format("known are {}", fmt::join(array_names, ", "))));
  }
  return {};
}

/// Reads arrays one after the other; keeps the first error.
class Reader {
 public:
  explicit Reader(const NpzFile& file) : file_(file) {}

  template <class Number>
  std::vector<Number> many(const char* name, std::uint64_t columns = 1) {
    auto read = file_.numbers<Number>(name, columns);
    if (read) return std::move(*read);
    if (!error) error = std::move(read.error());
    return {};
  }
  /// Reads `count` numbers; empty if there is no such array.
  template <class Number>
  std::vector<Number> several(const char* name, std::size_t count) {
    auto read = many<Number>(name);
    if (!error && file_.has(name) && read.size() != count)
      refuse(fmt::format("{} has {} numbers, not {}", name, read.size(), count));
    return error ? std::vector<Number>() : read;
  }
  /// Reads a number; without one, `value` stays.
  template <class Number>
  void single(const char* name, Number& value) {
    const auto read = several<Number>(name, 1);
    if (!read.empty()) value = read.front();
  }
  /// The same for one of the names of an enumeration, as text or by its number.
  template <Named Name>
  void name(const char* array, Name& value) {
    const auto& names = names_of<Name>;
    if (const auto text = file_.text(array)) {
      const auto found = valueNamed<Name>(*text);
      if (!found)
        return refuse(fmt::format("{} is {}, not one of {}", array, inQuotes(*text), fmt::join(names, ", ")));
      value = *found;
      return;
    }
    auto number = static_cast<std::uint8_t>(value);
    single(array, number);
    if (number >= names.size()) refuse(fmt::format("{} is {}, not below {}", array, number, names.size()));
    value = static_cast<Name>(number);
  }
  void refuse(const std::string& what) {
    if (!error) error = Error{ErrorCode::input, fmt::format("{}: {}", file_.name(), what)};
  }

  std::optional<Error> error;

 private:
  const NpzFile& file_;
};

/// A case by its name or its number.
std::optional<FluidCase> caseIn(Reader& read, const NpzFile& file) {
  if (!file.has("case")) return std::nullopt;
  const std::vector<std::string> names = fluidCaseNames();
  std::string name;
  std::uint8_t number = 0;
  if (const auto text = file.text("case")) {
    name = *text;
  } else {
    read.single("case", number);
    name = number < names.size() ? names[number] : std::to_string(number);
  }
  const auto known = fluidCaseOf(name);
  if (!known) read.refuse(fmt::format("case is {}, not one of {}", inQuotes(name), fmt::join(names, ", ")));
  return known;
}

/// Without offsets the outline is one ring.
Outline outlineIn(Reader& read, const NpzFile& file) {
  Outline outline;
  outline.points = pointsOf(read.many<double>("outline", 2));
  if (outline.empty()) return {};
  const auto offsets = [&](const char* name, std::uint64_t count) {
    if (!file.has(name)) return std::vector<std::uint64_t>{0, count};
    auto found = read.many<std::uint64_t>(name);
    const bool fit =
        found.size() > 1 && found.front() == 0 && found.back() == count && std::ranges::is_sorted(found);
    if (!fit) read.refuse(fmt::format("{} does not go from 0 to {}", name, count));
    return found;
  };
  outline.ring_offsets = offsets("outline_rings", outline.points.size());
  outline.polygon_offsets = offsets("outline_polygons", outline.ring_offsets.size() - 1);
  return outline;
}

}  // namespace

Result<void> writeFluid(ByteSink& sink, const FluidState& state, const FluidOptions& options) {
  std::vector<Point> positions;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    positions.push_back({state.sites.x[i], state.sites.y[i]});
  }
  const Box& box = options.domain;
  const std::array<double, 4> domain{box.xmin, box.ymin, box.xmax, box.ymax};
  const std::array<std::uint8_t, 3> names{static_cast<std::uint8_t>(options.periodic),
                                          static_cast<std::uint8_t>(options.surface),
                                          static_cast<std::uint8_t>(schemeOf(options))};
  NpzArrays arrays;
  arrays.addUnlessEmpty<double, 2>("sites", positions);
  arrays.addUnlessEmpty<double>("weights", state.sites.weight);
  arrays.addUnlessEmpty<double, 2>("velocity", state.velocity);
  arrays.addUnlessEmpty<double>("volume", state.volume);
  arrays.addUnlessEmpty<double>("density", state.density);
  arrays.addUnlessEmpty<double>("pressure", state.pressure);
  arrays.addUnlessEmpty<double>("trend", state.trend);
  arrays.addUnlessEmpty<std::uint32_t>("order", state.order);
  arrays.add<double>("domain", domain);
  arrays.add<double>("gravity", std::span(&options.gravity.x, 2));
  if (state.carried.x != 0 || state.carried.y != 0)
    arrays.add<double>("carried", std::span(&state.carried.x, 2));
  arrays.add<double>("time", one(state.time));
  arrays.add<double>("until", one(options.until));
  arrays.add<double>("length", one(options.step));
  const double epsilon = options.epsilon != 0 ? options.epsilon : state.epsilon;
  arrays.add<double>("epsilon", one(epsilon));
  arrays.add<double>("tolerance", one(options.tolerance));
  arrays.add<std::uint64_t>("step", one(state.step));
  arrays.add<std::uint64_t>("diagrams", one(options.diagrams));
  arrays.add<std::uint8_t>("periodic", one(names[0]));
  arrays.add<std::uint8_t>("surface", one(names[1]));
  arrays.add<std::uint8_t>("scheme", one(names[2]));
  if (options.viscosity != 0) arrays.add<double>("viscosity", one(options.viscosity));
  if (options.centering != 0) arrays.add<double>("centering", one(options.centering));
  const auto walls = static_cast<std::uint8_t>(options.walls);
  if (walls != 0) arrays.add<std::uint8_t>("walls", one(walls));
  const auto known = static_cast<std::uint8_t>(options.known.value_or(FluidCase{}));
  if (options.known) arrays.add<std::uint8_t>("case", one(known));
  const Outline& outline = options.outline;
  arrays.addUnlessEmpty<double, 2>("outline", outline.points);
  arrays.addUnlessEmpty<std::uint64_t>("outline_rings", outline.ring_offsets);
  arrays.addUnlessEmpty<std::uint64_t>("outline_polygons", outline.polygon_offsets);
  return arrays.write(sink);
}

Result<FluidSetup> readFluid(const std::string& path) {
  VORPIPE_LET(file, NpzFile::read(path));
  for (const char* needed : {"sites", "domain"}) {
    if (!file.has(needed)) return inputError(fmt::format("{}: it has no array {}", path, needed));
  }
  FluidSetup setup{};
  FluidState& state = setup.state;
  FluidOptions& options = setup.options;
  VORPIPE_TRY(checkNames(file));
  Reader read(file);
  for (const Point position : pointsOf(read.many<double>("sites", 2))) {
    state.sites.x.push_back(position.x);
    state.sites.y.push_back(position.y);
  }
  state.sites.weight = read.many<double>("weights");
  state.velocity = pointsOf(read.many<double>("velocity", 2));
  state.volume = read.many<double>("volume");
  state.density = read.many<double>("density");
  state.pressure = read.many<double>("pressure");
  state.trend = read.many<double>("trend");
  state.order = read.many<std::uint32_t>("order");
  const auto domain = read.several<double>("domain", 4), gravity = read.several<double>("gravity", 2);
  const auto carried = read.several<double>("carried", 2);
  if (!domain.empty()) options.domain = {domain[0], domain[1], domain[2], domain[3]};
  if (!gravity.empty()) options.gravity = {gravity[0], gravity[1]};
  if (!carried.empty()) state.carried = {carried[0], carried[1]};
  read.single("time", state.time);
  if (!std::isfinite(state.time)) read.refuse("time is not finite");
  read.single("until", options.until);
  read.single("length", options.step);
  read.single("epsilon", options.epsilon);
  read.single("tolerance", options.tolerance);
  read.single("step", state.step);
  read.single("diagrams", options.diagrams);
  read.name("periodic", options.periodic);
  read.name("surface", options.surface);
  read.name("scheme", options.scheme);
  read.single("viscosity", options.viscosity);
  read.single("centering", options.centering);
  read.name("walls", options.walls);
  options.known = caseIn(read, file);
  options.outline = outlineIn(read, file);
  if (read.error) return tl::unexpected(std::move(*read.error));
  return setup;
}

}  // namespace vorpipe
