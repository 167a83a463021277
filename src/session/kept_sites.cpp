#include <array>
#include <new>
#include <optional>
#include <utility>

#include "base/try.h"
#include "picture/picture.h"
#include "session/input_check.h"
#include "session/session_state.h"
#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

using namespace core;

namespace {

bool areSame(const Box& a, const Box& b) {
  return a.xmin == b.xmin && a.ymin == b.ymin && a.xmax == b.xmax && a.ymax == b.ymax;
}

bool areSame(const Outline& a, const Outline& b) {
  return a.points == b.points && a.ring_offsets == b.ring_offsets && a.polygon_offsets == b.polygon_offsets;
}

/// Whether two runs over the same sites find the same cells.
bool findTheSame(const CellsOptions& a, const CellsOptions& b) {
  return areSame(a.domain, b.domain) && a.periodic == b.periodic && a.search.method == b.search.method &&
         a.search.neighbors == b.search.neighbors && a.globe == b.globe && areSame(a.outline, b.outline);
}

bool areSame(const Density& a, const Density& b) {
  const bool same_place = a.box.has_value() == b.box.has_value() && (!a.box || areSame(*a.box, *b.box));
  return same_place && a.width == b.width && a.height == b.height && a.values == b.values;
}

/// The report of a run that returns nothing else.
struct Noted {
  Report report;
};

}  // namespace

struct KeptSites::State {
  /// The input of pictures, with the exact tier for the same sites.
  struct Kept {
    std::unique_ptr<ExactTier> exact;
    KeptPicture picture;
  };

  Session* session;
  Sites sites;
  /// The options of `kept`, once they passed all checks; their density is that of `with_mass`.
  std::optional<CellsOptions> options{};
  std::optional<bool> by_site_needs_cells{};
  /// Without cells and with them. The two are drawn in different ways, so a pixel may go to another of two
  /// equally near sites.
  std::array<std::optional<Kept>, 2> kept{};
  std::optional<Diagram> with_mass{};
  std::optional<Diagram> polygons{};  ///< source of the marks of pictures

  Result<void> take(const CellsOptions& wanted);
  Result<Marks> marks(const RenderOptions& wanted);
  Result<bool> needsCells(const RenderOptions& wanted, int threads);
  Result<Kept*> find(const Session::State& on, Backend& backend, const RenderOptions& wanted,
                     bool with_cells);
};

/// Discards data that other options need anew.
Result<void> KeptSites::State::take(const CellsOptions& wanted) {
  if (options && findTheSame(*options, wanted)) return {};
  options.reset();
  by_site_needs_cells.reset();
  kept = {};
  with_mass.reset();
  polygons.reset();
  VORPIPE_TRY(checkOptions(sites, wanted));
  options = wanted;
  options->density = {};
  options->progress = {};
  return {};
}

Result<Marks> KeptSites::State::marks(const RenderOptions& wanted) {
  if (!marksNeedCells(wanted)) return Marks{};
  if (!polygons) {
    CellsOptions cells = cellsOptions(wanted);
    cells.detail = Detail::polygons;
    VORPIPE_VAR(found, session->cells(sites, cells));
    polygons = std::move(found);
  }
  return marksOf(sites, *polygons, wanted, session->state_->threads);
}

Result<bool> KeptSites::State::needsCells(const RenderOptions& wanted, int threads) {
  if (colorsNeedCells(wanted.color)) return true;
  if (!by_site_needs_cells) {
    const auto needed = core::needsCells(sites, wanted, threads);
    if (!needed) return needed;
    by_site_needs_cells = *needed;
  }
  return *by_site_needs_cells;
}

Result<KeptSites::State::Kept*> KeptSites::State::find(const Session::State& on, Backend& backend,
                                                       const RenderOptions& wanted, bool with_cells) {
  auto& there = kept[with_cells ? 1 : 0];
  if (there) return &*there;
  auto exact = openExactTier(on.threads);
  VORPIPE_VAR(found, findPicture(on.with(backend, *exact), sites, wanted, with_cells));
  there = Kept{std::move(exact), std::move(found)};
  return &*there;
}

KeptSites::KeptSites(Session& session, Sites sites)
    : state_(std::make_unique<State>(State{&session, std::move(sites)})) {}
KeptSites::KeptSites(KeptSites&&) noexcept = default;
KeptSites& KeptSites::operator=(KeptSites&&) noexcept = default;
KeptSites::~KeptSites() = default;

const Sites& KeptSites::sites() const { return state_->sites; }

Result<Rendering> KeptSites::render(const RenderOptions& options) {
  try {
    Session::State& on = *state_->session->state_;
    VORPIPE_TRY(state_->take(cellsOptions(options)));
    VORPIPE_TRY(checkRender(options));
    if (options.globe) return state_->session->render(state_->sites, options);
    VORPIPE_LET(with_cells, state_->needsCells(options, on.threads));
    VORPIPE_LET(marks, state_->marks(options));
    return on.device.run<Rendering>([&](Backend& backend) -> Result<Rendering> {
      VORPIPE_LET(kept, state_->find(on, backend, options, with_cells));
      auto& [exact, picture] = *kept;
      return renderKept(on.with(backend, *exact), state_->sites, options, marks, picture);
    });
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<const Diagram*> KeptSites::measures(const CellsOptions& options) {
  try {
    State& s = *state_;
    VORPIPE_TRY(s.take(options));
    CellsOptions wanted = options;
    wanted.detail = Detail::measures;
    if (!options.density.values.empty() || options.globe) {
      if (s.with_mass && areSame(s.options->density, options.density)) return &*s.with_mass;
      s.with_mass.reset();
      VORPIPE_VAR(cells, s.session->cells(s.sites, wanted));
      s.options->density = options.density;
      s.with_mass = std::move(cells);
      return &*s.with_mass;
    }
    RenderOptions picture{};
    picture.domain = options.domain;
    picture.outline = options.outline;
    picture.periodic = options.periodic;
    picture.search = options.search;
    picture.progress = options.progress;
    Session::State& on = *s.session->state_;
    State::Kept* kept = nullptr;
    const auto noted = on.device.run<Noted>([&](Backend& backend) -> Result<Noted> {
      VORPIPE_LET(found, s.find(on, backend, picture, true));
      kept = found;
      return Noted{};
    });
    if (!noted) return tl::unexpected(noted.error());
    Report& report = kept->picture.found.diagram.report;
    report.notes.insert(report.notes.begin(), noted->report.notes.begin(), noted->report.notes.end());
    return &kept->picture.found.diagram;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

}  // namespace vorpipe
