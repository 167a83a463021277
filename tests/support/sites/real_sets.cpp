#include "support/sites/real_sets.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The .csv files of a folder, relative to it.
std::vector<fs::path> tables(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv") found.push_back(entry.path().lexically_relative(folder));
  if (found.empty()) throw std::runtime_error(folder.string() + ": has no .csv file of sites");
  std::ranges::sort(found);
  return found;
}

/// What a test may be called after a file.
std::string nameOf(fs::path file) {
  std::string name = file.replace_extension().generic_string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

std::vector<RealSet> findSets() {
  const fs::path here = VORPIPE_DATA;
  const char* const other = std::getenv("VORPIPE_TEST_DATA");
  std::vector<fs::path> folders{here};
  if (other != nullptr && *other != 0) folders.emplace_back(other);
  std::vector<RealSet> sets;
  std::set<std::string> used;
  for (const auto& folder : folders) {
    for (const auto& file : tables(folder)) {
      if (folder != here && fs::exists(here / file) && contents(here / file) == contents(folder / file))
        continue;
      auto name = nameOf(file);
      while (!used.insert(name).second) name += "_too";
      sets.push_back({name, (folder / file).string()});
    }
  }
  return sets;
}

Sites withWeights(Sites sites, double factor) {
  for (double& weight : sites.weight) weight *= factor;
  return sites;
}

}  // namespace

const std::vector<RealSet>& realSets() {
  static const std::vector<RealSet> sets = findSets();
  return sets;
}

std::vector<RealCase> casesOf(const Sites& sites) {
  const Box box = boxAround(sites);
  const double width = box.xmax - box.xmin;
  const double height = box.ymax - box.ymin;
  std::vector<RealCase> cases{{"as it is", sites, box}};
  if (!sites.weight.empty()) {
    const auto [least, most] = std::ranges::minmax(sites.weight);
    const double mean_cell = width * height / static_cast<double>(sites.size());
    for (const double range : {0.0, 1.0, 100.0, 10000.0}) {
      const double factor = most > least ? range * mean_cell / (most - least) : 0;
      cases.push_back(
          {"weights of " + std::to_string(range) + " mean cells", withWeights(sites, factor), box});
    }
  }
  if (sites.size() > 1000) return cases;
  const std::size_t whole = cases.size();
  const Box middle{box.xmin + width / 4, box.ymin + height / 4, box.xmax - width / 4, box.ymax - height / 4};
  const Box narrow{0.25, 0.25, 0.5, 0.75};
  for (std::size_t i = 0; i < whole; ++i) {
    cases.push_back({cases[i].what + ", the middle", cases[i].sites, middle});
    if (box.xmin < narrow.xmin && box.ymin < narrow.ymin && box.xmax > narrow.xmax && box.ymax > narrow.ymax)
      cases.push_back({cases[i].what + ", 0.25,0.25,0.5,0.75", cases[i].sites, narrow});
  }
  return cases;
}

}  // namespace vorpipe::test
