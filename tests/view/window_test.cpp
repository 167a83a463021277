// Windows on a real X server, by both ways to show something: what they show is read back, and compared with
// what the server has on its screen.
#include "view/window/window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "view/test_screen.h"

namespace vorpipe::view {
namespace {

using test::screenPart;

constexpr double longest = 10;  // seconds, that a desktop may take

Image randomPicture(int width, int height, unsigned seed = 1) {
  std::mt19937 random(seed);
  Image picture{width, height, {}, {}};
  for (int pixel = 0; pixel < width * height; ++pixel)
    picture.rgba.push_back(0xFF000000U | (random() & 0xFFFFFFU));
  return picture;
}

Image plain(int width, int height, std::uint32_t color) {
  return {
      width,
      height,
      std::vector<std::uint32_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), color),
      {}};
}

std::uint32_t at(const Image& image, int x, int y) {
  return image.rgba.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
}

class Windows : public testing::TestWithParam<WindowApi> {
 protected:
  Window open(int width, int height) {
    WindowOptions options;
    options.width = width;
    options.height = height;
    options.api = GetParam();
    options.validation = true;
    auto window = Window::open(options);
    if (!window) {
      ADD_FAILURE() << window.error().message;
      std::abort();
    }
    return std::move(*window);
  }

  // Takes events until there is one of this kind that `isRight` accepts; those that came with it are lost.
  template <class Kind, class IsRight>
  static std::optional<Kind> wait(Window& window, const IsRight& isRight) {
    const auto begun = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begun < std::chrono::duration<double>(longest)) {
      for (const Event& event : window.events(longest)) {
        if (const auto* const found = std::get_if<Kind>(&event); found != nullptr && isRight(*found))
          return *found;
      }
    }
    return std::nullopt;
  }

  template <class Kind>
  static std::optional<Kind> wait(Window& window) {
    return wait<Kind>(window, [](const Kind&) { return true; });
  }

  static Shown whole(const Image& picture, std::uint64_t version) {
    Shown frame;
    frame.picture = &picture;
    frame.version = version;
    frame.placement = {0, 0, static_cast<double>(picture.width), static_cast<double>(picture.height)};
    return frame;
  }

  static Image shown(Window& window, const Shown& frame) {
    const auto done = window.presenter().show(frame, window.width(), window.height());
    EXPECT_TRUE(done.has_value()) << done.error().message;
    auto read = window.presenter().read();
    EXPECT_TRUE(read.has_value()) << read.error().message;
    return read ? std::move(*read) : Image{};
  }

  // Drivers hand pictures to the server at their own pace.
  static bool screenHas(Window& window, const Image& picture) {
    const auto begun = std::chrono::steady_clock::now();
    do {
      if (screenPart(picture.width, picture.height).rgba == picture.rgba) return true;
      window.events(0.01);
    } while (std::chrono::steady_clock::now() - begun < std::chrono::duration<double>(longest));
    return false;
  }

  static void expectSilence(Window& window) {
    EXPECT_THAT(window.presenter().validationMessages(), testing::IsEmpty());
  }
};

TEST_P(Windows, ShowASharpPictureInEveryPixel) {
  Window window = open(400, 300);
  std::cout << window.presenter().name() << '\n';
  const Image picture = randomPicture(400, 300);
  EXPECT_TRUE(shown(window, whole(picture, 1)).rgba == picture.rgba);
  EXPECT_TRUE(screenHas(window, picture));
  const Image other = randomPicture(400, 300, 2);
  EXPECT_TRUE(shown(window, whole(other, 2)).rgba == other.rgba);
  EXPECT_TRUE(screenHas(window, other));
  expectSilence(window);
}

// Colors of what is drawn, opaque.
constexpr std::uint32_t red = 0xFF0000FFU, green = 0xFF00FF00U, blue = 0xFFFF0000U, white = 0xFFFFFFFFU;

TEST_P(Windows, ShowTheBackgroundWhereThereIsNoSite) {
  Window window = open(60, 40);
  Image picture = plain(60, 40, 0);
  picture.rgba[0] = 0x80FFFFFFU;
  const Image read = shown(window, whole(picture, 1));
  // Half of white and half of 0x20, rounded.
  EXPECT_EQ(at(read, 0, 0), 0xFF909090U);
  EXPECT_EQ(at(read, 1, 0), background);
  EXPECT_EQ(at(read, 59, 39), background);
  EXPECT_TRUE(shown(window, {}).rgba == plain(60, 40, background).rgba);
  expectSilence(window);
}

TEST_P(Windows, ShowAMovedPictureWhereItIsPlaced) {
  Window window = open(200, 100);
  const Image picture = plain(8, 4, red);
  Shown frame = whole(picture, 1);
  frame.placement = {10, 20, 100, 50};
  const Image read = shown(window, frame);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool inside = x >= 10 && x < 110 && y >= 20 && y < 70;
      ASSERT_EQ(at(read, x, y), inside ? red : background) << x << ' ' << y;
    }
  }
  EXPECT_TRUE(screenHas(window, read));
  // Far beyond the window on all sides: its middle shows, with the seam of the halves in the middle.
  Image halves = plain(2, 1, white);
  halves.rgba[0] = 0xFF000000U;
  frame = whole(halves, 2);
  frame.placement = {-10000, -5000, 20200, 10100};
  const Image zoomed = shown(window, frame);
  for (int x = 0; x < 200; ++x) {
    const double expected = 255 * ((x + 0.5 + 10000) / 20200 * 2 - 0.5);
    ASSERT_NEAR(at(zoomed, x, 50) & 0xFFU, expected, 2) << x;
  }
  // Shrunk to a quarter, beyond the left.
  frame = whole(halves, 2);
  frame.placement = {-10, 0, 20, 10};
  const Image small = shown(window, frame);
  EXPECT_EQ(at(small, 9, 9), white);
  EXPECT_EQ(at(small, 10, 9), background);
  EXPECT_EQ(at(small, 9, 10), background);
  expectSilence(window);
}

// Two triangles that cover a rectangle, with one color and one place of the texture.
void addRectangle(float left, float top, float right, float bottom, float u, std::uint32_t color,
                  PanelTriangles& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (const auto& [x, y] :
       {std::pair(left, top), std::pair(right, top), std::pair(right, bottom), std::pair(left, bottom)}) {
    to.vertices.push_back({x, y, u, 0.5F, color});
  }
  for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) to.indices.push_back(first + corner);
}

TEST_P(Windows, ShowThePanelOverThePicture) {
  Window window = open(100, 80);
  ASSERT_TRUE(window.presenter().setTexture({4, 1, {255, 255, 0, 0}}).has_value());
  PanelTriangles panel;
  addRectangle(10, 10, 50, 30, 0.25F, red, panel);          // filled
  addRectangle(60, 10, 90, 30, 0.25F, 0x80FFFFFFU, panel);  // half of it shines through
  addRectangle(10, 40, 50, 60, 0.75F, red, panel);          // no letter there
  addRectangle(60, 40, 90, 60, 0.25F, green, panel);        // cut off
  panel.parts = {{0, 18, 0, 0, 100, 80}, {18, 6, 70, 45, 500, 55}, {18, 6, -50, -50, -1, -1}};
  const Image picture = plain(100, 80, blue);
  Shown frame = whole(picture, 1);
  frame.panel = &panel;
  const Image read = shown(window, frame);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) {
      std::uint32_t expected = blue;
      if (x >= 10 && x < 50 && y >= 10 && y < 30) expected = red;
      if (x >= 60 && x < 90 && y >= 10 && y < 30) expected = 0xFFFF8080U;
      if (x >= 70 && x < 90 && y >= 45 && y < 55) expected = green;
      ASSERT_EQ(at(read, x, y), expected) << x << ' ' << y;
    }
  }
  EXPECT_TRUE(screenHas(window, read));
  // The same over a moved picture, with another texture.
  ASSERT_TRUE(window.presenter().setTexture({1, 2, {255, 255}}).has_value());
  frame.placement = {0, 0, 50, 80};
  const Image moved = shown(window, frame);
  EXPECT_EQ(at(moved, 30, 50), red);
  EXPECT_EQ(at(moved, 49, 70), blue);
  EXPECT_EQ(at(moved, 50, 70), background);
  EXPECT_EQ(at(moved, 80, 50), green);
  expectSilence(window);
}

TEST_P(Windows, FollowTheirSize) {
  Window window = open(300, 200);
  const Image first = randomPicture(300, 200);
  shown(window, whole(first, 1));
  std::uint64_t version = 1;
  for (const auto& [width, height] :
       {std::pair(500, 350), std::pair(120, 333), std::pair(640, 90), std::pair(301, 201)}) {
    window.apply(Resize{width, height});
    // One that tells the size before, as it comes where the desktop has lost a part, may stand before it.
    const auto told =
        wait<Resize>(window, [wanted = width](const Resize& size) { return size.width == wanted; });
    ASSERT_TRUE(told.has_value());
    EXPECT_EQ(std::pair(told->width, told->height), std::pair(width, height));
    EXPECT_EQ(std::pair(window.width(), window.height()), std::pair(width, height));
    // The old picture, until there is a sharp one.
    shown(window, whole(first, 1));
    const Image sharp = randomPicture(width, height, static_cast<unsigned>(width));
    EXPECT_TRUE(shown(window, whole(sharp, ++version)).rgba == sharp.rgba);
    EXPECT_TRUE(screenHas(window, sharp)) << width << " x " << height;
  }
  // The desktop has another size than the one that is told.
  window.apply(Resize{200, 100});
  const Image late = randomPicture(301, 201, 9);
  ASSERT_TRUE(window.presenter().show(whole(late, ++version), 301, 201).has_value());
  wait<Resize>(window);
  ASSERT_TRUE(window.presenter().show(whole(late, version), 301, 201).has_value());
  expectSilence(window);
}

TEST_P(Windows, AreMinimizedAndRestored) {
  Window window = open(300, 200);
  const Image picture = randomPicture(300, 200);
  shown(window, whole(picture, 1));
  EXPECT_TRUE(screenHas(window, picture));
  window.apply(Minimize{});
  ASSERT_TRUE(wait<Minimize>(window).has_value());
  EXPECT_EQ(std::pair(window.width(), window.height()), std::pair(0, 0));
  const Image other = randomPicture(300, 200, 2);
  ASSERT_TRUE(window.presenter().show(whole(other, 2), 0, 0).has_value());
  EXPECT_TRUE(window.presenter().read()->rgba == picture.rgba);
  window.apply(Restore{});
  ASSERT_TRUE(wait<Restore>(window).has_value());
  EXPECT_EQ(std::pair(window.width(), window.height()), std::pair(300, 200));
  EXPECT_TRUE(shown(window, whole(other, 2)).rgba == other.rgba);
  EXPECT_TRUE(screenHas(window, other));
  window.apply(Close{});
  EXPECT_TRUE(wait<Close>(window).has_value());
  expectSilence(window);
}

TEST_P(Windows, AreTwoAtATime) {
  Window one = open(100, 100), two = open(80, 90);
  const Image first = randomPicture(100, 100), second = randomPicture(80, 90);
  const Image of_one = shown(one, whole(first, 1)), of_two = shown(two, whole(second, 1));
  EXPECT_TRUE(of_one.rgba == first.rgba);
  EXPECT_TRUE(of_two.rgba == second.rgba);
  two = open(50, 50);
  EXPECT_TRUE(one.presenter().read()->rgba == first.rgba);
  expectSilence(one);
}

TEST_P(Windows, WaitUntilTheyAreWoken) {
  Window window = open(100, 100);
  while (!window.events(0.05).empty()) {
  }
  const auto begun = std::chrono::steady_clock::now();
  std::thread other([&] { window.wake(); });
  window.events(longest);
  other.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::duration<double>(longest / 2));
}

INSTANTIATE_TEST_SUITE_P(Both, Windows, testing::Values(WindowApi::vulkan, WindowApi::opengl),
                         [](const auto& api) {
                           return api.param == WindowApi::vulkan ? "Vulkan" : "OpenGL";
                         });

}  // namespace
}  // namespace vorpipe::view
