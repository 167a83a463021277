/// Sites, their weights, domain and density.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "c/failure.h"
#include "c/handles.h"
#include "c/structs.h"
#include "io/domain/density_file.h"
#include "io/domain/outline_file.h"
#include "io/files/error.h"
#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"
#include "io/sites/weights_file.h"

namespace vorpipe::c {
namespace {

/// Copies `count` numbers, each `stride` bytes after the one before; 0: without gaps.
std::vector<double> copied(const double* numbers, std::uint64_t count, std::size_t stride) {
  if (stride == 0 || stride == sizeof(double)) return {numbers, numbers + count};
  std::vector<double> copy(count);
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbers);
  for (std::uint64_t k = 0; k < count; ++k) std::memcpy(&copy[k], bytes + k * stride, sizeof(double));
  return copy;
}

/// What has sites, and the domain that is theirs if none is set.
Result<vorpipe_input> inputOf(Sites sites, bool of_unit_square) {
  if (sites.size() > max_sites) {
    return inputError(fmt::format("sites: {} of at most {}", sites.size(), max_sites));
  }
  vorpipe_input input;
  input.domain = of_unit_square || sites.size() == 0 ? Box{0, 0, 1, 1} : domainOf(sites);
  input.of_unit_square = of_unit_square;
  input.sites = std::make_shared<const Sites>(std::move(sites));
  return input;
}

/// Gives the caller an object.
vorpipe_code give(Result<vorpipe_input> made, vorpipe_input** input) {
  if (!made) return fail(made.error());
  *input = new vorpipe_input(std::move(*made));
  return VORPIPE_DONE;
}

vorpipe_code setWeights(vorpipe_input& input, Result<std::vector<double>> weights) {
  if (!weights) return fail(weights.error());
  Sites sites = *input.sites;
  sites.weight = std::move(*weights);
  input.sites = std::make_shared<const Sites>(std::move(sites));
  return VORPIPE_DONE;
}

vorpipe_code setOutline(vorpipe_input& input, Result<Outline> outline) {
  if (!outline) return fail(outline.error());
  if (outline->empty()) return fail(VORPIPE_INPUT, "outline: has no points", Subject::outline);
  input.domain = boxOf(outline->points);
  if (input.of_unit_square)
    input.sites = std::make_shared<const Sites>(spreadOver(input.domain, *input.sites));
  input.of_unit_square = false;
  input.outline = std::move(*outline);
  input.periodic = Periodic::none;
  return VORPIPE_DONE;
}

/// A table of `count` parts of `whole` things: begins with 0, ascends, ends with their number.
Result<std::vector<std::uint64_t>> offsetsOf(const std::uint64_t* offsets, std::uint64_t count,
                                             std::uint64_t whole, std::string_view name) {
  if (offsets == nullptr) return inputError(fmt::format("{}: is NULL", name));
  std::vector<std::uint64_t> table(offsets, offsets + count + 1);
  if (table.front() != 0 || table.back() != whole || !std::ranges::is_sorted(table)) {
    return inputError(fmt::format("{}: does not ascend from 0 to {}", name, whole));
  }
  return table;
}

Result<Outline> outlineOf(const vorpipe_outline& given) {
  if (given.points == nullptr) return inputError("points: is NULL");
  auto rings = offsetsOf(given.ring_offsets, given.ring_count, given.point_count, "ring_offsets");
  if (!rings) return tl::unexpected(rings.error());
  auto polygons = offsetsOf(given.polygon_offsets, given.polygon_count, given.ring_count, "polygon_offsets");
  if (!polygons) return tl::unexpected(polygons.error());
  Outline outline;
  outline.ring_offsets = std::move(*rings);
  outline.polygon_offsets = std::move(*polygons);
  outline.points.reserve(given.point_count);
  for (std::uint64_t k = 0; k < given.point_count; ++k) {
    outline.points.push_back({given.points[2 * k], given.points[2 * k + 1]});
  }
  return outline;
}

Result<Sites> sitesOf(const vorpipe_sites& given) {
  if (given.count > 0 && given.x == nullptr) return inputError("x: is NULL");
  if (given.count > 0 && given.y == nullptr) return inputError("y: is NULL");
  Sites sites;
  sites.x = copied(given.x, given.count, given.position_stride);
  sites.y = copied(given.y, given.count, given.position_stride);
  if (given.weight != nullptr) sites.weight = copied(given.weight, given.count, given.weight_stride);
  for (std::uint64_t k = 0; k < given.count; ++k) {
    if (std::isfinite(sites.x[k]) && std::isfinite(sites.y[k])) continue;
    return tl::unexpected(
        Error{ErrorCode::input, fmt::format("sites: site {} is not finite", k), false, Subject::sites});
  }
  return sites;
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_input_create(const vorpipe_sites* sites, vorpipe_input** input) {
  if (sites == nullptr) return missing("sites");
  if (input == nullptr) return missing("input");
  return guarded([&] {
    const auto given = taken(sites, "vorpipe_sites");
    if (!given) return fail(given.error());
    auto copy = sitesOf(*given);
    if (!copy) return fail(copy.error());
    return give(inputOf(std::move(*copy), false), input);
  });
}

vorpipe_code vorpipe_input_read(const char* sites, uint64_t seed, vorpipe_input** input) {
  if (sites == nullptr) return missing("sites");
  if (input == nullptr) return missing("input");
  return guarded([&] {
    auto source = loadSites(sites, seed, {.attributes = false});
    if (!source) return fail(source.error());
    return give(inputOf(std::move(source->table.sites), source->seed.has_value()), input);
  });
}

void vorpipe_input_free(vorpipe_input* input) { delete input; }

uint64_t vorpipe_input_count(const vorpipe_input* input) {
  return input == nullptr ? 0 : input->sites->size();
}

vorpipe_code vorpipe_input_set_weights(vorpipe_input* input, const double* weights, uint64_t count) {
  if (input == nullptr) return missing("input");
  if (weights == nullptr) return missing("weights");
  return guarded([&] {
    if (count != input->sites->size()) {
      return fail(VORPIPE_INPUT, fmt::format("weights: {} for {} sites", count, input->sites->size()),
                  Subject::weights);
    }
    return setWeights(*input, std::vector<double>(weights, weights + count));
  });
}

vorpipe_code vorpipe_input_read_weights(vorpipe_input* input, const char* path) {
  if (input == nullptr) return missing("input");
  if (path == nullptr) return missing("path");
  return guarded([&] { return setWeights(*input, readWeights(path, input->sites->size())); });
}

vorpipe_code vorpipe_input_random_weights(vorpipe_input* input, double low, double high, uint64_t seed) {
  if (input == nullptr) return missing("input");
  return guarded([&] {
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
      return fail(VORPIPE_INPUT, fmt::format("weights: none are from {} to {}", low, high), Subject::weights);
    }
    return setWeights(*input, randomWeights(low, high, input->sites->size(), seed));
  });
}

vorpipe_code vorpipe_input_set_box(vorpipe_input* input, double xmin, double ymin, double xmax, double ymax,
                                   vorpipe_axes periodic) {
  if (input == nullptr) return missing("input");
  if (periodic < VORPIPE_PERIODIC_NONE || periodic > VORPIPE_PERIODIC_XY) {
    return guarded(
        [&] { return fail(VORPIPE_INPUT, fmt::format("periodic: no axes {}", periodic), Subject::period); });
  }
  constexpr Periodic axes[] = {Periodic::none, Periodic::x, Periodic::y, Periodic::xy};
  input->domain = {xmin, ymin, xmax, ymax};
  input->outline = {};
  input->periodic = axes[periodic];
  return VORPIPE_DONE;
}

vorpipe_code vorpipe_input_set_outline(vorpipe_input* input, const vorpipe_outline* outline) {
  if (input == nullptr) return missing("input");
  if (outline == nullptr) return missing("outline");
  return guarded([&] {
    const auto given = taken(outline, "vorpipe_outline");
    if (!given) return fail(given.error());
    return setOutline(*input, outlineOf(*given));
  });
}

vorpipe_code vorpipe_input_read_outline(vorpipe_input* input, const char* path) {
  if (input == nullptr) return missing("input");
  if (path == nullptr) return missing("path");
  return guarded([&] { return setOutline(*input, readOutline(path)); });
}

vorpipe_code vorpipe_input_set_density(vorpipe_input* input, const double* values, int32_t width,
                                       int32_t height) {
  if (input == nullptr) return missing("input");
  if (values == nullptr) return missing("values");
  return guarded([&] {
    if (width < 1 || height < 1) {
      return fail(VORPIPE_INPUT, fmt::format("density: is {} x {} pixels", width, height), Subject::density);
    }
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    input->density = {width, height, std::vector<double>(values, values + count)};
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_read_density(vorpipe_input* input, const char* path) {
  if (input == nullptr) return missing("input");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    auto density = readDensity(path);
    if (!density) return fail(density.error());
    input->density = std::move(*density);
    return vorpipe_code{VORPIPE_DONE};
  });
}
