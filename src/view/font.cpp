#include "view/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <imgui.h>

#include "view/font_file.h"

namespace vorpipe::view {

PanelTexture drawFont(double scale) {
  // Pairs of first and last character, ended by 0. Dear ImGui keeps the pointer.
  static constexpr std::array<ImWchar, 11> ranges{0x20,   0x17F,  0x391,  0x3C9,  0x400, 0x45F,
                                                  0x2010, 0x2265, 0x25A0, 0x2715, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
#if IMGUI_VERSION_NUM >= 19200
  // Otherwise the texture starts as RGBA, and GetTexDataAsAlpha8() would build it again.
  atlas.TexDesiredFormat = ImTextureFormat_Alpha8;
#endif
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  const std::span<const unsigned char> file = fontFile();
  // ImGui only reads it.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  auto* bytes = const_cast<unsigned char*>(file.data());
  atlas.AddFontFromMemoryTTF(bytes, static_cast<int>(file.size()),
                             std::max(6.0F, std::round(static_cast<float>(14 * scale))), &config,
                             ranges.data());
  PanelTexture texture;
  unsigned char* alpha = nullptr;
  atlas.GetTexDataAsAlpha8(&alpha, &texture.width, &texture.height);
  texture.alpha.assign(alpha, alpha + std::ptrdiff_t{texture.width} * texture.height);
  return texture;
}

}  // namespace vorpipe::view
