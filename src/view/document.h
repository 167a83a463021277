/// The sites of a window, and what was done to them, which can be undone.
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
  /// What was opened last, but for undone: domain, outline and period are those of the sites.
  [[nodiscard]] const Opened& opened() const { return *now_.opened; }
  /// Whether the sites are still, or again, those that were opened.
  [[nodiscard]] bool isAsOpened() const { return now_.revision == now_.opened_revision; }
  /// The fluid that the sites are of, as it is now; null: they are no fluid's.
  [[nodiscard]] const FixedFluid& fluid() const { return now_.fluid; }
  /// Equal numbers are equal sites.
  [[nodiscard]] std::uint64_t revision() const { return now_.revision; }
  [[nodiscard]] Point place(std::uint32_t site) const { return {now_.sites->x[site], now_.sites->y[site]}; }
  [[nodiscard]] double weight(std::uint32_t site) const;
  /// A place as the domain has it: where an axis repeats itself, inside.
  [[nodiscard]] Point inDomain(Point place) const;
  [[nodiscard]] bool isInDomain(Point place) const;

  /// Continues a fluid; undo() does not take that back. False where `from` is not that of the document any
  /// more: nothing happens.
  bool flow(const FixedFluid& from, FixedFluid to);

  // What follows can be undone, and but for open() is not for fluids.

  /// Adds a site, of weight 0 among others with weights, and returns its index: the last one.
  std::uint32_t add(Point place);
  void remove(std::uint32_t site);
  /// Moves of one site are one edit up to settle().
  void move(std::uint32_t site, Point to);
  /// Likewise. Sites that have no weights get them, of 0.
  void addWeight(std::uint32_t site, double by);
  /// Sites moved by themselves, `from` to `to`, in one edit up to settle(). False where they are not those of
  /// the document any more: nothing happens.
  bool relax(const FixedSites& from, FixedSites to);
  void open(Opened opened);

  /// Ends an edit that would take up what comes next.
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
    std::uint64_t revision = 0;         ///< equal ones are equal states
    std::uint64_t opened_revision = 0;  ///< that of `opened`
  };
  /// Of one site, which was not there before, or is not any more.
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
  /// Whether the last edit takes up another one of this kind.
  bool takesUp(Growing growing, std::uint32_t site);

  State now_;
  std::uint64_t revisions_ = 0;
  std::vector<Edit> edits_;
  std::size_t done_ = 0;  ///< of the edits; those after can be done again
  Growing growing_ = Growing::nothing;
  std::uint32_t growing_site_ = 0;
};

}  // namespace vorpipe::view
