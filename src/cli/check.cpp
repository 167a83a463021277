#include "cli/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/difference_text.h"

namespace vorpipe::cli {
namespace {

std::string brokenStatus(const Rendering& rendering, std::size_t sites) {
  const Report& report = rendering.report;
  if (rendering.status.size() != sites || rendering.owner.size() != sites) {
    return fmt::format("{} sites have {} statuses and {} owners", sites, rendering.status.size(),
                       rendering.owner.size());
  }
  std::array<std::uint64_t, 3> counts{};
  for (const Status status : rendering.status) ++counts[static_cast<std::size_t>(status)];
  if (counts != std::array{report.ok, report.empty, report.duplicate}) {
    return fmt::format("counted {} ok, {} empty, {} duplicate, reported {}, {}, {}", counts[0], counts[1],
                       counts[2], report.ok, report.empty, report.duplicate);
  }
  return {};
}

std::string brokenOwner(const Rendering& rendering, const Sites& sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::size_t owner = rendering.owner[i];
    const bool duplicate = rendering.status[i] == Status::duplicate;
    const bool right = duplicate ? owner < i && rendering.status[owner] != Status::duplicate &&
                                       sites.x[owner] == sites.x[i] && sites.y[owner] == sites.y[i]
                                 : owner == i;
    if (!right) return fmt::format("site {} cannot be owned by site {}", i, owner);
  }
  return {};
}

std::string brokenPixel(const Rendering& rendering) {
  const Image& image = rendering.image;
  const auto bad = std::ranges::find_if(image.ids, [&](std::uint32_t id) {
    return id >= rendering.status.size() || rendering.status[id] != Status::ok;
  });
  if (bad == image.ids.end()) return {};
  const auto pixel = static_cast<std::size_t>(bad - image.ids.begin());
  const auto width = static_cast<std::size_t>(image.width);
  return fmt::format("row {}, column {} belongs to {}", pixel / width, pixel % width,
                     *bad == no_site ? "no site" : fmt::format("site {}, which has no cell", *bad));
}

}  // namespace

Result<std::string> checkRendering(const Input& input, const RenderOptions& options,
                                   const Rendering& rendering, int threads) {
  std::string broken = brokenStatus(rendering, input.sites.size());
  if (broken.empty()) broken = brokenOwner(rendering, input.sites);
  if (broken.empty()) broken = brokenPixel(rendering);
  if (!broken.empty()) return broken;

  BackendOptions judge_options;
  judge_options.name = "cpu";
  judge_options.threads = threads;
  auto judge = Session::open(judge_options);
  if (!judge) return tl::unexpected(std::move(judge.error()));
  const auto truth = judge->render(input.sites, options);
  if (!truth) return tl::unexpected(truth.error());
  const auto diff = diffIds(rendering.image.ids, truth->image.ids, options.width, options.height, input.sites,
                            options.domain);
  if (!diff) return tl::unexpected(diff.error());
  return diff->agree() ? std::string() : "against the cpu backend: " + disagreementText(*diff);
}

}  // namespace vorpipe::cli
