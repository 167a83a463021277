#include "view/document.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorpipe::view {
namespace {

FixedSites sitesOf(const std::shared_ptr<const Opened>& opened) {
  return opened->fluid ? opened->fluid->sites : FixedSites(opened, &opened->sites);
}

/// Returns `value` moved by whole periods into [low, high).
double wrappedInto(double value, double low, double high) {
  const double period = high - low;
  const double inside = value - std::floor((value - low) / period) * period;
  return inside < high && inside >= low ? inside : low;
}

}  // namespace

Opened openedFluid(FixedFluid fluid, std::string name) {
  Opened opened;
  opened.sites = *fluid->sites;
  opened.domain = fluid->setup.options.domain;
  opened.outline = fluid->setup.options.outline;
  opened.periodic = fluid->setup.options.periodic;
  opened.fluid = std::move(fluid);
  opened.fluid_name = std::move(name);
  return opened;
}

Document::Document(Opened opened) {
  now_.opened = std::make_shared<const Opened>(std::move(opened));
  now_.sites = sitesOf(now_.opened);
  now_.fluid = now_.opened->fluid;
}

double Document::weight(std::uint32_t site) const {
  return now_.sites->weight.empty() ? 0 : now_.sites->weight[site];
}

Point Document::inDomain(Point point) const {
  const auto& [xmin, ymin, xmax, ymax] = now_.opened->domain;
  const Point period = periodsOf(now_.opened->domain, now_.opened->periodic);
  if (period.x > 0) point.x = wrappedInto(point.x, xmin, xmax);
  if (period.y > 0) point.y = wrappedInto(point.y, ymin, ymax);
  return point;
}

bool Document::isInDomain(Point point) const {
  const Box& box = now_.opened->domain;
  return point.x >= box.xmin && point.x <= box.xmax && point.y >= box.ymin && point.y <= box.ymax;
}

Document::Site Document::siteOf(std::uint32_t site) const {
  const Sites& sites = *now_.sites;
  Site found{sites.x[site], sites.y[site]};
  if (!sites.weight.empty()) found.weight = sites.weight[site];
  return found;
}

void Document::apply(std::uint32_t site, const std::optional<Site>& before,
                     const std::optional<Site>& after) {
  auto sites = std::make_shared<Sites>(*now_.sites);
  const auto at = static_cast<std::ptrdiff_t>(site);
  const bool weighted = !sites->weight.empty() || (sites->x.empty() && after && after->weight);
  if (before && !after) {
    sites->x.erase(sites->x.begin() + at);
    sites->y.erase(sites->y.begin() + at);
    if (weighted) sites->weight.erase(sites->weight.begin() + at);
  } else if (!before && after) {
    sites->x.insert(sites->x.begin() + at, after->x);
    sites->y.insert(sites->y.begin() + at, after->y);
    if (weighted) sites->weight.insert(sites->weight.begin() + at, after->weight.value_or(0));
  } else if (after) {
    sites->x[site] = after->x;
    sites->y[site] = after->y;
    if (weighted) sites->weight[site] = after->weight.value_or(0);
  }
  now_.sites = std::move(sites);
}

bool Document::extendsLastEdit(EditKind kind, std::uint32_t site) {
  const bool same = kind != EditKind::nothing && last_kind_ == kind && last_site_ == site && done_ > 0 &&
                    done_ == edits_.size();
  last_kind_ = kind;
  last_site_ = site;
  return same;
}

void Document::record(Edit edit) {
  edits_.resize(done_);
  edits_.push_back(std::move(edit));
  ++done_;
}

void Document::change(std::uint32_t site, const std::optional<Site>& after, EditKind kind) {
  const bool is_new = site == now_.sites->size();
  const std::optional<Site> before = is_new ? std::nullopt : std::optional(siteOf(site));
  const std::uint64_t revision_before = now_.revision;
  apply(site, before, after);
  now_.revision = ++revisions_;
  if (!extendsLastEdit(kind, site))
    return record(SiteChange{site, before, after, revision_before, now_.revision});
  if (auto* const whole = std::get_if<StateChange>(&edits_.back())) {
    whole->after = now_;
  } else {
    auto& last = std::get<SiteChange>(edits_.back());
    last.after = after;
    last.revision_after = now_.revision;
  }
}

bool Document::flow(const FixedFluid& from, FixedFluid to) {
  if (now_.fluid != from) return false;
  now_.sites = to->sites;
  now_.fluid = std::move(to);
  now_.revision = ++revisions_;
  return true;
}

std::uint32_t Document::add(Point point) {
  const auto site = static_cast<std::uint32_t>(now_.sites->size());
  change(site, Site{point.x, point.y}, EditKind::nothing);
  return site;
}

void Document::remove(std::uint32_t site) { change(site, std::nullopt, EditKind::nothing); }

void Document::move(std::uint32_t site, Point to) {
  Site moved = siteOf(site);
  moved.x = to.x;
  moved.y = to.y;
  change(site, moved, EditKind::move);
}

void Document::addWeight(std::uint32_t site, double by) {
  if (now_.sites->weight.empty()) {
    // Undo must remove the weights again.
    const State before = now_;
    auto sites = std::make_shared<Sites>(*now_.sites);
    sites->weight.assign(sites->size(), 0);
    sites->weight[site] = by;
    now_.sites = std::move(sites);
    now_.revision = ++revisions_;
    extendsLastEdit(EditKind::weight, site);
    return record(StateChange{before, now_});
  }
  Site heavier = siteOf(site);
  heavier.weight = heavier.weight.value_or(0) + by;
  change(site, heavier, EditKind::weight);
}

bool Document::relax(const FixedSites& from, FixedSites to) {
  if (from != now_.sites) return false;
  const State before = now_;
  now_.sites = std::move(to);
  now_.revision = ++revisions_;
  if (extendsLastEdit(EditKind::relaxation, 0)) {
    std::get<StateChange>(edits_.back()).after = now_;
  } else {
    record(StateChange{before, now_});
  }
  return true;
}

void Document::open(Opened opened) {
  const State before = now_;
  now_.opened = std::make_shared<const Opened>(std::move(opened));
  now_.sites = sitesOf(now_.opened);
  now_.fluid = now_.opened->fluid;
  now_.revision = now_.opened_revision = ++revisions_;
  settle();
  record(StateChange{before, now_});
}

void Document::undo() {
  if (canUndo()) repeat(edits_[--done_], /*forward=*/false);
}

void Document::redo() {
  if (canRedo()) repeat(edits_[done_++], /*forward=*/true);
}

void Document::repeat(const Edit& edit, bool forward) {
  settle();
  if (const auto* const whole = std::get_if<StateChange>(&edit)) {
    now_ = forward ? whole->after : whole->before;
    return;
  }
  const auto& one = std::get<SiteChange>(edit);
  apply(one.site, forward ? one.before : one.after, forward ? one.after : one.before);
  now_.revision = forward ? one.revision_after : one.revision_before;
}

}  // namespace vorpipe::view
