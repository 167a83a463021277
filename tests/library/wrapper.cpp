/// vorpipe.hpp: the same from C++17, with exceptions.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.hpp"

namespace {

int broken = 0;

void promise(bool holds, const char* what) {
  if (holds) return;
  ++broken;
  std::fprintf(stderr, "broken: %s\n", what);
}

template <class Call>
vorpipe_code thrownBy(const Call& call) {
  try {
    call();
  } catch (const vorpipe::Error& error) {
    return error.code();
  }
  return VORPIPE_DONE;
}

struct Place {
  double east, north;
};

}  // namespace

int main() {
  vorpipe::Session session("cpu", 2);
  promise(std::string(session.device().backend) == "cpu", "the session's backend");
  const std::vector<Place> places{{0.25, 0.5}, {0.75, 0.5}, {0.75, 0.5}};
  auto input = vorpipe::Input::of(places);
  input.box(0, 0, 1, 1);
  const vorpipe::Diagram cells = session.cells(input);
  promise(cells.size() == 3 && cells.area()[0] == 0.5, "areas");
  promise(cells.status()[2] == VORPIPE_DUPLICATE && cells.owner()[2] == 1, "duplicates");
  promise(cells.vertices(1).size() == 4 && cells.neighbors(2).empty(), "parts of cells");
  promise(cells.areaSum() == 1 && cells.check() && cells.agreesWith(cells), "sums, checks, comparisons");
  promise(cells.text("csv").rfind("id,", 0) == 0 || !cells.text("csv").empty(), "text of a format");
  promise(cells.report().ok == 2, "the report");

  auto random = vorpipe::Input::read("random:2000", 5);
  const vorpipe::Picture picture = session.render(random);
  promise(picture.width() == 1000 && picture.ids().size() == 1000000 && picture.check(), "pictures");

  auto relaxed = session.relaxBegin(random);
  promise(relaxed.step() && relaxed.trace().size() == 2 && relaxed.taken()[1] == 1 &&
              relaxed.trace()[1][1] < relaxed.trace()[0][1],
          "energy falls");
  promise(session.cells(relaxed.input()).size() == 2000 && relaxed.sites().size() == 2000, "moved sites");

  int asked = 0;
  const auto interrupt = [&](std::string_view, double) -> bool {
    if (++asked > 30) throw std::runtime_error("the caller's");
    return true;
  };
  try {
    session.relax(random, {}, interrupt);  // which leaves nothing behind: a sanitizer would say so
    promise(false, "the caller's exception");
  } catch (const std::runtime_error& error) {
    promise(error.what() == std::string("the caller's"), "the caller's exception");
  }

  int steps = 0;
  const auto even = session.transport(random, {}, {}, [&](const auto&) { return ++steps > 0; });
  promise(even.end() == VORPIPE_TRANSPORT_CONVERGED && static_cast<int>(even.trace().size()) == steps &&
              std::abs(even.areas()[7] - random.domain()[2] / 2000) < 1e-3,
          "equal areas");
  promise(even.weights().size() == 2000 && session.cells(even.input()).size() == 2000, "weights");

  vorpipe::Fluid dam = session.fluid("dam-break", 60);
  vorpipe_fluid_run_options two_steps = {};
  two_steps.steps = 2;
  std::uint64_t told = 0;
  dam.run(two_steps, [&](const vorpipe_fluid_figures& figures) { return figures.step == ++told; });
  const vorpipe::Diagram fallen = session.cells(dam.input());
  promise(told == 2 && dam.time() > 0 && dam.velocities()[0].y < 0 && dam.end() == VORPIPE_FLUID_GOES_ON,
          "a fluid");
  promise(std::abs(fallen.areaSum() - 2) < 1e-5 && fallen.borderOffsets().size() == dam.sites().size() + 1,
          "cells of a free surface");

  const auto found = vorpipe::Locator(input).find({{0.1, 0.1}, {0.9, 0.1}, {3, 3}});
  promise(found[0] == 0 && found[1] == 1 && found[2] == VORPIPE_NO_SITE, "places");
  promise(cells.edgeCells().size() == cells.sharedVertices().size() + 1,
          "edges and vertices that cells share");

  promise(
      thrownBy([&] { session.cells(random, {}, [](auto, double) { return false; }); }) == VORPIPE_CANCELLED,
      "a run that is stopped");
  try {
    session.cells(random, {}, [](auto, double) -> bool { throw 42; });
    promise(false, "an exception of the caller's comes through");
  } catch (int thrown) {
    promise(thrown == 42, "an exception of the caller's comes through");
  }
  const std::string named = [&] {
    input.attribute("name", {"west", std::nullopt, "east"});
    return session.cells(input).text("geojson", /*only_cells=*/true);
  }();
  promise(input.attributeName(0) == "name" && input.attributeType(0) == VORPIPE_TEXT, "attributes");
  promise(input.attribute(0, 0) == "west" && !input.attribute(0, 1), "values of attributes");
  promise(named.find("west") != std::string::npos && named.find("east") == std::string::npos,
          "attributes of cells");
  auto stations = vorpipe::Input::of(std::vector<Place>{{12, 42}, {13, 42.5}, {12.5, 43}});
  stations.project().margin(0.1, true);
  promise(stations.domain()[2] > 40 && stations.notes().empty(), "a plane in kilometers");
  promise(std::abs(session.cells(stations).centroid()[0].y - 42) < 0.5, "positions in degrees");
  promise(thrownBy([&] { stations.project(12, 91); }) == VORPIPE_INPUT, "no place on the Earth");
  const std::vector<std::array<float, 2>> quarter{{0.25F, 0.5F}, {0.75F, 0.5F}};
  auto game = vorpipe::Input::of(quarter);
  game.box(0, 0, 1, 1).sites(std::vector<std::array<float, 2>>{{0.25F, 0.25F}, {0.25F, 0.75F}});
  const vorpipe::Diagram level = session.cells(game);
  promise(level.neighbors(0).size() == 4 && level.meshTriangles().size() == 4, "two triangles a cell");
  promise(level.meshSites()[7] == 1 && level.meshVertices().size() == 8, "vertices of a mesh");
  vorpipe_render_options looks = {};
  looks.color = VORPIPE_BY_AREA;
  looks.color_scale = VORPIPE_SCALE_LINEAR;
  looks.width = looks.height = 50;
  const vorpipe::Picture by_area = session.render(random, looks);
  const auto key = by_area.key();
  promise(vorpipe::View<std::array<double, 2>>(key.ticks)[0][1] == key.low, "a key's first tick");
  std::string drawn;
  session.draw(random, looks, "svg", [&](std::string_view bytes) { return drawn.append(bytes), true; });
  promise(drawn.find("<svg") != std::string::npos, "shapes");

  promise(thrownBy([] { vorpipe::Session("no such backend"); }) == VORPIPE_INPUT, "bad input");
  promise(thrownBy([&] { input.weights({1, 2}); }) == VORPIPE_INPUT, "too few weights");
  return broken == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
