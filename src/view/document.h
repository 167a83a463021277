/// The sites of a window, with the history of edits for undo and redo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "view/opened.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

class Document {
 public:
  explicit Document(Opened opened);

  [[nodiscard]] const FixedSites& sites() const { return now_.sites; }
  /// What was opened last and not undone; its domain, outline and period are those of the sites.
  [[nodiscard]] const Opened& opened() const { return *now_.opened; }
  /// Whether the sites are those that were opened: unedited, or edited and restored by undo.
  [[nodiscard]] bool isAsOpened() const { return now_.revision == now_.opened_revision; }
  /// The present state of the fluid that the sites belong to; null: no fluid.
  [[nodiscard]] const FixedFluid& fluid() const { return now_.fluid; }
  /// Equal revisions have equal sites.
  [[nodiscard]] std::uint64_t revision() const { return now_.revision; }
  [[nodiscard]] Point place(std::uint32_t site) const { return {now_.sites->x[site], now_.sites->y[site]}; }
  [[nodiscard]] double weight(std::uint32_t site) const;
  /// Returns a place mapped into the domain along each periodic axis.
  [[nodiscard]] Point inDomain(Point place) const;
  [[nodiscard]] bool isInDomain(Point place) const;

  /// Continues a fluid; undo() does not revert that. Does nothing and returns false if `from` is no longer
  /// the document's fluid.
  bool flow(const FixedFluid& from, FixedFluid to);

  // The following can be undone. Except for open(), none of it applies to fluids.

  /// Adds a site, with weight 0 if sites have weights, and returns its index: the last one.
  std::uint32_t add(Point place);
  void remove(std::uint32_t site);
  /// Consecutive moves of one site form one edit until settle().
  void move(std::uint32_t site, Point to);
  /// Likewise. If sites have no weights, all get weight 0 first.
  void addWeight(std::uint32_t site, double by);
  /// Records that relaxation moved the sites `from` to `to`; one edit until settle(). Does nothing and
  /// returns false if `from` are no longer the document's sites.
  bool relax(const FixedSites& from, FixedSites to);
  void open(Opened opened);

  /// Ends the current edit: later changes start a new one.
  void settle() { growing_ = Growing::nothing; }

  [[nodiscard]] bool canUndo() const { return done_ > 0; }
  [[nodiscard]] bool canRedo() const { return done_ < edits_.size(); }
  void undo();
  void redo();

 private:
  struct Site {
    double x = 0, y = 0;
    std::optional<double> weight{};
  };
  struct State {
    std::shared_ptr<const Opened> opened;
    FixedSites sites;
    FixedFluid fluid{};
    std::uint64_t revision = 0;         ///< equal revisions are equal states
    std::uint64_t opened_revision = 0;  ///< that of `opened`
  };
  /// A change of one site; without `before` it is added, without `after` removed.
  struct SiteChange {
    std::uint32_t site = 0;
    std::optional<Site> before{}, after{};
    std::uint64_t revision_before = 0, revision_after = 0;
  };
  struct StateChange {
    State before, after;
  };
  using Edit = std::variant<SiteChange, StateChange>;
  enum class Growing : std::uint8_t { nothing, move, weight, relaxation };

  [[nodiscard]] Site siteOf(std::uint32_t site) const;
  void apply(std::uint32_t site, const std::optional<Site>& before, const std::optional<Site>& after);
  void change(std::uint32_t site, const std::optional<Site>& after, Growing growing);
  void record(Edit edit);
  /// Whether the last edit absorbs another one of this kind.
  bool takesUp(Growing growing, std::uint32_t site);

  State now_;
  std::uint64_t revisions_ = 0;
  std::vector<Edit> edits_;
  std::size_t done_ = 0;  ///< number of edits in effect; those after it can be redone
  Growing growing_ = Growing::nothing;
  std::uint32_t growing_site_ = 0;
};

}  // namespace vorpipe::view
