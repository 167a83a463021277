#include "view/panel.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <imgui.h>

#include "view/feed.h"
#include "view/font.h"
#include "view/groups.h"
#include "view/place.h"
#include "view/style.h"
#include "view/triangles.h"
#include "view/widgets.h"

namespace vorpipe::view {
namespace {

/// Owner of a mouse drag, from press to release.
enum class Holder { none, panel, window };

bool holds(const Placement& rectangle, Place place) {
  return place.x >= rectangle.left && place.x < rectangle.left + rectangle.width &&
         place.y >= rectangle.top && place.y < rectangle.top + rectangle.height;
}

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
  Feed feed;
  Widgets widgets{1};
  PanelPlace place;
  Place pointer{-1, -1};
  Holder holder = Holder::none;
  int pressed = 0;  ///< buttons
  bool list_open = false, help_open = false, types = false;
  bool escapes = false;         ///< Escape was taken to close what is open
  std::vector<float> energies;  ///< of the relaxation's steps
  std::uint64_t diagram = 0;

  void setScale(double to);
  [[nodiscard]] bool covers(Place at) const;
  bool takePress();
  bool takeRelease();
  bool takeEscape(const Key& key);
  void follow(const PanelInput& input);
  void drawHeader(PanelFrame& frame);
  void drawWindow(PanelFrame& frame);
  void drawFrame(const PanelInput& input, PanelAnswer& answer);
};

void Panel::State::setScale(double to) {
  scale = to;
  widgets = Widgets(scale);
  setStyle(scale);
  texture = drawFont(scale);
}

bool Panel::State::covers(Place at) const {
  return std::any_of(widgets.covered.begin(), widgets.covered.end(),
                     [at](const Placement& rectangle) { return holds(rectangle, at); });
}

bool Panel::State::takePress() {
  if (pressed++ == 0) holder = list_open || covers(pointer) ? Holder::panel : Holder::window;
  return holder == Holder::panel;
}

bool Panel::State::takeRelease() {
  const bool mine = holder == Holder::panel;
  pressed = std::max(0, pressed - 1);
  if (pressed == 0) holder = Holder::none;
  return mine;
}

bool Panel::State::takeEscape(const Key& key) {
  if (key.name != "escape" || (!list_open && !help_open)) return false;
  escapes = true;
  return true;
}

void Panel::State::follow(const PanelInput& input) {
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

void Panel::State::drawHeader(PanelFrame& frame) {
  Settings& settings = frame.answer.settings;
  const float side = ImGui::GetFrameHeight(),
              right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  const float gap = widgets.px(4);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("vorpipe");
  ImGui::SameLine();
  Widgets::dim(fmt::format("{} site{}", grouped(frame.input.sites), frame.input.sites == 1 ? "" : "s"));
  ImGui::SameLine(right - 3 * side - 2 * gap);
  if (widgets.button("Other side", "\u21c4", side)) place.swap();
  widgets.tooltip("To the other side; or drag the panel where it is empty");
  ImGui::SameLine(0, gap);
  if (widgets.chip("Help", "?", side, settings.help)) settings.help = !settings.help;
  widgets.tooltip("Keys");
  ImGui::SameLine(0, gap);
  if (widgets.button("Hide", "\u00d7", side)) settings.panel = false;
  widgets.tooltip("Hides the panel; Tab shows it again");
}

void Panel::State::drawWindow(PanelFrame& frame) {
  const ImVec2 window{static_cast<float>(frame.input.width), static_cast<float>(frame.input.height)};
  const float margin = widgets.px(10);
  const float width = std::min(widgets.px(284), std::max(1.0F, window.x));
  place.apply(window, width, margin);
  // If the panel would hide the legend, it ends above it, provided that leaves some room.
  float height = window.y - 2 * margin;
  if (const auto& legend = frame.input.legend; legend && place.left() < legend->left + legend->width) {
    const float above = static_cast<float>(legend->top) - margin - place.top();
    if (above >= window.y / 4) height = std::min(height, above);
  }
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(1.0F, height)});
  // The scroll bar lies beside the contents, in space that is always reserved for it.
  ImGui::Begin("##panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
  place.follow();
  widgets.cover();
  widgets.places.insert_or_assign("Panel", widgets.covered.back());
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

void Panel::State::drawFrame(const PanelInput& input, PanelAnswer& answer) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(input.width), static_cast<float>(input.height)};
  io.DeltaTime = 1.0F / 60;
  widgets.places.clear();
  widgets.covered.clear();
  ImGui::NewFrame();
  PanelFrame frame{input, answer, widgets};
  if (escapes && !list_open) answer.settings.help = false;
  widgets.closes_list = escapes && list_open;
  escapes = false;
  if (answer.settings.panel) drawWindow(frame);
  if (pressed == 0) {
    const auto [left, right] = freeOf(frame);
    answer.covers = {left, static_cast<double>(input.width) - right};
  }
  help_open = answer.settings.help;
  if (help_open) drawHelp(frame);
  if (!input.message.empty()) drawMessage(frame);
  if (input.compared) drawWipe(frame);
  list_open = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  const bool is_free = !list_open && !covers(pointer);
  if (is_free && input.fluid && input.fluid->brush && holder != Holder::panel) drawBrush(frame);
  if (is_free && answer.settings.panel && holder == Holder::none) drawTip(frame);
  ImGui::Render();
  types = io.WantTextInput;
}

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

const PanelPlaces& Panel::places() const { return state_->widgets.places; }

bool Panel::take(const Event& event) {
  State& state = *state_;
  state.feed.take(event);
  const bool over = state.list_open || state.covers(state.pointer);
  return std::visit(
      [&](const auto& told) {
        using Told = std::decay_t<decltype(told)>;
        if constexpr (std::is_same_v<Told, Move>) {
          state.pointer = told.to;
          return state.holder == Holder::panel ||
                 (state.holder == Holder::none && (state.list_open || state.covers(told.to)));
        }
        if constexpr (std::is_same_v<Told, Press>) return state.takePress();
        if constexpr (std::is_same_v<Told, Release>) return state.takeRelease();
        if constexpr (std::is_same_v<Told, Scroll>) {
          return state.holder == Holder::none ? over : state.holder == Holder::panel;
        }
        if constexpr (std::is_same_v<Told, Key>) return state.types || state.takeEscape(told);
        if constexpr (std::is_same_v<Told, Text>) return state.types;
        return false;
      },
      event);
}

PanelAnswer Panel::draw(const PanelInput& input, PanelTriangles& triangles) {
  State& state = *state_;
  ImGui::SetCurrentContext(state.context);
  PanelAnswer answer;
  answer.settings = input.settings;
  if (input.scale != state.scale) {
    state.setScale(input.scale);
    answer.new_texture = true;
  }
  state.follow(input);
  while (state.feed.next()) state.drawFrame(input, answer);
  // ImGui measures what opens in one frame and shows it in the next; likewise the panel's height follows its
  // contents.
  for (int i = 0; i < 2; ++i) state.drawFrame(input, answer);
  answer.takes_pointer = state.holder == Holder::panel ||
                         (state.holder == Holder::none && (state.list_open || state.covers(state.pointer)));
  answer.takes_keys = state.types;
  takeTriangles(input.width, input.height, triangles);
  return answer;
}

}  // namespace vorpipe::view
