/// The interface of C, called in any order: with objects that exist, with NULL, with options of any numbers.
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "library_calls.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

void makeInput(ByteStream& stream, Shelves& shelves) {
  vorpipe_input* input = nullptr;
  if (stream.choice(4) == 0) {
    static constexpr std::array<const char*, 6> specs = {"random:9", "hex:12", "circle:7",
                                                         "random:0", "no.csv", nullptr};
    told(vorpipe_input_read(specs[stream.choice(specs.size())], stream.take<std::uint8_t>(), &input));
  } else {
    std::vector<double> numbers;
    const std::size_t count = stream.choice(9);
    for (std::size_t k = 0; k < 3 * count; ++k) numbers.push_back(stream.number());
    vorpipe_sites sites{};
    sites.struct_size = sizeof sites;
    sites.count = count;
    sites.x = numbers.data();
    sites.y = numbers.data() + count;
    sites.weight = stream.flag() ? numbers.data() + 2 * count : nullptr;
    told(vorpipe_input_create(stream.choice(16) == 0 ? nullptr : &sites, &input));
  }
  shelves.inputs.put(stream, input);
}

void setDomain(ByteStream& stream, vorpipe_input* input) {
  switch (stream.choice(6)) {
    case 0: {
      const double xmin = stream.number(), ymin = stream.number(), xmax = stream.number(),
                   ymax = stream.number();
      return told(vorpipe_input_set_box(input, xmin, ymin, xmax, ymax, smallNumber(stream)));
    }
    case 1: {
      std::vector<double> points;
      const std::size_t count = stream.choice(9);
      for (std::size_t k = 0; k < 2 * count; ++k) points.push_back(stream.number());
      const std::array<std::uint64_t, 3> rings{stream.choice(3) == 0 ? 1u : 0u, stream.choice(9), count};
      const std::array<std::uint64_t, 2> polygons{0, 2};
      const vorpipe_outline outline{sizeof outline, count,          2, 1, points.data(),
                                    rings.data(),   polygons.data()};
      return told(vorpipe_input_set_outline(input, stream.choice(9) == 0 ? nullptr : &outline));
    }
    case 2:
      return told(vorpipe_input_set_hull(input));
    case 3:
      return told(vorpipe_input_repair_outline(input));
    case 4: {
      const double margin = stream.number();
      return told(vorpipe_input_set_margin(input, margin, smallNumber(stream)));
    }
    default: {
      const double longitude = stream.flag() ? NAN : stream.number(),
                   latitude = stream.flag() ? NAN : stream.number();
      return told(vorpipe_input_project(input, longitude, latitude));
    }
  }
}

void changeInput(ByteStream& stream, vorpipe_input* input) {
  switch (stream.choice(5)) {
    case 0: {
      std::array<double, 9> weights{};
      for (double& weight : weights) weight = stream.number();
      return told(vorpipe_input_set_weights(input, weights.data(), stream.choice(weights.size() + 1)));
    }
    case 1: {
      const double low = stream.number(), high = stream.number();
      return told(vorpipe_input_random_weights(input, low, high, 1));
    }
    case 2: {
      std::array<double, 4> values{};
      for (double& value : values) value = stream.number();
      return told(vorpipe_input_set_density(input, values.data(), stream.flag() ? 2 : -1, 2));
    }
    case 3: {
      const std::array<vorpipe_text, 2> values{{{"a\"b", 3}, {nullptr, 0}}};
      const int32_t type = smallNumber(stream);
      return told(vorpipe_input_add_attribute(input, stream.choice(5) == 0 ? nullptr : "name", type,
                                              values.data(), stream.choice(3)));
    }
    default: {
      const int32_t kind = smallNumber(stream);
      return told(vorpipe_input_set_system(input, kind, stream.take<std::int16_t>()));
    }
  }
}

void askInput(ByteStream& stream, const vorpipe_input* input) {
  std::array<double, 4> box{};
  told(vorpipe_input_domain(input, box.data()));
  (void)vorpipe_input_count(input);
  (void)vorpipe_input_note(input, stream.choice(3));
  (void)vorpipe_input_attribute_name(input, stream.choice(3));
  vorpipe_text text{};
  told(vorpipe_input_attribute(input, stream.choice(3), stream.choice(9), &text));
}

void makeDiagram(ByteStream& stream, Shelves& shelves) {
  vorpipe_cells_options options{};
  int steps = static_cast<int>(stream.choice(200));
  options.detail = smallNumber(stream);
  options.search = stream.choice(4) == 0 ? 1 : 0;
  options.search_neighbors = smallNumber(stream);
  options.progress = stream.choice(4) == 0 ? stopSometimes : nullptr;
  options.progress_user = &steps;
  vorpipe_diagram* diagram = nullptr;
  auto* const session = stream.choice(16) == 0 ? nullptr : librarySession();
  auto* const input = shelves.inputs.get(stream);
  told(vorpipe_cells(session, input, optional(stream, options), &diagram));
  if (diagram != nullptr) {
    const vorpipe_code checked = vorpipe_diagram_check(diagram, 1, nullptr, nullptr);
    require(checked == VORPIPE_DONE, vorpipe_last_error());
  }
  shelves.diagrams.put(stream, diagram);
}

void askDiagram(ByteStream& stream, const Shelves& shelves) {
  static constexpr std::array<const char*, 8> formats = {"csv", "npz", "geojson", "gpkg",
                                                         "vtp", "svg", "no",      nullptr};
  const vorpipe_diagram* const diagram = shelves.diagrams.get(stream);
  vorpipe_array array{};
  told(vorpipe_diagram_array(diagram, static_cast<int32_t>(stream.choice(24)), &array));
  int writes = static_cast<int>(stream.choice(9));
  const char* const format = formats[stream.choice(formats.size())];
  const auto write = stream.choice(9) == 0 ? nullptr : takeBytes;
  // What is not taken is an error of the device.
  const vorpipe_code code = stream.flag() ? vorpipe_diagram_write(diagram, format, write, &writes)
                                          : vorpipe_diagram_write_edges(diagram, format, write, &writes);
  require(code == VORPIPE_DEVICE ? writes < 0 : true, vorpipe_last_error());
  told(vorpipe_diagrams_compare(diagram, shelves.diagrams.get(stream), nullptr));
  vorpipe_report report{};
  told(vorpipe_diagram_report(diagram, const_cast<vorpipe_report*>(optional(stream, report))));
}

void makePicture(ByteStream& stream, Shelves& shelves) {
  vorpipe_render_options options{};
  options.width = stream.take<std::int8_t>() % 40;
  options.height = stream.take<std::int8_t>() % 40;
  if (options.width == 0 && options.height == 0) options.width = options.height = 7;
  options.color = smallNumber(stream);
  options.colormap = stream.choice(8) == 0 ? "nope" : nullptr;
  options.edges = smallNumber(stream);
  options.show_sites = smallNumber(stream);
  options.color_scale = smallNumber(stream);
  options.fit = smallNumber(stream);
  options.antialias = smallNumber(stream);
  options.dual = smallNumber(stream);
  options.labels = smallNumber(stream);
  options.legend = smallNumber(stream);
  if (stream.choice(4) == 0) options.edge_width = stream.number();
  if (stream.choice(4) == 0) options.dot_size = stream.number();
  options.has_view = stream.choice(4) == 0 ? 1 : 0;
  if (options.has_view != 0) {
    options.view_xmin = stream.number();
    options.view_ymin = stream.number();
    options.view_xmax = stream.number();
    options.view_ymax = stream.number();
  }
  vorpipe_picture* picture = nullptr;
  auto* const input = shelves.inputs.get(stream);
  told(vorpipe_render(librarySession(), input, optional(stream, options), &picture));
  shelves.pictures.put(stream, picture);
}

void askPicture(ByteStream& stream, const Shelves& shelves) {
  static constexpr std::array<const char*, 6> formats = {"png", "npy", "tif", "pgw", "svg", nullptr};
  const vorpipe_picture* const picture = shelves.pictures.get(stream);
  vorpipe_array array{};
  told(vorpipe_picture_array(picture, smallNumber(stream), &array));
  int writes = static_cast<int>(stream.choice(9));
  const vorpipe_code code =
      vorpipe_picture_write(picture, formats[stream.choice(formats.size())], takeBytes, &writes);
  require(code == VORPIPE_DEVICE ? writes < 0 : true, vorpipe_last_error());
  told(vorpipe_pictures_compare(picture, shelves.pictures.get(stream), nullptr));
  (void)vorpipe_picture_width(picture);
  (void)vorpipe_picture_note(picture, stream.choice(3));
}

void locate(ByteStream& stream, Shelves& shelves) {
  if (stream.flag()) {
    vorpipe_locator* locator = nullptr;
    told(vorpipe_locator_create(shelves.inputs.get(stream), smallNumber(stream), &locator));
    shelves.locators.put(stream, locator);
    return;
  }
  std::array<double, 4> places{};
  for (double& place : places) place = stream.number();
  std::array<std::uint32_t, 2> sites{};
  told(vorpipe_locator_find(shelves.locators.get(stream), places.data(), sites.size(), sites.data()));
}

}  // namespace

vorpipe_session* librarySession() {
  static const struct Opened {
    vorpipe_session* session = nullptr;
    Opened() {
      vorpipe_session_options options{};
      options.struct_size = sizeof options;
      options.threads = 1;
      options.backend = "cpu";
      require(vorpipe_session_open(&options, &session) == VORPIPE_DONE, vorpipe_last_error());
    }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    ~Opened() { vorpipe_session_free(session); }
  } opened;
  return opened.session;
}

void told(vorpipe_code code) {
  if (code == VORPIPE_DONE) return;
  const std::string_view line = vorpipe_last_error();
  require(code == VORPIPE_INPUT || code == VORPIPE_DIFFERENT || code == VORPIPE_CANCELLED, line);
  require(!line.empty() && line.find('\n') == std::string_view::npos, "an error is a line");
}

int32_t takeBytes(void* user, const void* /*bytes*/, size_t /*count*/) {
  return --*static_cast<int*>(user) < 0 ? 1 : 0;
}

int32_t stopSometimes(void* user, const char* /*stage*/, double /*fraction*/) {
  return --*static_cast<int*>(user) < 0 ? 1 : 0;
}

void fuzzLibrary(std::string_view bytes) {
  constexpr int most_calls = 24;
  ByteStream stream(bytes);
  Shelves shelves;
  for (int call = 0; call < most_calls && !stream.atEnd(); ++call) {
    switch (stream.choice(10)) {
      case 0:
        makeInput(stream, shelves);
        break;
      case 1:
        setDomain(stream, shelves.inputs.get(stream));
        break;
      case 2:
        changeInput(stream, shelves.inputs.get(stream));
        break;
      case 3:
        askInput(stream, shelves.inputs.get(stream));
        break;
      case 4:
        makeDiagram(stream, shelves);
        break;
      case 5:
        askDiagram(stream, shelves);
        break;
      case 6:
        makePicture(stream, shelves);
        break;
      case 7:
        askPicture(stream, shelves);
        break;
      case 8:
        locate(stream, shelves);
        break;
      default:
        move(stream, shelves);
    }
  }
}

}  // namespace vorpipe::fuzz
