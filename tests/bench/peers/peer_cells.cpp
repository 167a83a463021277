#include "bench/peers/peer_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/vertex_position.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr std::size_t usual_neighbors = 6;
constexpr double area_slack = 1e-10;  // of the domain, for the sum of all

double squareOfDistance(const Sites& sites, std::size_t a, std::size_t b) {
  const double dx = sites.x[b] - sites.x[a], dy = sites.y[b] - sites.y[a];
  return dx * dx + dy * dy;
}

}  // namespace

PeerCells::PeerCells(const BenchInput& input)
    : input_(&input),
      area_(input.sites.size()),
      centroid_(input.sites.size()),
      first_(input.sites.size()),
      count_(input.sites.size()) {
  const double width = input.domain.xmax, height = input.domain.ymax;
  tie_square_ = shortest_edge * shortest_edge * (width * width + height * height);
  neighbors_.reserve((usual_neighbors + 1) * input.sites.size());
}

void PeerCells::begin(std::uint32_t site, double area, Point centroid) {
  area_[site] = area;
  centroid_[site] = centroid;
  first_[site] = static_cast<std::uint32_t>(neighbors_.size());
  count_[site] = 0;
}

void PeerCells::addNeighbor(std::uint32_t site, std::int32_t neighbor, double square) {
  // Ties are few, and the distance of the sites is not needed to tell that most edges are none.
  if (square <= tie_square_ && neighbor >= 0) {
    const double distance = squareOfDistance(input_->sites, site, static_cast<std::size_t>(neighbor));
    if (square <= shortest_edge * shortest_edge * distance) return;
  }
  neighbors_.push_back(neighbor);
  ++count_[site];
}

void PeerCells::add(std::uint32_t site, std::span<const Point> vertices,
                    std::span<const std::int32_t> neighbors) {
  begin(site, 0, {});
  const Point p{input_->sites.x[site], input_->sites.y[site]};
  double twice = 0, x = 0, y = 0;
  Point b{vertices[0].x - p.x, vertices[0].y - p.y};
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Point a = b;
    const Point& end = vertices[k + 1 < vertices.size() ? k + 1 : 0];
    b = {end.x - p.x, end.y - p.y};
    const double cross = a.x * b.y - a.y * b.x;
    twice += cross;
    x += cross * (a.x + b.x);
    y += cross * (a.y + b.y);
    addNeighbor(site, neighbors[k], (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  area_[site] = 0.5 * std::abs(twice);
  centroid_[site] = {p.x + x / (3 * twice), p.y + y / (3 * twice)};
}

void PeerCells::addCut(std::uint32_t site, std::span<const std::int32_t> neighbors) {
  const auto& [xmin, ymin, xmax, ymax] = input_->domain;
  room_.vertices = {{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}};
  room_.neighbors = {wall_ymin, wall_xmax, wall_ymax, wall_xmin};
  const Point p{input_->sites.x[site], input_->sites.y[site]};
  const double weight = input_->sites.weight.empty() ? 0 : input_->sites.weight[site];
  for (const auto neighbor : neighbors) cutBy(p, weight, neighbor);
  if (!room_.vertices.empty()) add(site, room_.vertices, room_.neighbors);
}

/// Keeps the side of the site, of one weight, of the bisector with another.
void PeerCells::cutBy(Point site, double weight, std::int32_t neighbor) {
  const auto other = static_cast<std::size_t>(neighbor);
  const Point way{input_->sites.x[other] - site.x, input_->sites.y[other] - site.y};
  const double lighter = input_->sites.weight.empty() ? 0 : weight - input_->sites.weight[other];
  const double reach = 0.5 * (way.x * way.x + way.y * way.y + lighter);
  const auto beyond = [&](Point v) { return way.x * (v.x - site.x) + way.y * (v.y - site.y) - reach; };
  std::swap(room_.vertices, room_.vertices_before);
  std::swap(room_.neighbors, room_.neighbors_before);
  room_.vertices.clear();
  room_.neighbors.clear();
  const auto& before = room_.vertices_before;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Point a = before[k], b = before[k + 1 < before.size() ? k + 1 : 0];
    const double from = beyond(a), to = beyond(b);
    const auto crossing = [&] {
      const double part = from / (from - to);
      return Point{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
    };
    if (from <= 0) {
      room_.vertices.push_back(a);
      room_.neighbors.push_back(room_.neighbors_before[k]);
      if (to <= 0) continue;
      room_.vertices.push_back(crossing());
      room_.neighbors.push_back(neighbor);
    } else if (to <= 0) {
      room_.vertices.push_back(crossing());
      room_.neighbors.push_back(room_.neighbors_before[k]);
    }
  }
}

std::string PeerCells::areaDisagreement() const {
  const double domain = input_->domain.xmax * input_->domain.ymax;
  const double off = std::accumulate(area_.begin(), area_.end(), -domain);
  if (std::abs(off) <= area_slack * domain) return {};
  return fmt::format("areas add up to the domain's and {} of it", off / domain);
}

std::string PeerCells::disagreement(const Diagram& reference) const {
  if (auto differs = areaDisagreement(); !differs.empty()) return differs;
  Diagram diagram;
  diagram.status = reference.status;
  diagram.owner = reference.owner;
  diagram.cell_offsets.push_back(0);
  for (std::size_t i = 0; i < area_.size(); ++i) {
    if (count_[i] > 0) {
      diagram.status[i] = Status::ok;
    } else if (diagram.status[i] == Status::ok) {
      diagram.status[i] = Status::empty;
    }
    diagram.area.push_back(area_[i] * input_->unit * input_->unit);
    const auto row = std::span(neighbors_).subspan(first_[i], count_[i]);
    diagram.neighbors.insert(diagram.neighbors.end(), row.begin(), row.end());
    diagram.cell_offsets.push_back(diagram.neighbors.size());
  }
  const auto diff = diffCells(reference, diagram);
  if (!diff) return diff.error().message;
  if (diff->agree()) return {};
  return fmt::format(
      "of {} cells, {} have another status, {} other neighbors, {} another area; the first is {}",
      area_.size(), diff->statuses, diff->neighbors, diff->areas, diff->first.front().site);
}

}  // namespace vorpipe::test
