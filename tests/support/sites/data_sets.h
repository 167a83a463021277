/// Sites of known difficulty, made anew from a seed: what cells are tested on beside the generators of
/// the library itself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

struct DataSet {
  std::string name;
  Sites sites;
  Box domain;
};

/// A data set's name, and what is hard about it.
struct DataSetKind {
  std::string_view name, difficulty;
};
/// Those without weights.
const std::vector<DataSetKind>& dataSetKinds();
/// Those with weights.
const std::vector<DataSetKind>& weightedSetKinds();

/// Makes about n sites of a kind; some kinds have a size of their own. The same n and seed give the
/// same sites. Throws std::invalid_argument for a name that is in neither list.
DataSet makeDataSet(std::string_view name, std::uint64_t n, std::uint64_t seed);

/// The box of the sites, grown by 5 % of its longer side, or by 0.5 where all are equal: the domain of sites
/// from a file.
Box boxAround(const Sites& sites);

}  // namespace vorpipe::test
