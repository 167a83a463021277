/// Inputs that are hard on arithmetic, each made anew from a seed and its number.
#pragma once

#include <cstdint>
#include <string>

#include "vorpipe.h"

namespace vorpipe::test {

struct HardInput {
  std::uint64_t seed = 0, number = 0;
  std::string kinds;  ///< what it was put together from, as in "twins+walls, lifted weights, unit domain"
  Sites sites;
  Box domain{};
  Outline outline;  ///< may be empty; else the domain is its box
  Periodic periodic = Periodic::none;
  SearchOptions search;
  int width = 0, height = 0;  ///< of its picture
};

/// The same seed and number give the same input, on any machine whose library has the same sines.
HardInput makeHardInput(std::uint64_t seed, std::uint64_t number);

/// One line: the seed and number that make it again, its kinds and sizes.
std::string describe(const HardInput& input);

CellsOptions cellsOptions(const HardInput& input);
RenderOptions pictureOptions(const HardInput& input);

}  // namespace vorpipe::test
