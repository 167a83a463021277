/// vorpipe from C++17, header alone, over vorpipe_c.h: objects free themselves, errors are exceptions. The
/// names are those of vorpipe_c.h without their prefix; what they mean stands there.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "vorpipe_c.h"

namespace vorpipe {
// The interface of vorpipe's own tree, vorpipe.h, has some of the same names: a program may link both, and
// include one of them in a source.
inline namespace library {

/// A call that failed.
class Error : public std::runtime_error {
 public:
  explicit Error(vorpipe_code code)
      : std::runtime_error(vorpipe_last_error()), code_(code), subject_(vorpipe_last_subject()) {}
  /// VORPIPE_INPUT, VORPIPE_DEVICE or VORPIPE_CANCELLED.
  [[nodiscard]] vorpipe_code code() const { return code_; }
  [[nodiscard]] vorpipe_subject subject() const { return subject_; }

 private:
  vorpipe_code code_;
  vorpipe_subject subject_;
};

/// Throws Error unless the call is done; false: done, and something differs or is broken.
inline bool done(vorpipe_code code) {
  if (code == VORPIPE_DONE) return true;
  if (code == VORPIPE_DIFFERENT) return false;
  throw Error(code);
}

/// Numbers of a diagram or picture, which must outlive it.
template <class Element>
class View {
 public:
  explicit View(const vorpipe_array& array)
      : data_(static_cast<const Element*>(array.data)), size_(static_cast<std::size_t>(array.count)) {}
  View(const Element* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] const Element* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const Element* begin() const { return data_; }
  [[nodiscard]] const Element* end() const { return data_ + size_; }
  const Element& operator[](std::size_t index) const { return data_[index]; }
  [[nodiscard]] View part(std::size_t first, std::size_t end) const { return {data_ + first, end - first}; }

 private:
  const Element* data_;
  std::size_t size_;
};

struct Point {
  double x, y;
};

/// Returning false asks to stop, which ends the call by an Error with VORPIPE_CANCELLED.
using Progress = std::function<bool(std::string_view stage, double fraction)>;
/// Gets bytes; returning false refuses them.
using Write = std::function<bool(std::string_view bytes)>;

/// Calls of C, which know a function and a pointer. No exception of the caller's may pass through the
/// library: it is kept, and thrown again once the library is left.
template <class Function>
class Callback {
 public:
  explicit Callback(const Function& function) : function_(function) {}
  [[nodiscard]] void* user() { return this; }

  static std::int32_t progress(void* user, const char* stage, double fraction) {
    return static_cast<Callback*>(user)->call(std::string_view(stage), fraction);
  }
  static std::int32_t watch(void* user, const vorpipe_transport_step* step) {
    return static_cast<Callback*>(user)->call(*step);
  }
  static std::int32_t watch(void* user, const vorpipe_fluid_figures* figures) {
    return static_cast<Callback*>(user)->call(*figures);
  }
  static std::int32_t write(void* user, const void* bytes, std::size_t count) {
    return static_cast<Callback*>(user)->call(std::string_view(static_cast<const char*>(bytes), count));
  }

  /// done(), or the exception of the caller's.
  bool finish(vorpipe_code code) {
    if (thrown_) std::rethrow_exception(thrown_);
    return done(code);
  }

 private:
  template <class... Arguments>
  std::int32_t call(Arguments... arguments) {
    try {
      return function_(arguments...) ? 0 : 1;
    } catch (...) {
      thrown_ = std::current_exception();
      return 1;
    }
  }

  const Function& function_;
  std::exception_ptr thrown_;
};

template <class Object, void (*free)(Object*)>
struct Freeing {
  void operator()(Object* object) const { free(object); }
};
template <class Object, void (*free)(Object*)>
using Owned = std::unique_ptr<Object, Freeing<Object, free>>;

inline std::string_view version() { return vorpipe_version(); }

/// The names of a list.
inline std::vector<std::string> names(vorpipe_list list) {
  std::vector<std::string> all;
  for (std::size_t k = 0; const char* name = vorpipe_name(list, k); ++k) all.emplace_back(name);
  return all;
}

class Input {
 public:
  /// Sites as rows of x and y, in whatever type of two doubles or of two floats.
  template <class Points>
  static Input of(const Points& points) {
    vorpipe_input* input = nullptr;
    const auto sites = rowsOf(points);
    if constexpr (isFloat<Points>()) {
      done(vorpipe_input_create_float(&sites, &input));
    } else {
      done(vorpipe_input_create(&sites, &input));
    }
    return Input(input);
  }
  /// Moves the sites, or replaces them, as vorpipe_input_set_sites says.
  template <class Points>
  Input& sites(const Points& points) {
    const auto sites = rowsOf(points);
    if constexpr (isFloat<Points>()) {
      done(vorpipe_input_set_sites_float(get(), &sites));
    } else {
      done(vorpipe_input_set_sites(get(), &sites));
    }
    return *this;
  }
  static Input create(const vorpipe_sites& sites) {
    vorpipe_input* input = nullptr;
    done(vorpipe_input_create(&sites, &input));
    return Input(input);
  }
  /// A file or a generator: "stations.csv", "random:1000".
  static Input read(const std::string& sites, std::uint64_t seed = 1) {
    vorpipe_input* input = nullptr;
    done(vorpipe_input_read(sites.c_str(), seed, &input));
    return Input(input);
  }

  /// `options.struct_size` is set here.
  static Input readWith(const std::string& sites, vorpipe_read_options options) {
    vorpipe_input* input = nullptr;
    options.struct_size = sizeof options;
    done(vorpipe_input_read_with(sites.c_str(), &options, &input));
    return Input(input);
  }

  Input& weights(const std::vector<double>& weights) {
    done(vorpipe_input_set_weights(get(), weights.data(), weights.size()));
    return *this;
  }
  Input& readWeights(const std::string& path) {
    done(vorpipe_input_read_weights(get(), path.c_str()));
    return *this;
  }
  Input& box(double xmin, double ymin, double xmax, double ymax,
             vorpipe_axes periodic = VORPIPE_PERIODIC_NONE) {
    done(vorpipe_input_set_box(get(), xmin, ymin, xmax, ymax, periodic));
    return *this;
  }
  Input& outline(const vorpipe_outline& outline) {
    done(vorpipe_input_set_outline(get(), &outline));
    return *this;
  }
  Input& readOutline(const std::string& path) {
    done(vorpipe_input_read_outline(get(), path.c_str()));
    return *this;
  }
  Input& hull() {
    done(vorpipe_input_set_hull(get()));
    return *this;
  }
  Input& repairOutline() {
    done(vorpipe_input_repair_outline(get()));
    return *this;
  }
  /// In the unit of the domain; `relative`: as a part of the longer side.
  Input& margin(double margin, bool relative = false) {
    done(vorpipe_input_set_margin(get(), margin, relative ? 1 : 0));
    return *this;
  }
  /// Sites are degrees of the whole Earth; of cells alone.
  Input& globe() {
    done(vorpipe_input_set_globe(get()));
    return *this;
  }
  /// Around a center amid the domain or the sites, or one in degrees.
  Input& project() { return project(std::nan(""), std::nan("")); }
  Input& project(double longitude, double latitude) {
    done(vorpipe_input_project(get(), longitude, latitude));
    return *this;
  }
  Input& system(vorpipe_system_kind kind, std::int64_t epsg = 0) {
    done(vorpipe_input_set_system(get(), kind, epsg));
    return *this;
  }
  /// "EPSG:25832", "OGC:CRS84" or WKT.
  Input& system(const std::string& name) {
    done(vorpipe_input_name_system(get(), name.c_str()));
    return *this;
  }
  /// Of the outline that is set.
  Input& outlineSystem(const std::string& name) {
    done(vorpipe_input_name_outline_system(get(), name.c_str()));
    return *this;
  }
  Input& attribute(const std::string& name, const std::vector<std::optional<std::string>>& values,
                   vorpipe_attribute_type type = VORPIPE_INFERRED) {
    std::vector<vorpipe_text> texts;
    for (const auto& value : values) {
      texts.push_back(value ? vorpipe_text{value->data(), value->size()} : vorpipe_text{nullptr, 0});
    }
    done(vorpipe_input_add_attribute(get(), name.c_str(), type, texts.data(), texts.size()));
    return *this;
  }
  Input& density(const std::vector<double>& values, std::int32_t width, std::int32_t height) {
    if (values.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
      throw std::invalid_argument("density: not width x height values");
    }
    done(vorpipe_input_set_density(get(), values.data(), width, height));
    return *this;
  }
  Input& readDensity(const std::string& path) {
    done(vorpipe_input_read_density(get(), path.c_str()));
    return *this;
  }

  /// Where the pixels of the density that is set lie.
  Input& densityBox(double xmin, double ymin, double xmax, double ymax) {
    done(vorpipe_input_set_density_box(get(), xmin, ymin, xmax, ymax));
    return *this;
  }

  /// With VORPIPE_SURFACE_FREE cells end at discs around their sites; weights are squared radii.
  Input& surface(vorpipe_surface surface) {
    done(vorpipe_input_set_surface(get(), surface));
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return vorpipe_input_count(get()); }
  [[nodiscard]] std::uint64_t skipped() const { return vorpipe_input_skipped(get()); }
  /// xmin, ymin, xmax and ymax, in the plane of a projection.
  [[nodiscard]] std::array<double, 4> domain() const {
    std::array<double, 4> box = {};
    done(vorpipe_input_domain(get(), box.data()));
    return box;
  }
  /// What was reinterpreted or changed so far.
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all;
    for (std::size_t k = 0; const char* note = vorpipe_input_note(get(), k); ++k) all.emplace_back(note);
    return all;
  }
  [[nodiscard]] std::size_t attributeCount() const { return vorpipe_input_attribute_count(get()); }
  [[nodiscard]] std::string attributeName(std::size_t attribute) const {
    const char* name = vorpipe_input_attribute_name(get(), attribute);
    if (name == nullptr) throw std::out_of_range("attribute");
    return name;
  }
  [[nodiscard]] vorpipe_attribute_type attributeType(std::size_t attribute) const {
    return vorpipe_input_attribute_type(get(), attribute);
  }
  /// None where it is missing.
  [[nodiscard]] std::optional<std::string> attribute(std::size_t attribute, std::uint64_t site) const {
    vorpipe_text value = {};
    done(vorpipe_input_attribute(get(), attribute, site, &value));
    if (value.data == nullptr) return std::nullopt;
    return std::string(value.data, static_cast<std::size_t>(value.size));
  }
  [[nodiscard]] vorpipe_input* get() const { return input_.get(); }

 private:
  friend class Relaxation;
  friend class Transported;
  friend class Fluid;
  explicit Input(vorpipe_input* input) : input_(input) {}
  template <class Points>
  static constexpr bool isFloat() {
    return sizeof(*std::declval<const Points&>().data()) == 2 * sizeof(float);
  }
  template <class Points>
  static auto rowsOf(const Points& points) {
    using Number = std::conditional_t<isFloat<Points>(), float, double>;
    static_assert(sizeof(*points.data()) == 2 * sizeof(Number), "points are pairs of doubles or of floats");
    const auto* numbers = reinterpret_cast<const Number*>(points.data());
    std::conditional_t<isFloat<Points>(), vorpipe_sites_float, vorpipe_sites> sites = {};
    sites.struct_size = sizeof sites;
    sites.count = points.size();
    sites.x = numbers;
    sites.y = numbers + 1;
    sites.position_stride = 2 * sizeof(Number);
    return sites;
  }
  Owned<vorpipe_input, vorpipe_input_free> input_;
};

class Diagram {
 public:
  explicit Diagram(vorpipe_diagram* diagram) : diagram_(diagram) {}

  [[nodiscard]] std::size_t size() const { return status().size(); }
  [[nodiscard]] View<std::uint8_t> status() const { return view<std::uint8_t>(VORPIPE_CELL_STATUS); }
  [[nodiscard]] View<std::uint32_t> owner() const { return view<std::uint32_t>(VORPIPE_CELL_OWNER); }
  [[nodiscard]] View<double> area() const { return view<double>(VORPIPE_CELL_AREA); }
  [[nodiscard]] View<double> perimeter() const { return view<double>(VORPIPE_CELL_PERIMETER); }
  [[nodiscard]] View<Point> centroid() const { return view<Point>(VORPIPE_CELL_CENTROID); }
  /// Steradians, of the globe.
  [[nodiscard]] View<double> solidAngle() const { return view<double>(VORPIPE_CELL_SOLID_ANGLE); }
  [[nodiscard]] View<std::array<double, 3>> secondMoments() const {
    return view<std::array<double, 3>>(VORPIPE_CELL_SECOND_MOMENTS);
  }
  [[nodiscard]] View<std::uint64_t> offsets() const { return view<std::uint64_t>(VORPIPE_CELL_OFFSETS); }
  [[nodiscard]] View<Point> vertices() const { return view<Point>(VORPIPE_CELL_VERTICES); }
  [[nodiscard]] View<std::int64_t> neighbors() const { return view<std::int64_t>(VORPIPE_CELL_NEIGHBORS); }
  [[nodiscard]] View<double> edgeLengths() const { return view<double>(VORPIPE_CELL_EDGE_LENGTHS); }
  [[nodiscard]] View<std::array<std::int32_t, 2>> neighborShifts() const {
    return view<std::array<std::int32_t, 2>>(VORPIPE_CELL_NEIGHBOR_SHIFTS);
  }
  [[nodiscard]] View<std::uint64_t> ringStarts() const {
    return view<std::uint64_t>(VORPIPE_CELL_RING_STARTS);
  }
  [[nodiscard]] View<double> mass() const { return view<double>(VORPIPE_CELL_MASS); }
  [[nodiscard]] View<Point> massCentroid() const { return view<Point>(VORPIPE_CELL_MASS_CENTROID); }
  [[nodiscard]] View<std::array<std::uint32_t, 3>> triangles() const {
    return view<std::array<std::uint32_t, 3>>(VORPIPE_TRIANGLES);
  }
  /// What cells share; see vorpipe_c.h.
  [[nodiscard]] View<Point> sharedVertices() const { return view<Point>(VORPIPE_SHARED_VERTICES); }
  [[nodiscard]] View<std::uint32_t> vertexOf() const { return view<std::uint32_t>(VORPIPE_VERTEX_OF); }
  [[nodiscard]] View<std::uint32_t> edgeOf() const { return view<std::uint32_t>(VORPIPE_EDGE_OF); }
  [[nodiscard]] View<std::uint64_t> edgeEntry() const { return view<std::uint64_t>(VORPIPE_EDGE_ENTRY); }
  [[nodiscard]] View<std::array<std::uint32_t, 2>> edgeVertices() const {
    return view<std::array<std::uint32_t, 2>>(VORPIPE_EDGE_VERTICES);
  }
  [[nodiscard]] View<std::array<std::int64_t, 2>> edgeCells() const {
    return view<std::array<std::int64_t, 2>>(VORPIPE_EDGE_CELLS);
  }
  /// Of a free surface: where the parts of each border begin; from and to, and the angle of an arc; whose
  /// they are.
  [[nodiscard]] View<std::uint64_t> borderOffsets() const {
    return view<std::uint64_t>(VORPIPE_BORDER_OFFSETS);
  }
  [[nodiscard]] View<std::array<double, 5>> borderParts() const {
    return view<std::array<double, 5>>(VORPIPE_BORDER_PARTS);
  }
  [[nodiscard]] View<std::int64_t> borderNeighbors() const {
    return view<std::int64_t>(VORPIPE_BORDER_NEIGHBORS);
  }
  /// Those of one cell.
  /// Cells as indexed triangles for a GPU.
  [[nodiscard]] View<std::array<float, 2>> meshVertices() const {
    return view<std::array<float, 2>>(VORPIPE_MESH_VERTICES);
  }
  [[nodiscard]] View<std::uint32_t> meshSites() const { return view<std::uint32_t>(VORPIPE_MESH_SITES); }
  [[nodiscard]] View<std::array<std::uint32_t, 3>> meshTriangles() const {
    return view<std::array<std::uint32_t, 3>>(VORPIPE_MESH_TRIANGLES);
  }

  [[nodiscard]] View<Point> vertices(std::size_t cell) const { return ofCell(vertices(), cell); }
  [[nodiscard]] View<std::int64_t> neighbors(std::size_t cell) const { return ofCell(neighbors(), cell); }
  [[nodiscard]] double areaSum() const { return vorpipe_diagram_area_sum(get()); }

  [[nodiscard]] vorpipe_report report() const {
    vorpipe_report report = {};
    report.struct_size = sizeof report;
    done(vorpipe_diagram_report(get(), &report));
    return report;
  }

  /// Whether all that is promised holds; the first promise that is broken is vorpipe_last_error().
  [[nodiscard]] bool check(int threads = 0) const {
    return done(vorpipe_diagram_check(get(), threads, nullptr, nullptr));
  }
  /// Whether the cells of both are the same.
  [[nodiscard]] bool agreesWith(const Diagram& other) const {
    return done(vorpipe_diagrams_compare(get(), other.get(), nullptr));
  }
  /// `only_cells` leaves out sites without a cell.
  void write(const std::string& format, const Write& write, bool only_cells = false) const {
    Callback<Write> callback(write);
    const auto options = writeOptions(only_cells);
    callback.finish(
        vorpipe_diagram_write_with(get(), format.c_str(), &options, Callback<Write>::write, callback.user()));
  }
  [[nodiscard]] std::string text(const std::string& format, bool only_cells = false) const {
    std::string all;
    write(
        format, [&](std::string_view bytes) { return all.append(bytes), true; }, only_cells);
    return all;
  }
  void save(const std::string& path, bool only_cells = false) const {
    const auto options = writeOptions(only_cells);
    done(vorpipe_diagram_save_with(get(), path.c_str(), &options));
  }
  void writeEdges(const std::string& format, const Write& write) const {
    Callback<Write> callback(write);
    callback.finish(
        vorpipe_diagram_write_edges(get(), format.c_str(), Callback<Write>::write, callback.user()));
  }
  void saveEdges(const std::string& path) const { done(vorpipe_diagram_save_edges(get(), path.c_str())); }

  [[nodiscard]] const vorpipe_diagram* get() const { return diagram_.get(); }

 private:
  static vorpipe_write_options writeOptions(bool only_cells) {
    vorpipe_write_options options = {};
    options.struct_size = sizeof options;
    options.only_cells = only_cells ? 1 : 0;
    return options;
  }
  template <class Element>
  [[nodiscard]] View<Element> view(vorpipe_diagram_field field) const {
    vorpipe_array array = {};
    done(vorpipe_diagram_array(get(), field, &array));
    return View<Element>(array);
  }
  template <class Element>
  [[nodiscard]] View<Element> ofCell(const View<Element>& all, std::size_t cell) const {
    if (all.empty()) return all;
    const auto table = offsets();
    return all.part(table[cell], table[cell + 1]);
  }

  Owned<vorpipe_diagram, vorpipe_diagram_free> diagram_;
};

class Locator {
 public:
  explicit Locator(const Input& input, int threads = 0) {
    vorpipe_locator* locator = nullptr;
    done(vorpipe_locator_create(input.get(), threads, &locator));
    locator_.reset(locator);
  }
  /// The site of each place, or VORPIPE_NO_SITE.
  [[nodiscard]] std::vector<std::uint32_t> find(const std::vector<Point>& places) const {
    std::vector<std::uint32_t> sites(places.size());
    done(vorpipe_locator_find(locator_.get(), reinterpret_cast<const double*>(places.data()), places.size(),
                              sites.data()));
    return sites;
  }

 private:
  Owned<vorpipe_locator, vorpipe_locator_free> locator_;
};

class Picture {
 public:
  explicit Picture(vorpipe_picture* picture) : picture_(picture) {}
  /// A .png, or ids in an .npy.
  static Picture read(const std::string& path) {
    vorpipe_picture* picture = nullptr;
    done(vorpipe_picture_read(path.c_str(), &picture));
    return Picture(picture);
  }

  [[nodiscard]] int width() const { return vorpipe_picture_width(get()); }
  [[nodiscard]] int height() const { return vorpipe_picture_height(get()); }
  /// Pixels row by row, the top one first.
  [[nodiscard]] View<std::array<std::uint8_t, 4>> rgba() const {
    return pixels<std::array<std::uint8_t, 4>>(VORPIPE_PICTURE_RGBA);
  }
  [[nodiscard]] View<std::uint32_t> ids() const { return pixels<std::uint32_t>(VORPIPE_PICTURE_IDS); }
  /// What colors stand for; its ticks belong to the picture: View<std::array<double, 2>>(key.ticks).
  [[nodiscard]] vorpipe_color_key key() const {
    vorpipe_color_key key = {};
    key.struct_size = sizeof key;
    done(vorpipe_picture_key(get(), &key));
    return key;
  }

  [[nodiscard]] bool check(int threads = 0) const {
    return done(vorpipe_picture_check(get(), threads, nullptr, nullptr));
  }
  [[nodiscard]] bool agreesWith(const Picture& other) const {
    return done(vorpipe_pictures_compare(get(), other.get(), nullptr));
  }
  void write(const std::string& format, const Write& write) const {
    Callback<Write> callback(write);
    callback.finish(vorpipe_picture_write(get(), format.c_str(), Callback<Write>::write, callback.user()));
  }
  void save(const std::string& path) const { done(vorpipe_picture_save(get(), path.c_str())); }

  [[nodiscard]] const vorpipe_picture* get() const { return picture_.get(); }

 private:
  template <class Element>
  [[nodiscard]] View<Element> pixels(vorpipe_picture_field field) const {
    vorpipe_array array = {};
    done(vorpipe_picture_array(get(), field, &array));
    return {static_cast<const Element*>(array.data),
            static_cast<std::size_t>(array.count) * static_cast<std::size_t>(width())};
  }
  Owned<vorpipe_picture, vorpipe_picture_free> picture_;
};

/// Sites that move; the session outlives it.
class Relaxation {
 public:
  explicit Relaxation(vorpipe_relaxation* relaxation) : relaxation_(relaxation) {}

  /// Computes the next diagram; false: there is none.
  bool step() {
    std::int32_t more = 0;
    done(vorpipe_relaxation_step(relaxation_.get(), &more));
    return more != 0;
  }
  /// Where the sites are; good until the next step.
  [[nodiscard]] View<Point> sites() const { return view<Point>(VORPIPE_RELAXED_SITES); }
  /// By diagram: its number, the energy, that as a part of the hexagonal lattice's, the longest way of a
  /// site, seconds.
  [[nodiscard]] View<std::array<double, 5>> trace() const {
    return view<std::array<double, 5>>(VORPIPE_RELAXED_TRACE);
  }
  /// By diagram: 0 where its energy was too high, and the sites went back to where they were before.
  [[nodiscard]] View<std::uint8_t> taken() const { return view<std::uint8_t>(VORPIPE_RELAXED_TAKEN); }
  [[nodiscard]] vorpipe_relax_end end() const { return vorpipe_relaxation_end(get()); }
  [[nodiscard]] vorpipe_report report() const {
    vorpipe_report report = {};
    report.struct_size = sizeof report;
    done(vorpipe_relaxation_report(get(), &report));
    return report;
  }
  /// The sites where they are, in the same domain.
  [[nodiscard]] Input input() const {
    vorpipe_input* input = nullptr;
    done(vorpipe_relaxation_input(get(), &input));
    return Input(input);
  }
  void write(const std::string& format, const Write& write) const {
    Callback<Write> callback(write);
    callback.finish(vorpipe_relaxation_write(get(), format.c_str(), Callback<Write>::write, callback.user()));
  }
  void save(const std::string& path) const { done(vorpipe_relaxation_save(get(), path.c_str())); }
  [[nodiscard]] const vorpipe_relaxation* get() const { return relaxation_.get(); }

 private:
  template <class Element>
  [[nodiscard]] View<Element> view(vorpipe_relaxation_field field) const {
    vorpipe_array array = {};
    done(vorpipe_relaxation_array(get(), field, &array));
    return View<Element>(array);
  }
  Owned<vorpipe_relaxation, vorpipe_relaxation_free> relaxation_;
};

/// One diagram of a transport; returning false ends it with what was reached.
using TransportWatch = std::function<bool(const vorpipe_transport_step&)>;

/// Sites with the weights that give each cell its mass.
class Transported {
 public:
  explicit Transported(vorpipe_transported* transported) : transported_(transported) {}

  [[nodiscard]] View<double> weights() const { return view<double>(VORPIPE_TRANSPORTED_WEIGHTS); }
  [[nodiscard]] View<double> masses() const { return view<double>(VORPIPE_TRANSPORTED_MASSES); }
  [[nodiscard]] View<double> areas() const { return view<double>(VORPIPE_TRANSPORTED_AREAS); }
  [[nodiscard]] View<Point> centroids() const { return view<Point>(VORPIPE_TRANSPORTED_CENTROIDS); }
  [[nodiscard]] View<std::uint8_t> status() const { return view<std::uint8_t>(VORPIPE_TRANSPORTED_STATUS); }
  /// By diagram: its number, that of the Newton step, the part of it, whether it was kept, norm, worst,
  /// least, iterations of the linear solver, seconds.
  [[nodiscard]] View<std::array<double, 9>> trace() const {
    return view<std::array<double, 9>>(VORPIPE_TRANSPORTED_TRACE);
  }
  [[nodiscard]] vorpipe_transport_end end() const { return vorpipe_transported_end(get()); }
  [[nodiscard]] double cost() const { return vorpipe_transported_cost(get()); }
  [[nodiscard]] vorpipe_report report() const {
    vorpipe_report report = {};
    report.struct_size = sizeof report;
    done(vorpipe_transported_report(get(), &report));
    return report;
  }
  /// The sites with these weights, in the same domain and with the same surface.
  [[nodiscard]] Input input() const {
    vorpipe_input* input = nullptr;
    done(vorpipe_transported_input(get(), &input));
    return Input(input);
  }
  void write(const std::string& format, const Write& write) const {
    Callback<Write> callback(write);
    callback.finish(
        vorpipe_transported_write(get(), format.c_str(), Callback<Write>::write, callback.user()));
  }
  void save(const std::string& path) const { done(vorpipe_transported_save(get(), path.c_str())); }
  [[nodiscard]] const vorpipe_transported* get() const { return transported_.get(); }

 private:
  template <class Element>
  [[nodiscard]] View<Element> view(vorpipe_transported_field field) const {
    vorpipe_array array = {};
    done(vorpipe_transported_array(get(), field, &array));
    return View<Element>(array);
  }
  Owned<vorpipe_transported, vorpipe_transported_free> transported_;
};

/// What each step of a fluid has come to; returning false ends a run.
using FluidWatch = std::function<bool(const vorpipe_fluid_figures&)>;

/// A fluid, step by step; the session outlives it.
class Fluid {
 public:
  explicit Fluid(vorpipe_fluid* fluid) : fluid_(fluid) {}

  /// Makes a step; false: it has ended.
  bool step() {
    std::int32_t more = 0;
    done(vorpipe_fluid_step(fluid_.get(), nullptr, &more));
    return more != 0;
  }
  /// To a time, or some steps: what `options` say, whose `watch` is taken from `watch`.
  void run(vorpipe_fluid_run_options options = {}, const FluidWatch& watch = {}) {
    Callback<FluidWatch> callback(watch);
    options.struct_size = sizeof options;
    if (watch) {
      options.watch = Callback<FluidWatch>::watch;
      options.watch_user = callback.user();
    }
    callback.finish(vorpipe_fluid_run(fluid_.get(), &options));
  }
  /// Adds to the velocities of all sites.
  void push(const std::vector<Point>& velocities) {
    const auto* numbers = reinterpret_cast<const double*>(velocities.data());
    done(vorpipe_fluid_push(fluid_.get(), numbers, velocities.size()));
  }

  // Good until the next step or push.
  [[nodiscard]] View<Point> sites() const { return view<Point>(VORPIPE_FLUID_SITES); }
  [[nodiscard]] View<double> weights() const { return view<double>(VORPIPE_FLUID_WEIGHTS); }
  [[nodiscard]] View<Point> velocities() const { return view<Point>(VORPIPE_FLUID_VELOCITIES); }
  [[nodiscard]] View<double> pressures() const { return view<double>(VORPIPE_FLUID_PRESSURES); }
  [[nodiscard]] View<double> volumes() const { return view<double>(VORPIPE_FLUID_VOLUMES); }
  [[nodiscard]] View<double> densities() const { return view<double>(VORPIPE_FLUID_DENSITIES); }

  [[nodiscard]] vorpipe_fluid_figures last() const {
    vorpipe_fluid_figures figures = {};
    figures.struct_size = sizeof figures;
    done(vorpipe_fluid_last(get(), &figures));
    return figures;
  }
  [[nodiscard]] double time() const { return last().time; }
  [[nodiscard]] double velocityError() const { return vorpipe_fluid_velocity_error(get()); }
  [[nodiscard]] vorpipe_fluid_end end() const { return vorpipe_fluid_ended(get()); }
  [[nodiscard]] vorpipe_report report() const {
    vorpipe_report report = {};
    report.struct_size = sizeof report;
    done(vorpipe_fluid_report(get(), &report));
    return report;
  }
  /// The sites where they are, for cells and pictures.
  [[nodiscard]] Input input() const {
    vorpipe_input* input = nullptr;
    done(vorpipe_fluid_input(get(), &input));
    return Input(input);
  }
  void write(const std::string& format, const Write& write) const {
    Callback<Write> callback(write);
    callback.finish(vorpipe_fluid_write(get(), format.c_str(), Callback<Write>::write, callback.user()));
  }
  void save(const std::string& path) const { done(vorpipe_fluid_save(get(), path.c_str())); }
  [[nodiscard]] const vorpipe_fluid* get() const { return fluid_.get(); }

 private:
  template <class Element>
  [[nodiscard]] View<Element> view(vorpipe_fluid_field field) const {
    vorpipe_array array = {};
    done(vorpipe_fluid_array(get(), field, &array));
    return View<Element>(array);
  }
  Owned<vorpipe_fluid, vorpipe_fluid_free> fluid_;
};

class Session {
 public:
  explicit Session(const std::string& backend = "auto", int threads = 0) {
    vorpipe_session_options options = {};
    options.struct_size = sizeof options;
    options.backend = backend.c_str();
    options.threads = threads;
    open(options);
  }
  explicit Session(const vorpipe_session_options& options) { open(options); }

  /// `options.progress` is taken from `progress`.
  Diagram cells(const Input& input, vorpipe_cells_options options = {}, const Progress& progress = {}) {
    vorpipe_diagram* diagram = nullptr;
    run(options, progress, [&] { return vorpipe_cells(get(), input.get(), &options, &diagram); });
    return Diagram(diagram);
  }
  Picture render(const Input& input, vorpipe_render_options options = {}, const Progress& progress = {}) {
    vorpipe_picture* picture = nullptr;
    run(options, progress, [&] { return vorpipe_render(get(), input.get(), &options, &picture); });
    return Picture(picture);
  }

  /// Sites that move until nothing is left to do.
  Relaxation relax(const Input& input, vorpipe_relax_options options = {}, const Progress& progress = {}) {
    vorpipe_relaxation* relaxation = nullptr;
    Callback<Progress> callback(progress);
    options.struct_size = sizeof options;
    if (progress) {
      options.progress = Callback<Progress>::progress;
      options.progress_user = callback.user();
    }
    const vorpipe_code code = vorpipe_relax(get(), input.get(), &options, &relaxation);
    Relaxation relaxed(relaxation);  // which it is as well where progress said stop, or has thrown
    callback.finish(code);
    return relaxed;
  }
  /// The same step by step: `options.progress` must be good for all of them.
  Relaxation relaxBegin(const Input& input, vorpipe_relax_options options = {}) {
    vorpipe_relaxation* relaxation = nullptr;
    options.struct_size = sizeof options;
    done(vorpipe_relax_begin(get(), input.get(), &options, &relaxation));
    return Relaxation(relaxation);
  }

  /// The weights that give each cell its mass; without masses, as large a one as any other.
  /// `options.masses` and `options.watch` are taken from `masses` and `watch`.
  Transported transport(const Input& input, const std::vector<double>& masses = {},
                        vorpipe_transport_options options = {}, const TransportWatch& watch = {}) {
    options.struct_size = sizeof options;
    options.masses = masses.empty() ? nullptr : masses.data();
    options.mass_count = masses.size();
    Callback<TransportWatch> callback(watch);
    if (watch) {
      options.watch = Callback<TransportWatch>::watch;
      options.watch_user = callback.user();
    }
    vorpipe_transported* transported = nullptr;
    const vorpipe_code code = vorpipe_transport(get(), input.get(), &options, &transported);
    Transported found(transported);
    callback.finish(code);
    return found;
  }

  /// A fluid of an input, with what `options` say; or of a case or a file, by its name. `options.progress`
  /// must be good for all steps.
  Fluid fluid(const Input& input, vorpipe_fluid_options options = {}) {
    vorpipe_fluid* fluid = nullptr;
    options.struct_size = sizeof options;
    done(vorpipe_fluid_begin(get(), input.get(), &options, &fluid));
    return Fluid(fluid);
  }
  Fluid fluid(const std::string& name, std::uint64_t parcels = 0, vorpipe_fluid_options options = {}) {
    vorpipe_fluid* fluid = nullptr;
    options.struct_size = sizeof options;
    done(vorpipe_fluid_read(get(), name.c_str(), parcels, &options, &fluid));
    return Fluid(fluid);
  }

  /// A picture as shapes, "svg" or "pdf"; or into a file of such an extension.
  void draw(const Input& input, vorpipe_render_options options, const std::string& format,
            const Write& write) {
    Callback<Write> callback(write);
    options.struct_size = sizeof options;
    callback.finish(
        vorpipe_draw(get(), input.get(), &options, format.c_str(), Callback<Write>::write, callback.user()));
  }
  void draw(const Input& input, vorpipe_render_options options, const std::string& path) {
    options.struct_size = sizeof options;
    done(vorpipe_draw_save(get(), input.get(), &options, path.c_str()));
  }

  [[nodiscard]] vorpipe_device_info device() const {
    vorpipe_device_info info = {};
    info.struct_size = sizeof info;
    done(vorpipe_session_device(get(), &info));
    return info;
  }
  [[nodiscard]] vorpipe_session* get() const { return session_.get(); }

 private:
  void open(const vorpipe_session_options& options) {
    vorpipe_session* session = nullptr;
    done(vorpipe_session_open(&options, &session));
    session_.reset(session);
  }

  template <class Options, class Call>
  static void run(Options& options, const Progress& progress, const Call& call) {
    options.struct_size = sizeof options;
    if (!progress) {
      done(call());
      return;
    }
    Callback<Progress> callback(progress);
    options.progress = Callback<Progress>::progress;
    options.progress_user = callback.user();
    callback.finish(call());
  }

  Owned<vorpipe_session, vorpipe_session_free> session_;
};

}  // namespace library
}  // namespace vorpipe
