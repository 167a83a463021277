/// The sites or the fluid of a window: as opened, and as edited.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "view/flowing.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

/// Sites as they were opened, with their domain.
struct Opened {
  Sites sites{};
  Box domain{0, 0, 1, 1};
  Outline outline{};
  Periodic periodic = Periodic::none;
  /// The command-line options that name these sites and their domain; empty if nothing names them.
  std::vector<std::string> arguments{};
  FixedFluid fluid{};        ///< the initial state of the fluid that has these sites; null: no fluid
  std::string fluid_name{};  ///< name of a case or file
};

/// A fluid in its domain.
Opened openedFluid(FixedFluid fluid, std::string name);

/// The sites of a window, with the history of edits for undo and redo.
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
  [[nodiscard]] Point position(std::uint32_t site) const {
    return {now_.sites->x[site], now_.sites->y[site]};
  }
  [[nodiscard]] double weight(std::uint32_t site) const;
  /// Returns a point mapped into the domain along each periodic axis.
  [[nodiscard]] Point inDomain(Point point) const;
  [[nodiscard]] bool isInDomain(Point point) const;

  /// Continues a fluid; undo() does not revert that. Does nothing and returns false if `from` is no longer
  /// the document's fluid.
  bool flow(const FixedFluid& from, FixedFluid to);

  // The following can be undone. Except for open(), none of it applies to fluids.

  /// Adds a site, with weight 0 if sites have weights, and returns its index: the last one.
  std::uint32_t add(Point point);
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
  void settle() { last_kind_ = EditKind::nothing; }

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
  enum class EditKind : std::uint8_t { nothing, move, weight, relaxation };

  [[nodiscard]] Site siteOf(std::uint32_t site) const;
  void apply(std::uint32_t site, const std::optional<Site>& before, const std::optional<Site>& after);
  void change(std::uint32_t site, const std::optional<Site>& after, EditKind kind);
  void record(Edit edit);
  /// Makes an edit again, or takes it back.
  void repeat(const Edit& edit, bool forward);
  /// Whether the last edit absorbs another one of this kind.
  bool extendsLastEdit(EditKind kind, std::uint32_t site);

  State now_;
  std::uint64_t revisions_ = 0;
  std::vector<Edit> edits_;
  std::size_t done_ = 0;  ///< number of edits in effect; those after it can be redone
  EditKind last_kind_ = EditKind::nothing;
  std::uint32_t last_site_ = 0;
};

}  // namespace vorpipe::view
