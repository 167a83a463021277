#include "cli/space_input.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/sites/space_source.h"

namespace vorpipe::cli {
namespace {

/// The domain that the options name, or that of the sites.
Result<Box3> domainInSpace(const InputOptions& options, const SpaceTable& table) {
  if (options.domain.space) return *options.domain.space;
  if (table.generated) return Box3{0, 0, 0, 1, 1, 1};
  if (table.box && !options.margin) return *table.box;
  const Box3 box = domainOf(table.sites, options.margin.value_or(Margin{}));
  const bool finite = std::isfinite(box.xmax - box.xmin) && std::isfinite(box.ymax - box.ymin) &&
                      std::isfinite(box.zmax - box.zmin);
  if (!finite) {
    return inputError(fmt::format(
        "--sites: {}: the sites extend too far for a box around them; --domain names one", options.sites));
  }
  const bool flat = !(box.xmin < box.xmax && box.ymin < box.ymax && box.zmin < box.zmax);
  if (flat) {
    return inputError(
        "--margin: the sites lie in a plane, and without a margin their box has no volume; --domain "
        "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX names one");
  }
  return box;
}

}  // namespace

Result<SpaceInput> loadSpaceInput(const InputOptions& options) {
  const Stopwatch watch;
  ReadOptions reading = options.reading;
  if (options.sites == "-") reading.format = options.format.input;
  auto table = loadSpaceSites(options.sites, options.seed, reading, options.domain.space);
  if (!table) return named("--sites", std::move(table.error()));
  if (options.margin && (options.domain.space || table->generated)) {
    return inputError("--margin: is for the box around a file's sites");
  }
  if (options.periodic.any() && !options.domain.space && !table->generated) {
    return inputError(
        "--periodic: name the period by --domain XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX; a file of sites does not say "
        "it");
  }
  if (options.lattice && table->generated) {
    const auto& [a, b, c] = *options.lattice;
    for (Point3& p : table->sites) {
      p = {(p.x * a.x + p.y * b.x) + p.z * c.x, (p.x * a.y + p.y * b.y) + p.z * c.y,
           (p.x * a.z + p.y * b.z) + p.z * c.z};
    }
  }
  VORPIPE_LET(domain, options.lattice ? Result<Box3>(Box3{}) : domainInSpace(options, *table));
  SpaceInput input;
  input.domain = domain;
  if (table->generated) input.common.seed = options.seed;
  input.common.notes = std::move(table->notes);
  input.common.attributes = std::move(table->attributes);
  input.common.sites.weight = std::move(table->weights);
  VORPIPE_TRY(takeWeights(options, table->sites.size(), input.common));
  input.sites = std::move(table->sites);
  input.common.read_ms = watch.milliseconds();
  return input;
}

}  // namespace vorpipe::cli
