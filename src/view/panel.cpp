#include "view/panel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <imgui.h>

#include "view/imgui_io.h"
#include "view/widgets.h"

namespace vorpipe::view {
namespace {

/// Owner of a mouse drag, from press to release.
enum class Holder { none, panel, window };

bool holds(const Placement& rectangle, Position position) {
  return position.x >= rectangle.left && position.x < rectangle.left + rectangle.width &&
         position.y >= rectangle.top && position.y < rectangle.top + rectangle.height;
}

/// Dragging a free part of its surface moves the panel. Released near the window's left or right edge, it
/// stays at that edge when the window is resized.
class PanelPosition {
 public:
  /// Call before the panel's ImGui window begins: `width` is the panel's, `margin` its distance from the
  /// window's edges.
  void apply(ImVec2 window, float width, float margin) {
    window_ = window;
    width_ = width;
    margin_ = margin;
    // While a button is held, Dear ImGui moves the panel.
    if (began_ && ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    const float farthest = std::max(margin, window.x - width - margin);
    if (!began_) at_ = {margin, margin};
    if (side_ == Side::left) at_.x = margin;
    if (side_ == Side::right) at_.x = farthest;
    at_.x = std::clamp(at_.x, std::min(0.0F, farthest), std::max(farthest, 0.0F));
    at_.y = std::clamp(at_.y, 0.0F, std::max(margin, window.y / 2));
    ImGui::SetNextWindowPos({std::round(at_.x), std::round(at_.y)}, ImGuiCond_Always);
    began_ = true;
  }

  /// Call after it began.
  void follow() {
    const ImVec2 at = ImGui::GetWindowPos();
    if (at.x == std::round(at_.x) && at.y == std::round(at_.y)) return;
    at_ = at;
    const float near = 3 * margin_;
    side_ = Side::free;
    if (window_.x - at.x - width_ < near) side_ = Side::right;
    if (at.x < near) side_ = Side::left;
    if (at.y < near) at_.y = margin_;
  }

  [[nodiscard]] float left() const { return at_.x; }
  [[nodiscard]] float top() const { return at_.y; }
  /// Moves the panel to the other edge.
  void swap() { side_ = side_ == Side::right ? Side::left : Side::right; }

 private:
  enum class Side { left, right, free };
  Side side_ = Side::left;
  bool began_ = false;
  ImVec2 at_{0, 0}, window_{0, 0};
  float width_ = 0, margin_ = 0;
};

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number) {
  std::string text = fmt::format("{}", number);
  for (auto end = static_cast<int>(text.size()) - 3; end > 0; end -= 3)
    text.insert(static_cast<std::size_t>(end), 1, ',');
  return text;
}

}  // namespace

struct Panel::State {
  ImGuiContext* context = ImGui::CreateContext();
  PanelTexture texture;
  double scale = 0;
  InputQueue input_queue;
  Widgets widgets{1};
  PanelPosition position;
  Position pointer{-1, -1};
  Holder holder = Holder::none;
  int pressed = 0;  ///< buttons
  bool list_open = false, help_open = false, types = false;
  bool escapes = false;         ///< Escape was taken to close what is open
  std::vector<float> energies;  ///< of the relaxation's steps
  std::uint64_t diagram = 0;

  void setScale(double to) {
    scale = to;
    widgets = Widgets(scale);
    setStyle(scale);
    texture = drawFont(scale);
  }

  /// Whether the pointer is over something that blocks it from the window.
  [[nodiscard]] bool isOver() const {
    return list_open || std::ranges::any_of(widgets.covered, [this](const Placement& rectangle) {
             return holds(rectangle, pointer);
           });
  }

  [[nodiscard]] bool hasPointer() const;

  bool takePress() {
    if (pressed++ == 0) holder = isOver() ? Holder::panel : Holder::window;
    return holder == Holder::panel;
  }

  bool takeRelease() {
    const bool mine = holder == Holder::panel;
    pressed = std::max(0, pressed - 1);
    if (pressed == 0) holder = Holder::none;
    return mine;
  }

  bool takeEscape(const Key& key) {
    if (key.name != "escape" || (!list_open && !help_open)) return false;
    escapes = true;
    return true;
  }

  void follow(const PanelInput& input) {
    if (!input.relaxed) {
      energies.clear();
      return;
    }
    const RelaxStep& step = *input.relaxed;
    if (!energies.empty() && step.diagram == diagram) return;
    if (step.diagram < diagram) energies.clear();
    diagram = step.diagram;
    // More values than pixels: keep every other one.
    if (energies.size() >= 1000) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < energies.size(); i += 2) energies[kept++] = energies[i];
      energies.resize(kept);
    }
    energies.push_back(static_cast<float>(std::isfinite(step.hexagonal) ? step.hexagonal : step.energy));
  }

  void drawHeader(PanelFrame& frame) {
    Settings& settings = frame.result.settings;
    const float side = ImGui::GetFrameHeight(),
                right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    const float gap = widgets.px(4);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("vorpipe");
    ImGui::SameLine();
    Widgets::dim(fmt::format("{} site{}", grouped(frame.input.sites), frame.input.sites == 1 ? "" : "s"));
    ImGui::SameLine(right - 3 * side - 2 * gap);
    if (widgets.button("Other side", "\u21c4", side)) position.swap();
    widgets.tooltip("To the other side; or drag the panel where it is empty");
    ImGui::SameLine(0, gap);
    if (widgets.chip("Help", "?", side, settings.help)) settings.help = !settings.help;
    widgets.tooltip("Keys");
    ImGui::SameLine(0, gap);
    if (widgets.button("Hide", "\u00d7", side)) settings.panel = false;
    widgets.tooltip("Hides the panel; Tab shows it again");
  }

  void drawWindow(PanelFrame& frame) {
    const ImVec2 window{static_cast<float>(frame.input.width), static_cast<float>(frame.input.height)};
    const float margin = widgets.px(10);
    const float width = std::min(widgets.px(284), std::max(1.0F, window.x));
    position.apply(window, width, margin);
    // If the panel would hide the legend, it ends above it, provided that leaves some room.
    float height = window.y - 2 * margin;
    if (const auto& legend = frame.input.legend; legend && position.left() < legend->left + legend->width) {
      const float above = static_cast<float>(legend->top) - margin - position.top();
      if (above >= window.y / 4) height = std::min(height, above);
    }
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(1.0F, height)});
    // The scroll bar lies beside the contents, in space that is always reserved for it.
    ImGui::Begin("##panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
    position.follow();
    widgets.cover();
    widgets.placements.insert_or_assign("Panel", widgets.covered.back());
    drawHeader(frame);
    drawActions(frame);
    drawCell(frame);
    drawShow(frame);
    drawColor(frame);
    if (!frame.input.fluid) drawRelax(frame, energies);
    drawFluid(frame);
    drawDevice(frame);
    drawTimes(frame);
    ImGui::End();
  }

  void drawFrame(const PanelInput& input, PanelResult& result) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(input.width), static_cast<float>(input.height)};
    io.DeltaTime = 1.0F / 60;
    widgets.placements.clear();
    widgets.covered.clear();
    ImGui::NewFrame();
    PanelFrame frame{input, result, widgets};
    if (escapes && !list_open) result.settings.help = false;
    widgets.closes_list = escapes && list_open;
    escapes = false;
    if (result.settings.panel) drawWindow(frame);
    if (pressed == 0) {
      const auto [left, right] = freeOf(frame);
      result.covers = {left, static_cast<double>(input.width) - right};
    }
    help_open = result.settings.help;
    if (help_open) drawHelp(frame);
    if (!input.message.empty()) {
      drawMessage(frame, input.message, 1);
    } else if (!input.hint.empty() && input.hint_shows > 0) {
      drawMessage(frame, input.hint, static_cast<float>(input.hint_shows));
    }
    if (input.compared) drawSplit(frame);
    list_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool is_free = !isOver();
    if (is_free && input.fluid && input.fluid->brush && holder != Holder::panel) drawBrush(frame);
    if (is_free && result.settings.panel && holder == Holder::none) {
      drawBorder(frame);
      drawTip(frame);
    }
    ImGui::Render();
    types = io.WantTextInput;
  }
};

/// Whether the pointer belongs to the panel now: it is over it, or drags from it.
bool Panel::State::hasPointer() const { return holder == Holder::none ? isOver() : holder == Holder::panel; }

Panel::Panel() : state_(std::make_unique<State>()) {
  ImGui::SetCurrentContext(state_->context);
  ImGuiIO& io = ImGui::GetIO();
  // Nothing is stored in files, and nothing depends on time.
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;
  io.MouseDoubleClickTime = 0;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  state_->setScale(1);
}

Panel::~Panel() { ImGui::DestroyContext(state_->context); }

const PanelTexture& Panel::texture() const { return state_->texture; }

const WidgetPlacements& Panel::placements() const { return state_->widgets.placements; }

bool Panel::take(const Event& event) {
  State& state = *state_;
  state.input_queue.take(event);
  if (const auto* const move = std::get_if<Move>(&event)) {
    state.pointer = move->to;
    return state.hasPointer();
  }
  if (std::holds_alternative<Scroll>(event)) return state.hasPointer();
  if (std::holds_alternative<Press>(event)) return state.takePress();
  if (std::holds_alternative<Release>(event)) return state.takeRelease();
  if (const auto* const key = std::get_if<Key>(&event)) return state.types || state.takeEscape(*key);
  return std::holds_alternative<Text>(event) && state.types;
}

PanelResult Panel::draw(const PanelInput& input, PanelTriangles& triangles) {
  State& state = *state_;
  ImGui::SetCurrentContext(state.context);
  PanelResult result;
  result.settings = input.settings;
  if (input.scale != state.scale) {
    state.setScale(input.scale);
    result.new_texture = true;
  }
  state.follow(input);
  while (state.input_queue.next()) state.drawFrame(input, result);
  // ImGui measures what opens in one frame and shows it in the next; likewise the panel's height follows its
  // contents.
  for (int i = 0; i < 2; ++i) state.drawFrame(input, result);
  result.takes_pointer = state.hasPointer();
  result.takes_keys = state.types;
  takeTriangles(input.width, input.height, triangles);
  return result;
}

}  // namespace vorpipe::view
