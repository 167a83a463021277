#include "selftest/checks.h"

#include <fmt/core.h>

#include <utility>

#include "base/stopwatch.h"

namespace vorpipe::selftests {
namespace {

RenderOptions pictureOptions(const Scene& scene, const Progress& progress) {
  RenderOptions options{};
  options.domain = scene.domain;
  options.outline = scene.outline;
  options.periodic = scene.periodic;
  options.width = scene.width;
  options.height = scene.height;
  options.progress = progress;
  return options;
}

CellsOptions optionsOfCells(const Scene& scene, const Progress& progress) {
  CellsOptions options = cellsOptions(pictureOptions(scene, progress));
  options.detail = Detail::everything;
  return options;
}

bool wasRefused(const Error& error, bool refusable) { return refusable && error.code == ErrorCode::input; }

std::string firstOf(std::string_view what, const Result<std::vector<std::string>>& broken) {
  if (!broken) return fmt::format("{}: the check itself failed: {}", what, broken.error().message);
  return broken->empty() ? "" : fmt::format("{}: {}", what, broken->front());
}

template <class T>
std::string validationFault(std::string_view what, const Result<T>& result) {
  if (!result || result->report.validation_messages.empty()) return {};
  return fmt::format("{}: validation: {}", what, result->report.validation_messages.front());
}

std::string siteText(std::uint32_t id) { return id == no_site ? "no site" : fmt::format("site {}", id); }

std::string pictureDifference(const Image& image, const Image& reference, const Scene& scene) {
  const auto diff =
      diffIds(image.ids, reference.ids, scene.width, scene.height, scene.sites, scene.domain, scene.periodic);
  if (!diff) return fmt::format("picture: {}", diff.error().message);
  if (diff->wrong > 0) {
    const IdDifference& first = diff->first.front();
    return fmt::format(
        "picture: {} of {} pixels differ from cpu's, first row {}, column {}: {}, not {}, {:.3g} px from "
        "their bisector",
        diff->wrong, image.ids.size(), first.row, first.column, siteText(first.a), siteText(first.b),
        first.distance);
  }
  if (diff->ties <= diff->ties_allowed) return {};
  return fmt::format("picture: {} pixels are ties, where {} can be", diff->ties, diff->ties_allowed);
}

std::string cellsDifference(const Diagram& cells, const Diagram& reference) {
  const auto diff = diffCells(cells, reference);
  if (!diff) return fmt::format("cells: {}", diff.error().message);
  if (diff->agree()) return {};
  const CellDifference& first = diff->first.front();
  std::string what;
  if (first.status) {
    what = "another status";
  } else if (first.neighbors) {
    what = "other neighbors";
  } else {
    what = fmt::format("the area {}, not {}", first.area_a, first.area_b);
  }
  return fmt::format("cells: {} of {} differ from cpu's, first that of site {}: {}",
                     cells.status.size() - diff->equal, cells.status.size(), first.site, what);
}

}  // namespace

Outcome compute(Runs& runs, const Scene& scene, const Progress& progress) {
  const Stopwatch watch;
  auto picture = runs.render(scene.sites, pictureOptions(scene, progress));
  auto cells = runs.cells(scene.sites, optionsOfCells(scene, progress));
  return {std::move(picture), std::move(cells), watch.milliseconds()};
}

bool failedWith(ErrorCode code, const Outcome& outcome) {
  return (!outcome.picture && outcome.picture.error().code == code) ||
         (!outcome.cells && outcome.cells.error().code == code);
}

std::vector<std::string> notesOf(const Outcome& outcome) {
  std::vector<std::string> notes;
  if (outcome.picture) notes = outcome.picture->report.notes;
  if (outcome.cells)
    notes.insert(notes.end(), outcome.cells->report.notes.begin(), outcome.cells->report.notes.end());
  return notes;
}

std::string faultByCheck(const Outcome& outcome, const Scene& scene, bool refusable, int threads) {
  const auto& [picture, cells, milliseconds] = outcome;
  if (!picture && !wasRefused(picture.error(), refusable)) return "picture: " + picture.error().message;
  if (!cells && !wasRefused(cells.error(), refusable)) return "cells: " + cells.error().message;
  std::string fault = validationFault("picture", picture);
  if (fault.empty()) fault = validationFault("cells", cells);
  if (fault.empty() && picture) {
    fault = firstOf("picture", check(scene.sites, pictureOptions(scene, {}), *picture, threads));
  }
  if (fault.empty() && cells) {
    fault = firstOf("cells", check(scene.sites, optionsOfCells(scene, {}), *cells, threads));
  }
  return fault;
}

std::string faultByReference(const Outcome& outcome, const Outcome& reference, const Scene& scene) {
  std::string fault;
  if (outcome.picture && reference.picture) {
    fault = pictureDifference(outcome.picture->image, reference.picture->image, scene);
  }
  if (fault.empty() && outcome.cells && reference.cells)
    fault = cellsDifference(*outcome.cells, *reference.cells);
  return fault;
}

}  // namespace vorpipe::selftests
