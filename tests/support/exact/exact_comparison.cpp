#include "support/exact/exact_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace vorpipe::test {
namespace {

constexpr std::size_t most_faults_told = 10;
constexpr double most_ties = 8;

class ExactJudge {
 public:
  ExactJudge(const Diagram& diagram, const Sites& sites, const Box& domain, const ExactCells& exact,
             const Promise& promise)
      : diagram_(diagram), sites_(sites), exact_(exact), promise_(promise) {
    const double width = domain.xmax - domain.xmin;
    const double height = domain.ymax - domain.ymin;
    side_ = std::max(width, height);
    shorter_side_ = std::min(width, height);
    mean_area_ = width / static_cast<double>(sites.size()) * height;
  }

  Comparison run() {
    if (!areArraysWhole()) return std::move(result_);
    findTied();
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      compareOwner(i);
      compareArea(i);
      compareNeighbors(i);
    }
    compareCounts();
    compareSymmetry();
    return std::move(result_);
  }

 private:
  template <class... Args>
  void fault(std::uint64_t& count, fmt::format_string<Args...> format, Args&&... args) {
    ++count;
    if (result_.first.size() < most_faults_told)
      result_.first.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  bool areArraysWhole() {
    const auto n = sites_.size();
    const auto& offsets = diagram_.cell_offsets;
    const bool whole = diagram_.status.size() == n && diagram_.owner.size() == n &&
                       diagram_.area.size() == n && offsets.size() == n + 1 && offsets.front() == 0 &&
                       std::is_sorted(offsets.begin(), offsets.end()) &&
                       offsets.back() == diagram_.neighbors.size() &&
                       (diagram_.edge_lengths.empty() || diagram_.edge_lengths.size() == offsets.back());
    if (!whole) fault(result_.cells, "arrays are not as long as the sites and offsets say");
    return whole;
  }

  [[nodiscard]] std::span<const std::int64_t> reported(std::size_t i) const {
    return std::span(diagram_.neighbors)
        .subspan(diagram_.cell_offsets[i], diagram_.cell_offsets[i + 1] - diagram_.cell_offsets[i]);
  }

  [[nodiscard]] std::span<const ExactEdge> edges(std::size_t i) const {
    return std::span(exact_.edges).subspan(exact_.offsets[i], exact_.offsets[i + 1] - exact_.offsets[i]);
  }

  [[nodiscard]] double allowedArea(std::size_t i) const {
    return promise_.area * exact_.area[i] + promise_.mean_area * mean_area_;
  }

  void compareOwner(std::size_t i) {
    if (diagram_.owner[i] != exact_.owner[i])
      fault(result_.cells, "site {} is owned by {}, not by {}", i, exact_.owner[i], diagram_.owner[i]);
    const bool duplicate = exact_.owner[i] != i;
    const auto status = diagram_.status[i];
    const bool right = duplicate                 ? status == Status::duplicate
                       : edges(i).empty()        ? status == Status::empty
                       : status == Status::empty ? exact_.area[i] <= allowedArea(i)
                                                 : status == Status::ok;
    if (!right)
      fault(result_.cells, "site {} has status {}, its cell has area {} and {} edges", i,
            static_cast<int>(status), exact_.area[i], edges(i).size());
    if (status != Status::ok && !reported(i).empty())
      fault(result_.cells, "site {} has status {} and {} neighbors", i, static_cast<int>(status),
            reported(i).size());
  }

  void compareArea(std::size_t i) {
    const double expected = exact_.area[i];
    const double area = diagram_.area[i];
    if (area == expected) return;
    // Beyond the range of doubles only its end can be expected.
    const bool in_range = std::isnormal(mean_area_) && std::isfinite(expected);
    const double off = std::abs(area - expected) / allowedArea(i);
    if (in_range && off <= 1) {
      result_.worst_area = std::max(result_.worst_area, off);
    } else if (in_range || !(area >= 0)) {
      result_.worst_area = std::max(result_.worst_area, off);
      fault(result_.areas, "site {} has area {}, not {}: {} of what is allowed", i, expected, area, off);
    }
  }

  /// Whether an edge must be reported, may be, or must not.
  enum class Verdict { no, either, yes };

  [[nodiscard]] Verdict verdict(const ExactEdge& edge, double farthest) const {
    if (edge.neighbor < 0) {
      const double slack = 2 * promise_.shortest * farthest + 1e-12 * side_;
      return edge.part > promise_.shortest * (1 + promise_.gap) && edge.length > slack ? Verdict::yes
                                                                                       : Verdict::either;
    }
    // Where sites have weights, ties may join both ends of an edge.
    const double joined =
        sites_.weight.empty() ? 0 : most_ties * promise_.shortest * std::min(farthest, shorter_side_);
    const double part = std::max(edge.part, edge.length / shorter_side_);
    if (part < promise_.shortest * (1 - promise_.gap)) return Verdict::no;
    return part > promise_.shortest * (1 + promise_.gap) && edge.length > joined ? Verdict::yes
                                                                                 : Verdict::either;
  }

  /// The distance of the farthest site that shares an edge with cell i.
  [[nodiscard]] double farthestOf(std::size_t i) const {
    double farthest = 0;
    for (const auto& edge : edges(i)) {
      if (edge.neighbor >= 0 && edge.part > 0) farthest = std::max(farthest, edge.length / edge.part);
    }
    return farthest;
  }

  /// Only a tie that ends at a vertex of a cell moves it: an edge of the cell's, or of a neighbor's.
  void findTied() {
    std::vector<bool> has(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const double farthest = farthestOf(i);
      has[i] = std::ranges::any_of(
          edges(i), [&](const ExactEdge& edge) { return verdict(edge, farthest) != Verdict::yes; });
    }
    tied_ = has;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      for (const auto& edge : edges(i)) {
        if (edge.neighbor >= 0 && has[static_cast<std::size_t>(edge.neighbor)]) tied_[i] = true;
      }
    }
  }

  /// By how much the length of an edge of cell i may be off. Sites that tie may be farther apart than an
  /// edge is long, and several ties may stand in a row.
  [[nodiscard]] double allowedLength(std::size_t i, double length, double farthest) const {
    const double rounding = 1e-9 * length + 1e-14 * side_;
    return tied_[i] ? rounding + most_ties * promise_.shortest * farthest : rounding;
  }

  void compareNeighbors(std::size_t i) {
    std::map<std::int64_t, double> lengths;
    for (std::size_t k = 0; k < reported(i).size(); ++k) {
      const auto e = diagram_.cell_offsets[i] + k;
      const double length = diagram_.edge_lengths.empty() ? std::nan("") : diagram_.edge_lengths[e];
      if (!lengths.emplace(reported(i)[k], length).second)
        fault(result_.invented, "site {} has its neighbor {} twice", i, reported(i)[k]);
    }
    const double farthest = farthestOf(i);
    for (const auto& edge : edges(i)) {
      const auto found = lengths.extract(edge.neighbor);
      const auto wanted = verdict(edge, farthest);
      if (wanted == Verdict::yes && !found)
        fault(result_.missing, "site {} lacks its neighbor {}: edge {}, {} of their distance", i,
              edge.neighbor, edge.length, edge.part);
      if (wanted == Verdict::no && found)
        fault(result_.invented, "site {} has the neighbor {}: edge {}, {} of their distance", i,
              edge.neighbor, edge.length, edge.part);
      if (found && std::abs(found.mapped() - edge.length) > allowedLength(i, edge.length, farthest))
        fault(result_.lengths, "site {} has an edge of {}, not {}, to {}", i, found.mapped(), edge.length,
              edge.neighbor);
    }
    for (const auto& [neighbor, length] : lengths)
      fault(result_.invented, "site {} has the neighbor {}, and they share no edge", i, neighbor);
  }

  void compareCounts() {
    std::array<std::uint64_t, 3> counts{};
    for (const auto status : diagram_.status) ++counts[static_cast<std::size_t>(status)];
    const auto& report = diagram_.report;
    if (counts != std::array{report.ok, report.empty, report.duplicate})
      fault(result_.cells, "{} ok, {} empty, {} duplicate are reported as {}, {}, {}", counts[0], counts[1],
            counts[2], report.ok, report.empty, report.duplicate);
  }

  void compareSymmetry() {
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      for (const auto neighbor : reported(i)) {
        if (neighbor >= 0) pairs.emplace_back(static_cast<std::int64_t>(i), neighbor);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [i, neighbor] : pairs) {
      if (!std::binary_search(pairs.begin(), pairs.end(), std::pair(neighbor, i)))
        fault(result_.one_sided, "site {} has the neighbor {}, but not the other way", i, neighbor);
    }
  }

  const Diagram& diagram_;
  const Sites& sites_;
  const ExactCells& exact_;
  const Promise& promise_;
  double side_ = 0, shorter_side_ = 0;
  double mean_area_ = 0;
  std::vector<bool> tied_;  ///< whether ties may have moved a cell's vertices
  Comparison result_;
};

}  // namespace

std::string Comparison::summary() const {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(cells, "wrong cells");
  add(areas, "wrong areas");
  add(missing, "missing neighbors");
  add(invented, "invented neighbors");
  add(one_sided, "one-sided neighbors");
  add(lengths, "wrong lengths");
  return text.empty() ? "agrees" : text;
}

Comparison compareWithExact(const Diagram& diagram, const Sites& sites, const Box& domain,
                            const ExactCells& exact, const Promise& promise) {
  return ExactJudge(diagram, sites, domain, exact, promise).run();
}

}  // namespace vorpipe::test
