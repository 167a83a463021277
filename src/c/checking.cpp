/// Checks promises about results, and compares two results.
#include <fmt/core.h>

#include <algorithm>

#include "c/calls.h"
#include "c/handles.h"
#include "c/options.h"

namespace vorpipe::c {
namespace {

/// Sends each broken promise to the caller, in a line of its own.
vorpipe_code tellBroken(const Result<std::vector<std::string>>& broken, vorpipe_write write, void* user) {
  if (!broken) return fail(broken.error());
  if (broken->empty()) return VORPIPE_DONE;
  for (const std::string& promise : *broken) {
    const std::string line = promise + "\n";
    if (write != nullptr && write(user, line.data(), line.size()) != 0) break;
  }
  return fail(VORPIPE_DIFFERENT, broken->front());
}

/// Returns broken promises of cells, checked in the plane where they were made.
Result<std::vector<std::string>> checkCells(const vorpipe_diagram& given, int threads) {
  const Sites& sites = *given.input->sites;
  if (!given.plane) return check(sites, given.options, given.diagram, threads);
  Diagram diagram = given.diagram;
  diagram.vertices = given.plane->vertices;
  diagram.centroid = given.plane->centroid;
  diagram.mass_centroid = given.plane->mass_centroid;
  return check(sites, given.options, diagram, threads);
}

/// Returns the result of a compare function, and stores the figures for the caller.
template <class Difference>
vorpipe_code tellDifference(bool agree, const std::string& message, const Difference& figures, Difference* to,
                            std::string_view name) {
  if (to != nullptr) {
    if (auto given = give(figures, to, name); !given) return fail(given.error());
  }
  return agree ? vorpipe_code{VORPIPE_DONE} : fail(VORPIPE_DIFFERENT, message);
}

vorpipe_code compareIds(const vorpipe_picture& a, const vorpipe_picture& b,
                        vorpipe_picture_difference* difference) {
  const Image& first = a.rendering.image;
  const auto& ids = b.rendering.image.ids;
  const vorpipe_picture& drawn = a.input != nullptr ? a : b;
  Result<IdDiff> found = drawn.input == nullptr
                             ? diffIds(first.ids, ids, first.width, first.height)
                             : diffIds(first.ids, ids, first.width, first.height, *drawn.input->sites,
                                       drawn.options.domain, drawn.options.periodic, drawn.options.fit);
  if (!found) return fail(found.error());
  vorpipe_picture_difference figures{};
  figures.equal = found->equal;
  figures.ties = found->ties;
  figures.wrong = found->wrong;
  figures.ties_allowed = found->ties_allowed;
  figures.widest_tie = found->widest_tie;
  return tellDifference(
      found->agree(),
      fmt::format("{} pixels have different sites, {} others are ties, {} of which are allowed", found->wrong,
                  found->ties, found->ties_allowed),
      figures, difference, "vorpipe_picture_difference");
}

vorpipe_code compareColors(const Image& a, const Image& b, vorpipe_picture_difference* difference) {
  const ImageDiff found = diffImages(a.rgba, b.rgba, a.width, a.height);
  vorpipe_picture_difference figures{};
  figures.largest = static_cast<std::uint32_t>(found.largest);
  figures.equal = a.rgba.size() - found.different;
  figures.wrong = found.different;
  return tellDifference(found.different == 0,
                        fmt::format("{} pixels differ, by up to {}", found.different, found.largest), figures,
                        difference, "vorpipe_picture_difference");
}

vorpipe_code comparePictures(const vorpipe_picture& a, const vorpipe_picture& b,
                             vorpipe_picture_difference* difference) {
  const Image &first = a.rendering.image, &second = b.rendering.image;
  if (first.width != second.width || first.height != second.height) {
    return fail(VORPIPE_INPUT, fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared",
                                           first.width, first.height, second.width, second.height));
  }
  if (!first.ids.empty() && !second.ids.empty()) return compareIds(a, b, difference);
  if (!first.rgba.empty() && !second.rgba.empty()) return compareColors(first, second, difference);
  return fail(VORPIPE_INPUT, "one picture has pixels alone, the other has ids alone");
}

vorpipe_code compareDiagrams(const vorpipe_diagram& a, const vorpipe_diagram& b,
                             vorpipe_cells_difference* difference) {
  const auto found = diffCells(a.diagram, b.diagram);
  if (!found) return fail(found.error());
  vorpipe_cells_difference figures{};
  figures.worst_site = found->worst_site;
  figures.equal = found->equal;
  figures.statuses = found->statuses;
  figures.neighbors = found->neighbors;
  figures.areas = found->areas;
  figures.worst_area = found->worst_area;
  return tellDifference(
      found->agree(),
      fmt::format("{} cells differ in their status, {} in their neighbors, {} in their area", found->statuses,
                  found->neighbors, found->areas),
      figures, difference, "vorpipe_cells_difference");
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_diagram_check(const vorpipe_diagram* diagram, int32_t threads, vorpipe_write broken,
                                   void* user) {
  if (diagram == nullptr) return missing("diagram");
  return guarded([&] {
    const auto count = threadsOf(threads);
    if (!count) return fail(count.error());
    if (diagram->has_air) return fail(VORPIPE_INPUT, "cells with a free surface cannot be checked yet");
    return tellBroken(checkCells(*diagram, *count), broken, user);
  });
}

vorpipe_code vorpipe_picture_check(const vorpipe_picture* picture, int32_t threads, vorpipe_write broken,
                                   void* user) {
  if (picture == nullptr) return missing("picture");
  return guarded([&] {
    const auto count = threadsOf(threads);
    if (!count) return fail(count.error());
    if (picture->input == nullptr) {
      return fail(VORPIPE_INPUT, "a picture that was read cannot be checked: its sites are not known");
    }
    if (picture->has_air) return fail(VORPIPE_INPUT, "pictures with a free surface cannot be checked yet");
    return tellBroken(check(*picture->input->sites, picture->options, picture->rendering, *count), broken,
                      user);
  });
}

vorpipe_code vorpipe_diagrams_compare(const vorpipe_diagram* a, const vorpipe_diagram* b,
                                      vorpipe_cells_difference* difference) {
  if (a == nullptr || b == nullptr) return missing("diagram");
  return guarded([&] { return compareDiagrams(*a, *b, difference); });
}

vorpipe_code vorpipe_pictures_compare(const vorpipe_picture* a, const vorpipe_picture* b,
                                      vorpipe_picture_difference* difference) {
  if (a == nullptr || b == nullptr) return missing("picture");
  return guarded([&] { return comparePictures(*a, *b, difference); });
}
