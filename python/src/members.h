/// What results consist of, for their pickles. A struct that gets another member does not compile until that
/// is named here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "attributes.h"
#include "base/option_rows.h"
#include "input.h"
#include "pickles.h"
#include "results.h"
#include "space.h"
#include "table.h"

namespace vorpipe::python {

/// Names and members, for `all`.
template <class... Member>
constexpr auto named(const std::pair<const char*, Member>&... members) {
  return std::make_tuple(members...);
}
template <class Member>
constexpr std::pair<const char*, Member> member(const char* name, Member pointer) {
  return {name, pointer};
}

template <>
struct Members<Point> {
  static constexpr auto all = named(member("x", &Point::x), member("y", &Point::y));
};
static_assert(has_all_members<Point>());

template <>
struct Members<Box> {
  static constexpr auto all = named(member("xmin", &Box::xmin), member("ymin", &Box::ymin),
                                    member("xmax", &Box::xmax), member("ymax", &Box::ymax));
};
static_assert(has_all_members<Box>());

template <>
struct Members<Color> {
  static constexpr auto all = named(member("rgba", &Color::rgba));
};
static_assert(has_all_members<Color>());

template <>
struct Members<PaperSize> {
  static constexpr auto all = named(member("width", &PaperSize::width), member("height", &PaperSize::height));
};
static_assert(has_all_members<PaperSize>());

template <>
struct Members<Sites> {
  static constexpr auto all =
      named(member("x", &Sites::x), member("y", &Sites::y), member("weight", &Sites::weight));
};
static_assert(has_all_members<Sites>());

template <>
struct Members<Outline> {
  static constexpr auto all =
      named(member("points", &Outline::points), member("ring_offsets", &Outline::ring_offsets),
            member("polygon_offsets", &Outline::polygon_offsets));
};
static_assert(has_all_members<Outline>());

template <>
struct Members<Density> {
  static constexpr auto all = named(member("width", &Density::width), member("height", &Density::height),
                                    member("values", &Density::values), member("box", &Density::box));
};
static_assert(has_all_members<Density>());

template <>
struct Members<CoordinateSystem> {
  static constexpr auto all =
      named(member("kind", &CoordinateSystem::kind), member("organization", &CoordinateSystem::organization),
            member("code", &CoordinateSystem::code), member("definition", &CoordinateSystem::definition),
            member("equal_area_center", &CoordinateSystem::equal_area_center),
            member("from_plane_around", &CoordinateSystem::from_plane_around),
            member("on_globe", &CoordinateSystem::on_globe));
};
static_assert(has_all_members<CoordinateSystem>());

/// By its center, which is all that it is made from.
template <>
struct Pickled<Projection> {
  static py::object of(const Projection& projection, const py::handle& owner) {
    return pickledOf(projection.center(), owner);
  }
  static Projection from(const py::handle& state) {
    return valueOf(Projection::around(unpickled<Point>(state)));
  }
};

template <>
struct Members<PlacedSites> {
  static constexpr auto all =
      named(member("sites", &PlacedSites::sites), member("from", &PlacedSites::from),
            member("domain", &PlacedSites::domain), member("outline", &PlacedSites::outline),
            member("parts", &PlacedSites::parts), member("periodic", &PlacedSites::periodic),
            member("system", &PlacedSites::system), member("projection", &PlacedSites::projection),
            member("globe", &PlacedSites::globe), member("longitudes", &PlacedSites::longitudes),
            member("latitudes", &PlacedSites::latitudes), member("degrees", &PlacedSites::degrees),
            member("notes", &PlacedSites::notes));
};
static_assert(has_all_members<PlacedSites>());

template <>
struct Members<Input> {
  static constexpr auto all =
      std::tuple_cat(Members<PlacedSites>::all,
                     named(member("surface", &Input::surface), member("density", &Input::density),
                           member("attributes", &Input::attributes), member("files", &Input::files)));
};
static_assert(memberCount<Input>() == 5);  // the first is what it is derived from

/// Values as one text, and where each ends; -1 where it is missing.
template <>
struct Pickled<Attribute> {
  static py::object of(const Attribute& attribute, const py::handle& owner) {
    std::string text;
    std::vector<std::int64_t> ends;
    for (std::size_t site = 0; site < attribute.size(); ++site) {
      const auto value = attribute.at(site);
      if (value) text += *value;
      ends.push_back(value ? static_cast<std::int64_t>(text.size()) : -1);
    }
    return py::make_tuple(pickledOf(attribute.name(), owner), pickledOf(attribute.type(), owner),
                          pickledOf(text, owner),
                          py::array_t<std::int64_t>(py::ssize_t(ends.size()), ends.data()));
  }
  static Attribute from(const py::handle& given) {
    const auto state = asIs<py::tuple>(given);
    if (state.size() != 4) throw OtherPickle{};
    Attribute attribute(unpickled<std::string>(state[0]), unpickled<AttributeType>(state[1]));
    const auto text = unpickled<std::string>(state[2]);
    std::size_t begin = 0;
    for (const std::int64_t end : unpickled<std::vector<std::int64_t>>(state[3])) {
      if (end < 0) {
        attribute.add(std::nullopt);
        continue;
      }
      const auto to = static_cast<std::size_t>(end);
      if (to < begin || to > text.size()) throw OtherPickle{};
      attribute.add(std::string_view(text).substr(begin, to - begin));
      begin = to;
    }
    return attribute;
  }
};

template <>
struct Members<Attributes> {
  static constexpr auto all = named(member("columns", &Attributes::columns));
};
static_assert(has_all_members<Attributes>());

template <>
struct Members<Generator> {
  static constexpr auto all = named(member("pattern", &Generator::pattern),
                                    member("count", &Generator::count), member("seed", &Generator::seed));
};
static_assert(has_all_members<Generator>());

template <>
struct Members<Table> {
  static constexpr auto all =
      named(member("name", &Table::name), member("sites", &Table::sites),
            member("attributes", &Table::attributes), member("system", &Table::system),
            member("generator", &Table::generator), member("skipped", &Table::skipped),
            member("notes", &Table::notes), member("of_caller", &Table::of_caller));
};
static_assert(has_all_members<Table>());

template <>
struct Members<Times> {
  static constexpr auto all = named(member("order", &Times::order), member("upload", &Times::upload),
                                    member("search", &Times::search), member("cells", &Times::cells),
                                    member("draw", &Times::draw), member("download", &Times::download));
};
static_assert(has_all_members<Times>());

template <>
struct Members<PipelineTime> {
  static constexpr auto all =
      named(member("name", &PipelineTime::name), member("milliseconds", &PipelineTime::milliseconds));
};
static_assert(has_all_members<PipelineTime>());

template <>
struct Members<Report> {
  static constexpr auto all =
      named(member("backend", &Report::backend), member("device", &Report::device),
            member("driver", &Report::driver), member("ok", &Report::ok), member("empty", &Report::empty),
            member("duplicate", &Report::duplicate), member("hidden", &Report::hidden),
            member("retried", &Report::retried), member("in_double", &Report::in_double),
            member("exact", &Report::exact), member("pixels", &Report::pixels),
            member("time_ms", &Report::time_ms), member("pipelines", &Report::pipelines),
            member("notes", &Report::notes), member("validation_messages", &Report::validation_messages));
};
static_assert(has_all_members<Report>());

template <>
struct Members<Diagram> {
  static constexpr auto all = named(
      member("status", &Diagram::status), member("owner", &Diagram::owner), member("area", &Diagram::area),
      member("perimeter", &Diagram::perimeter), member("solid_angle", &Diagram::solid_angle),
      member("centroid", &Diagram::centroid), member("second_moments", &Diagram::second_moments),
      member("cell_offsets", &Diagram::cell_offsets), member("vertices", &Diagram::vertices),
      member("neighbors", &Diagram::neighbors), member("edge_lengths", &Diagram::edge_lengths),
      member("neighbor_shifts", &Diagram::neighbor_shifts), member("ring_starts", &Diagram::ring_starts),
      member("mass", &Diagram::mass), member("mass_centroid", &Diagram::mass_centroid),
      member("triangles", &Diagram::triangles), member("report", &Diagram::report));
};
static_assert(has_all_members<Diagram>());

template <>
struct Members<Box3> {
  static constexpr auto all =
      named(member("xmin", &Box3::xmin), member("ymin", &Box3::ymin), member("zmin", &Box3::zmin),
            member("xmax", &Box3::xmax), member("ymax", &Box3::ymax), member("zmax", &Box3::zmax));
};
static_assert(has_all_members<Box3>());

template <>
struct Members<Diagram3> {
  static constexpr auto all = named(
      member("status", &Diagram3::status), member("owner", &Diagram3::owner),
      member("volume", &Diagram3::volume), member("surface", &Diagram3::surface),
      member("centroid", &Diagram3::centroid), member("second_moments", &Diagram3::second_moments),
      member("face_offsets", &Diagram3::face_offsets), member("neighbors", &Diagram3::neighbors),
      member("face_areas", &Diagram3::face_areas), member("neighbor_shifts", &Diagram3::neighbor_shifts),
      member("face_vertex_offsets", &Diagram3::face_vertex_offsets),
      member("face_vertices", &Diagram3::face_vertices), member("vertices", &Diagram3::vertices),
      member("vertex_site_offsets", &Diagram3::vertex_site_offsets),
      member("vertex_sites", &Diagram3::vertex_sites), member("flat", &Diagram3::flat),
      member("report", &Diagram3::report));
};
static_assert(has_all_members<Diagram3>());

template <>
struct Members<SpaceSites> {
  static constexpr auto all =
      named(member("name", &SpaceSites::name), member("sites", &SpaceSites::sites),
            member("weights", &SpaceSites::weights), member("attributes", &SpaceSites::attributes),
            member("generated", &SpaceSites::generated), member("notes", &SpaceSites::notes),
            member("box", &SpaceSites::box));
};
static_assert(has_all_members<SpaceSites>());

template <>
struct Members<SpaceResult> {
  static constexpr auto all =
      named(member("sites", &SpaceResult::sites), member("domain", &SpaceResult::domain),
            member("detail", &SpaceResult::detail), member("diagram", &SpaceResult::diagram),
            member("weights", &SpaceResult::weights), member("periodic", &SpaceResult::periodic),
            member("lattice", &SpaceResult::lattice));
};
static_assert(has_all_members<SpaceResult>());

template <>
struct Members<Topology> {
  static constexpr auto all =
      named(member("vertices", &Topology::vertices), member("vertex_of", &Topology::vertex_of),
            member("edge_entry", &Topology::edge_entry), member("edge_vertices", &Topology::edge_vertices),
            member("edge_cells", &Topology::edge_cells), member("edge_of", &Topology::edge_of));
};
static_assert(has_all_members<Topology>());

template <>
struct Members<SearchOptions> {
  static constexpr auto all =
      named(member("method", &SearchOptions::method), member("neighbors", &SearchOptions::neighbors));
};
static_assert(has_all_members<SearchOptions>());

/// The domain, the outline and the period are the input's.
template <>
struct Pickled<CellsResult> {
  static py::object of(const CellsResult& result, const py::handle& owner) {
    return py::make_tuple(pickledOf(result.input, owner), pickledOf(result.options.search, owner),
                          pickledOf(result.options.detail, owner), pickledOf(result.diagram, owner));
  }
  static CellsResult from(const py::handle& given) {
    const auto state = asIs<py::tuple>(given);
    if (state.size() != 4) throw OtherPickle{};
    auto input = unpickled<std::shared_ptr<const Input>>(state[0]);
    CellsOptions options = cellsOptionsOf(*input);
    options.search = unpickled<SearchOptions>(state[1]);
    options.detail = unpickled<Detail>(state[2]);
    return resultOf(std::move(input), std::move(options), unpickled<Diagram>(state[3]), 0);
  }
};

template <>
struct Members<ColorRange> {
  static constexpr auto all = named(member("low", &ColorRange::low), member("high", &ColorRange::high));
};
static_assert(has_all_members<ColorRange>());

template <>
struct Members<ColorKey> {
  static constexpr auto all = named(
      member("color", &ColorKey::color), member("scale", &ColorKey::scale), member("range", &ColorKey::range),
      member("ticks", &ColorKey::ticks), member("title", &ColorKey::title), member("names", &ColorKey::names),
      member("other_names", &ColorKey::other_names), member("has_missing", &ColorKey::has_missing));
};
static_assert(has_all_members<ColorKey>());

template <>
struct Members<SiteValues> {
  static constexpr auto all =
      named(member("title", &SiteValues::title), member("numbers", &SiteValues::numbers),
            member("name_of", &SiteValues::name_of), member("names", &SiteValues::names));
};
static_assert(has_all_members<SiteValues>());

/// The members that have rows.
template <class... Row>
constexpr auto membersOf(const std::tuple<Row...>& rows) {
  return std::apply([](const auto&... row) { return named(member(row.name, row.member)...); }, rows);
}

template <>
struct Members<RenderOptions> {
  static constexpr auto all = std::tuple_cat(
      named(member("width", &RenderOptions::width), member("height", &RenderOptions::height),
            member("color", &RenderOptions::color), member("colormap", &RenderOptions::colormap),
            member("search", &RenderOptions::search), member("color_scale", &RenderOptions::color_scale),
            member("color_range", &RenderOptions::color_range), member("legend", &RenderOptions::legend),
            member("fit", &RenderOptions::fit), member("view", &RenderOptions::view),
            member("fill", &RenderOptions::fill), member("site_colors", &RenderOptions::site_colors),
            member("paper", &RenderOptions::paper), member("values", &RenderOptions::values),
            member("colors", &RenderOptions::colors), member("texts", &RenderOptions::texts),
            member("title", &RenderOptions::title), member("legend_title", &RenderOptions::legend_title),
            member("legend_beside", &RenderOptions::legend_beside),
            member("legend_factor", &RenderOptions::legend_factor), member("globe", &RenderOptions::globe),
            member("map", &RenderOptions::map), member("view_from", &RenderOptions::view_from)),
      membersOf(picture_rows));
};
static_assert(has_all_members<RenderOptions>(5));  // the progress is the run's, the others are the input's

template <>
struct Members<Image> {
  static constexpr auto all = named(member("width", &Image::width), member("height", &Image::height),
                                    member("rgba", &Image::rgba), member("ids", &Image::ids));
};
static_assert(has_all_members<Image>());

template <>
struct Members<Rendering> {
  static constexpr auto all = named(member("image", &Rendering::image), member("status", &Rendering::status),
                                    member("owner", &Rendering::owner), member("key", &Rendering::key),
                                    member("report", &Rendering::report));
};
static_assert(has_all_members<Rendering>());

template <>
struct Pickled<PictureResult> {
  static py::object of(const PictureResult& result, const py::handle& owner) {
    return py::make_tuple(pickledOf(result.input, owner), pickledOf(result.options, owner),
                          pickledOf(result.rendering, owner));
  }
  static PictureResult from(const py::handle& given) {
    const auto state = asIs<py::tuple>(given);
    if (state.size() != 3) throw OtherPickle{};
    auto input = unpickled<std::shared_ptr<const Input>>(state[0]);
    auto options = unpickled<RenderOptions>(state[1]);
    options.domain = input->domain;
    options.outline = input->outline;
    options.periodic = input->periodic;
    return {std::move(input), std::move(options), unpickled<Rendering>(state[2])};
  }
};

template <>
struct Members<RelaxStep> {
  static constexpr auto all =
      named(member("diagram", &RelaxStep::diagram), member("energy", &RelaxStep::energy),
            member("hexagonal", &RelaxStep::hexagonal), member("farthest", &RelaxStep::farthest),
            member("seconds", &RelaxStep::seconds), member("taken", &RelaxStep::taken));
};
static_assert(has_all_members<RelaxStep>());

template <>
struct Members<Relaxed> {
  static constexpr auto all = named(member("sites", &Relaxed::sites), member("trace", &Relaxed::trace),
                                    member("end", &Relaxed::end), member("report", &Relaxed::report));
};
static_assert(has_all_members<Relaxed>());

template <>
struct Members<RelaxResult> {
  static constexpr auto all =
      named(member("input", &RelaxResult::input), member("relaxed", &RelaxResult::relaxed));
};
static_assert(has_all_members<RelaxResult>());

template <>
struct Members<TransportStep> {
  static constexpr auto all = named(
      member("diagram", &TransportStep::diagram), member("newton", &TransportStep::newton),
      member("length", &TransportStep::length), member("taken", &TransportStep::taken),
      member("norm", &TransportStep::norm), member("worst", &TransportStep::worst),
      member("least", &TransportStep::least), member("linear_iterations", &TransportStep::linear_iterations),
      member("seconds", &TransportStep::seconds));
};
static_assert(has_all_members<TransportStep>());

template <>
struct Members<CellMoments> {
  static constexpr auto all =
      named(member("status", &CellMoments::status), member("area", &CellMoments::area),
            member("mass", &CellMoments::mass), member("centroid", &CellMoments::centroid),
            member("spread", &CellMoments::spread));
};
static_assert(has_all_members<CellMoments>());

template <>
struct Members<Transported> {
  static constexpr auto all =
      named(member("sites", &Transported::sites), member("cells", &Transported::cells),
            member("trace", &Transported::trace), member("end", &Transported::end),
            member("cost", &Transported::cost), member("report", &Transported::report));
};
static_assert(has_all_members<Transported>());

template <>
struct Members<TransportResult> {
  static constexpr auto all =
      named(member("input", &TransportResult::input), member("surface", &TransportResult::surface),
            member("found", &TransportResult::found));
};
static_assert(has_all_members<TransportResult>());

}  // namespace vorpipe::python
