#include "space/exact_cell.h"
#include <cmath>
#include <map>
#include "space/predicates.h"
namespace vorpipe::space {
ExactCell::ExactCell(const Places& places, Label site) : places_(places), site_(site) {
  for (int c = 0; c < 8; ++c) {
    Label a = labelOfWall(c & 1), b = labelOfWall(2 + (c >> 1 & 1)), d = labelOfWall(4 + (c >> 2));
    if (orientation(places_, site_, a, b, d) < 0) std::swap(a, b);
    vertices_.push_back({a, b, d});
  }
}
bool ExactCell::cut(Label by) {
  std::vector<std::array<Label, 3>> kept, gone;
  std::map<std::pair<Label, Label>, bool> in;
  for (auto& v : vertices_) {
    bool c = cuts(places_, site_, v[0], v[1], v[2], by);
    (c ? gone : kept).push_back(v);
    for (int e = 0; e < 3; e++) in[{v[e], v[(e + 1) % 3]}] = c;
  }
  if (gone.empty()) return false;
  for (auto& v : gone)
    for (int e = 0; e < 3; e++) {
      Label a = v[e], b = v[(e + 1) % 3];
      if (!in[{b, a}]) kept.push_back({a, b, by});
    }
  vertices_ = kept;
  return true;
}
bool ExactCell::empty() const { return vertices_.empty(); }
static void row(const Places& P, Label i, Label j, long double* d, long double& h) {
  const Point3& a = P.sites[i];
  if (j >= 0) {
    const Point3& b = P.sites[j];
    d[0] = (long double)b.x - a.x;
    d[1] = (long double)b.y - a.y;
    d[2] = (long double)b.z - a.z;
    h = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 2;
  } else {
    int w = -1 - j;
    d[0] = d[1] = d[2] = 0;
    d[w / 2] = w & 1 ? 1 : -1;
    h = d[w / 2] * (P.offset(w) - (w / 2 == 0 ? a.x : w / 2 == 1 ? a.y : a.z));
  }
}
double ExactCell::squaredRadius() const {
  double m = 0;
  for (auto& v : vertices_) {
    long double n[3][3], h[3];
    for (int e = 0; e < 3; e++) row(places_, site_, v[e], n[e], h[e]);
    auto X = [&](int a, int b, int k) {
      int p = (k + 1) % 3, q = (k + 2) % 3;
      return n[a][p] * n[b][q] - n[a][q] * n[b][p];
    };
    long double D = 0;
    for (int k = 0; k < 3; k++) D += n[0][k] * X(1, 2, k);
    long double r = 0;
    for (int k = 0; k < 3; k++) {
      long double p = (h[0] * X(1, 2, k) + h[1] * X(2, 0, k) + h[2] * X(0, 1, k)) / D;
      r += p * p;
    }
    if (!(r < 12)) r = 12;
    m = std::max(m, (double)r);
  }
  return m * 1.0001;
}
std::span<const std::array<Label, 3>> ExactCell::vertices() const { return vertices_; }
}  // namespace vorpipe::space
