/// The window's logic, independent of the window itself. Input: events, the panel's changes and pictures.
/// Output: what to show and which messages to print.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "view/camera.h"
#include "view/document.h"
#include "view/frames.h"
#include "view/panel.h"
#include "view/pointer.h"
#include "view/settings.h"

namespace vorpipe::view {

/// Message when an action needs a fluid and there is none.
inline constexpr const char* no_fluid = "There is no fluid; the panel begins one.";

/// Message for a fluid that does not flow yet.
inline constexpr const char* how_to_flow = "Space has it flow, N makes a step, a left drag stirs.";

/// The line of help that fades.
inline constexpr const char* what_to_do =
    "A click adds a site, a drag moves it, the wheel zooms, Space relaxes; ? lists the rest.";

struct ViewerOptions {
  Opened opened{};
  Settings settings{};  ///< colors and marks; its domain, outline, period, size and view are ignored
  std::shared_ptr<const Density> density{};
  std::string shown_by{};                           ///< the backend whose driver the window uses
  Load load{};                                      ///< for dropped files
  std::function<void(const std::string&)> copy{};   ///< copies to the clipboard
  std::function<void(const std::string&)> print{};  ///< prints a command line
  bool is_played = true;  ///< by a script, or for a file: each picture is one step, and time changes nothing
};

class Viewer {
 public:
  /// `wake` is called, from any thread, when there are results to take.
  Viewer(ViewerOptions options, int width, int height, std::function<void()> wake);

  /// Handles an event that the panel did not consume. For Resize, Minimize and Restore see resize().
  void take(const Event& event);
  void act(Action action);
  void change(const Settings& settings);
  /// Replaces the contents by a fluid of the command line's cases; that can be undone.
  void beginFluid(FluidCase which);
  void flowBy(const FluidOptions& options);
  void resize(int width, int height);
  /// Sets how many pixels at the window's left and right edges the panel covers.
  void setCovered(double left, double right);
  void setScale(double scale);
  /// Draws the same again, or takes the next step.
  void drawAgain();

  /// Issues a request for what has changed since the last call. Call once after a batch of events.
  void request();
  /// Takes pictures and all other results; returns whether there were any.
  bool takeResults();

  /// What to show now; valid until takeResults().
  [[nodiscard]] Shown shown() const;
  /// The last sharp picture, with its ids; null before the first.
  [[nodiscard]] const Frame* frame() const { return frame_ ? &*frame_ : nullptr; }
  /// The picture shown now, perhaps a preview; null before the first.
  [[nodiscard]] const Frame* seen() const { return preview_ ? &*preview_ : frame(); }
  [[nodiscard]] PanelInput panelInput(const std::string& presenter, double present_milliseconds) const;
  [[nodiscard]] const Document& document() const { return document_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }

  /// The numbers of the last request and of the last completed request.
  [[nodiscard]] std::uint64_t requested() const { return requested_; }
  [[nodiscard]] std::uint64_t completed() const { return completed_; }
  /// Whether the shown picture is sharp and includes all events, up to request `request` if sites relax, and
  /// all requested files are read and written. While the window is minimized, nothing is drawn.
  [[nodiscard]] bool isSettled(std::uint64_t request) const;
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }

  /// How much of the line that says what to do first is shown, from 1 to 0; it fades after some seconds.
  [[nodiscard]] double hintShows() const;

  [[nodiscard]] bool closes() const { return closes_; }
  /// The error that prevents any picture: no backend works. None if all is well.
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  [[nodiscard]] const std::vector<std::string>& validation() const { return validation_; }

 private:
  enum class Wanted : std::uint8_t { nothing, same_gesture, other };

  void want(Changed changed);
  [[nodiscard]] RenderOptions picture() const;
  [[nodiscard]] BackendOptions drawnBy() const;
  void accept(RenderResult& result);
  void accept(Frame& frame);
  bool acceptFluid(const Frame& frame);
  void changed(Changed by);
  void stir();
  void beginAgain();
  void replaceContents(Opened opened);
  [[nodiscard]] std::optional<FluidShown> fluidShown() const;
  void compare();
  void joinPictures();
  void handleError(const RenderResult& result);
  void open(Loaded loaded, const std::string& path);
  void undoOrRedo(Action action);
  [[nodiscard]] std::string backendAfter() const;
  void nextBackend();
  void save(const char* extension);
  void saveSettled();
  void copyCommand();
  void publishCommand();
  [[nodiscard]] std::uint32_t ownerAt(Position position) const;
  [[nodiscard]] std::optional<Hovered> hovered() const;
  [[nodiscard]] std::vector<Position> borderAt(Position position) const;

  ViewerOptions options_;
  Document document_;
  Settings settings_;
  std::shared_ptr<const Density> density_;
  Camera camera_;
  Pointer pointer_{};
  double scale_ = 1;
  bool minimized_ = false;

  Wanted wanted_ = Wanted::other;
  std::uint64_t requested_ = 0, gesture_ = 0, completed_ = 0, pictures_ = 0;
  std::uint64_t shown_version_ = 0;
  std::optional<Frame> frame_{}, preview_{};  ///< the preview only until the sharp picture exists
  SplitView split_view_{};
  const Image* joined_ = nullptr;  ///< two compared pictures joined into one
  int joined_column_ = 0;
  std::uint64_t joined_version_ = 0;
  std::shared_ptr<const Measures> measures_{};
  std::optional<RelaxStep> step_{};
  std::vector<float> history_{};
  std::vector<Stroke> strokes_{};  ///< not yet applied to the fluid
  std::uint64_t last_stroke_ = 0;
  /// Of the fluid's last pictures: a watch that runs since each, and the number of its step.
  std::deque<std::pair<Stopwatch, std::uint64_t>> steps_{};
  Stopwatch open_{};  ///< since when the window is open
  std::vector<DeviceInfo> devices_{};
  std::optional<DeviceInfo> device_{};
  Settings requested_settings_{}, drawn_settings_{};  ///< of the last request, and of the last drawn request

  std::vector<std::string> to_save_{};  ///< once the picture is settled
  std::string command_sites_{};         ///< the written file of `command_revision_`
  std::uint64_t command_revision_ = 0;
  std::string command_{};
  bool command_waits_ = false;
  int files_ = 0;  ///< number of files being read and written
  std::string message_{};
  std::optional<Error> fault_{};
  std::vector<std::string> validation_{};
  bool closes_ = false;

  Frames frames_;  ///< last: its thread ends first
};

}  // namespace vorpipe::view
