/// What a window shows and does, apart from the window: events, the panel's changes and pictures come in;
/// what is to be shown and told goes out.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "view/camera.h"
#include "view/document.h"
#include "view/frames.h"
#include "view/panel.h"
#include "view/pointer.h"
#include "view/settings.h"
#include "view/wipe.h"

namespace vorpipe::view {

/// What is told where only a fluid has what is asked for.
inline constexpr const char* no_fluid = "There is no fluid; the panel begins one.";

/// What is told of a fluid that does not flow yet.
inline constexpr const char* how_to_flow = "Space has it flow, N makes a step, a left drag stirs.";

struct ViewerOptions {
  Opened opened{};
  Settings settings{};  ///< colors and marks; its domain, outline, period, size and view are not read
  std::shared_ptr<const Density> density{};
  std::string shown_by{};                           ///< the backend whose driver the window has open
  Load load{};                                      ///< what is dropped
  std::function<void(const std::string&)> copy{};   ///< to the clipboard
  std::function<void(const std::string&)> print{};  ///< a command line
};

class Viewer {
 public:
  /// `wake` is called, from any thread, when take() would find something.
  Viewer(ViewerOptions options, int width, int height, std::function<void()> wake);

  /// What the panel did not keep. Resize, Minimize and Restore are the window's to tell: see resize().
  void take(const Event& event);
  void act(Action action);
  /// As the panel has changed them.
  void change(const Settings& settings);
  /// A fluid, as the command line names it, in place of what is there; that can be undone.
  void beginFluid(FluidCase which);
  /// Continues the fluid with other options.
  void flowBy(const FluidOptions& options);
  void resize(int width, int height);
  /// How many pixels of the window the panel covers, from its left and from its right edge.
  void setCovered(double left, double right);
  /// Of letters, and of what the pointer reaches.
  void setScale(double scale);
  /// Draws the same again, or takes the next step.
  void drawAgain();

  /// Wishes what has changed since the last call. Call after all that came at once.
  void wish();
  /// Takes pictures and all else that was computed; whether there was anything.
  bool takeAnswers();

  /// What is shown now; good until takeAnswers().
  [[nodiscard]] Shown shown() const;
  /// As the last picture has it, with its ids; null before the first.
  [[nodiscard]] const Frame* frame() const { return frame_ ? &*frame_ : nullptr; }
  /// The picture that is shown, which may be a preview; null before the first.
  [[nodiscard]] const Frame* seen() const { return preview_ ? &*preview_ : frame(); }
  [[nodiscard]] PanelInput panelInput(const std::string& presenter, double present_milliseconds) const;
  [[nodiscard]] const Document& document() const { return document_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }

  /// The number of the last wish, and of the last that was answered.
  [[nodiscard]] std::uint64_t wished() const { return wished_; }
  [[nodiscard]] std::uint64_t answered() const { return answered_; }
  /// Whether what is shown is the sharp picture of all that was taken, up to that wish where sites relax, and
  /// files are read and written that were asked for. While it is minimized nothing is drawn.
  [[nodiscard]] bool isSettled(std::uint64_t wish) const;
  /// Sharp pictures so far.
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }

  [[nodiscard]] bool closes() const { return closes_; }
  /// What no picture can be had without: no backend works. None where there is nothing wrong.
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  [[nodiscard]] const std::vector<std::string>& validation() const { return validation_; }

 private:
  enum class Wanted : std::uint8_t { nothing, same_gesture, other };

  void want(Changed changed);
  [[nodiscard]] RenderOptions picture() const;
  [[nodiscard]] BackendOptions drawnBy() const;
  void accept(Answer& answer);
  void accept(Frame& frame);
  bool acceptFluid(const Frame& frame);
  void changed(Changed by);
  void stir();
  void beginAgain();
  void putAnother(Opened opened);
  [[nodiscard]] std::optional<FluidShown> fluidShown() const;
  void compare();
  void putSideBySide();
  void refuse(const Answer& answer);
  void open(Loaded loaded, const std::string& path);
  void undoOrRedo(Action action);
  [[nodiscard]] std::vector<std::string> backendsThatWork() const;
  void nextBackend();
  void save(const char* extension);
  void saveWhatIsSettled();
  void copyCommand();
  void copyFluidCommand();
  void tellCommand();
  [[nodiscard]] std::uint32_t ownerAt(Place place) const;
  [[nodiscard]] std::optional<Hovered> hovered() const;

  ViewerOptions given_;
  Document document_;
  Settings settings_;
  std::shared_ptr<const Density> density_;
  Camera camera_;
  Pointer pointer_{};
  double scale_ = 1;
  bool minimized_ = false;

  Wanted wanted_ = Wanted::other;
  std::uint64_t wished_ = 0, gesture_ = 0, answered_ = 0, pictures_ = 0;
  std::uint64_t shown_version_ = 0;
  std::optional<Frame> frame_{}, preview_{};  ///< the preview only until there is a sharp one
  Wipe wipe_{};
  const Image* put_ = nullptr;  ///< two pictures as one, where they are compared
  int put_column_ = 0;
  std::uint64_t put_version_ = 0;
  std::shared_ptr<const Measures> measures_{};
  std::optional<RelaxStep> step_{};
  std::vector<float> history_{};
  std::vector<Stroke> strokes_{};  ///< that the fluid does not have yet
  std::uint64_t last_stroke_ = 0;
  std::deque<Stopwatch> steps_{};  ///< since each of the fluid's last ones
  std::vector<DeviceInfo> devices_{};
  std::optional<DeviceInfo> device_{};
  Settings wished_settings_{}, drawn_settings_{};  ///< of the last wish, and of the last one that was drawn

  std::vector<std::string> to_save_{};  ///< once the picture is settled
  std::string command_sites_{};         ///< the file of `command_revision_`, once it is written
  std::uint64_t command_revision_ = 0;
  std::string command_{};
  bool command_waits_ = false;
  int files_ = 0;  ///< that are being read and written
  std::string message_{};
  std::optional<Error> fault_{};
  std::vector<std::string> validation_{};
  bool closes_ = false;

  Frames frames_;  ///< last: its thread ends first
};

}  // namespace vorpipe::view
