/// Sites as core would hand them to a backend, and what tests of one backend do with them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>
#include <vector>

#include "backend/backend.h"
#include "backend/to_float.h"
#include "sites/site_set.h"
#include "support/oracles/oracle.h"
#include "support/sites/unit.h"

namespace vorpipe::test {

using namespace core;

/// Defined by the tests of each device backend: opens it, or fails the test and returns null.
std::unique_ptr<Backend> openBackend(const Mask& mask = {}, int threads = 0);

/// Defined by the tests of each Vulkan backend: its name; and opens it with the validation layers.
std::string_view backendName();
Result<std::unique_ptr<Backend>> tryBackend();

/// Sites in the unit square, as a set with its grid, and packed as lists in which every site is a
/// candidate of every other. Entry k of the lists is site k of the set.
struct Scene {
  Sites sites;
  SiteSet set;
  std::vector<std::uint8_t> palette_index;
  CellBatch<double> batch;
  std::vector<DrawMark> marks;
};

inline SiteSet prepared(const Sites& sites) {
  auto made = prepare(sites, unit, 1);
  EXPECT_TRUE(made.has_value());
  return made ? std::move(made->set) : SiteSet{};
}

inline void packLists(Scene& scene) {
  const std::vector<double>& x = scene.set.x;
  const std::vector<double>& y = scene.set.y;
  const Box& domain = scene.set.domain;
  for (std::size_t i = 0; i < x.size(); i++) {
    std::vector<HalfPlane<double>> lines;
    for (std::size_t j = 0; j < x.size(); j++) {
      const double distance = std::hypot(x[j] - x[i], y[j] - y[i]);
      if (j != i)
        lines.push_back({(x[j] - x[i]) / distance, (y[j] - y[i]) / distance, distance / 2, distance});
    }
    std::ranges::sort(lines, {}, &HalfPlane<double>::bound);
    const auto first = static_cast<std::uint32_t>(scene.batch.lines.size());
    scene.batch.entries.push_back({first, static_cast<std::uint32_t>(lines.size()), domain.xmin - x[i],
                                   domain.ymin - y[i], domain.xmax - x[i], domain.ymax - y[i],
                                   std::numeric_limits<double>::infinity(), 0});
    scene.batch.lines.insert(scene.batch.lines.end(), lines.begin(), lines.end());
    scene.marks.push_back({static_cast<float>(2 * x[i] - 1), static_cast<float>(2 * y[i] - 1),
                           scene.set.id[i], scene.palette_index[i]});
  }
}

inline Scene makeScene(const Sites& sites) {
  Scene scene;
  scene.sites = sites;
  scene.set = prepared(sites);
  for (const std::uint32_t id : scene.set.id)
    scene.palette_index.push_back(static_cast<std::uint8_t>(id % 256));
  packLists(scene);
  return scene;
}

inline Scene makeScene(std::size_t count, std::uint64_t seed = 7) {
  return makeScene(generate(Pattern::random, count, seed));
}

/// The indices first .. last - 1.
inline std::vector<std::uint32_t> range(std::size_t first, std::size_t last) {
  std::vector<std::uint32_t> indices(last - first);
  std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(first));
  return indices;
}

/// The unit square in width * height pixels; color c of the palette is c in every channel.
inline View makeView(int width, int height) {
  View view{unit, width, height, {}};
  for (std::uint32_t palette_index = 0; palette_index < view.palette.size(); palette_index++)
    view.palette[palette_index] = palette_index * 0x01010101U;
  return view;
}

/// The picture as it is now, row 0 at the top.
inline Image read(Backend& backend, const View& view) {
  const auto width = static_cast<std::size_t>(view.width);
  const auto height = static_cast<std::size_t>(view.height);
  std::vector<std::uint32_t> rgba(width * height);
  std::vector<std::uint32_t> ids(width * height);
  const Result<void> done = backend.read(rgba, ids);
  EXPECT_TRUE(done.has_value()) << done.error().message;
  Image image{view.width, view.height, {}, {}};
  for (std::size_t row = height; row-- > 0;) {
    const auto begin = static_cast<std::ptrdiff_t>(row * width);
    const auto end = begin + static_cast<std::ptrdiff_t>(width);
    image.rgba.insert(image.rgba.end(), rgba.begin() + begin, rgba.begin() + end);
    image.ids.insert(image.ids.end(), ids.begin() + begin, ids.begin() + end);
  }
  return image;
}

/// Returns those of `drawn` that need more room; all others must be certified.
inline std::vector<std::uint32_t> overflown(const std::vector<std::uint32_t>& drawn, Capacity capacity,
                                            const std::vector<CellStatus>& status) {
  std::vector<std::uint32_t> again;
  for (std::size_t k = 0; k < status.size(); k++) {
    if (status[k] == CellStatus::overflow && capacity == Capacity::small) {
      again.push_back(drawn[k]);
    } else {
      EXPECT_EQ(status[k], CellStatus::certified) << "entry " << drawn[k];
    }
  }
  return again;
}

/// Draws some of the scene's lists. Returns those that need more room.
inline std::vector<std::uint32_t> drawLists(Backend& backend, const Scene& scene,
                                            const std::vector<std::uint32_t>& chosen, Capacity capacity) {
  CellBatch<float> batch = toFloat(scene.batch);
  std::vector<CellBatch<float>::Entry> entries;
  std::vector<DrawMark> marks;
  for (const std::uint32_t entry : chosen) {
    entries.push_back(batch.entries[entry]);
    marks.push_back(scene.marks[entry]);
  }
  batch.entries = std::move(entries);
  std::vector<CellStatus> status(chosen.size());
  const Result<void> done = backend.draw(batch, marks, capacity, status);
  EXPECT_TRUE(done.has_value()) << done.error().message;
  return overflown(chosen, capacity, status);
}

/// Draws some of the sites that were uploaded. Returns those that need more room.
inline std::vector<std::uint32_t> drawSites(Backend& backend, const std::vector<std::uint32_t>& chosen,
                                            Capacity capacity) {
  std::vector<CellStatus> status(chosen.size());
  const Result<void> done = backend.draw(chosen, capacity, status);
  EXPECT_TRUE(done.has_value()) << done.error().message;
  return overflown(chosen, capacity, status);
}

/// Checks that all pixels belong to a nearest site and have its color.
inline void expectPicture(const Image& image, const Scene& scene, const View& view) {
  expectNearestEverywhere(image, scene.sites, unit);
  for (std::size_t pixel = 0; pixel < image.ids.size(); pixel++) {
    ASSERT_EQ(image.rgba[pixel], view.palette[image.ids[pixel] % 256]);
  }
}

}  // namespace vorpipe::test
