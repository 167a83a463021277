/// Inputs that a deterministic loop makes of seeds: the same ones in every run, as many as time is for.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace vorpipe::fuzz {

class Mutation {
 public:
  /// Of at least one seed; inputs are no longer than `longest`.
  Mutation(std::vector<std::string> seeds, std::size_t longest);

  std::string next();

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }
  void change(std::string& bytes);

  std::vector<std::string> seeds_;
  std::size_t longest_;
  std::mt19937_64 random_{1};
};

}  // namespace vorpipe::fuzz
