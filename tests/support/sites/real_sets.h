/// Files of real sites, and of sites that were hard: those that stand here, and any others.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

struct RealSet {
  std::string name;  ///< unlike all others, of letters, digits and underscores
  std::string path;
  friend std::ostream& operator<<(std::ostream& out, const RealSet& set) { return out << set.path; }
};

/// Every .csv of tests/data and of the folder VORPIPE_TEST_DATA, and of all folders in them, in alphabetical
/// order; a file that both have is taken once. Throws std::runtime_error where one of the two has none.
const std::vector<RealSet>& realSets();

/// Sites of a set in a domain, as one of the questions that are asked about it.
struct RealCase {
  std::string what;
  Sites sites;
  Box domain;
};

/// The sites in the box around them. Weights as they stand, and so scaled that they differ by as much as the
/// mean cell's area, and a hundred and ten thousand times as much, because those of real sites seldom are in
/// squares of the coordinates' unit; and all equal. Of up to a thousand sites parts of the box as well: its
/// middle; and 0.25,0.25,0.5,0.75, which is hard for the slivers, where it is in the box.
std::vector<RealCase> casesOf(const Sites& sites);

}  // namespace vorpipe::test
