#include "view/window/glfw.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/try.h"

namespace vorpipe::view {
namespace {

// The library's usual names, for the loader to find; it does not search Homebrew's folders.
#ifdef __APPLE__
constexpr std::array library_names = {"libglfw.3.dylib", "/opt/homebrew/lib/libglfw.3.dylib",
                                      "/usr/local/lib/libglfw.3.dylib"};
#else
constexpr std::array library_names = {"libglfw.so.3", "libglfw.so"};
#endif

constexpr std::string_view remedy = "install libglfw3 (Debian, Ubuntu) or glfw (Fedora, Arch, Homebrew)";

// The library stays open until the process ends.
void* openLibrary() {
  for (const char* const name : library_names) {
    if (void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL); library != nullptr) return library;
  }
  return nullptr;
}

Result<void> load(Glfw& glfw) {
  void* const library = openLibrary();
  if (library == nullptr) {
    return tl::unexpected(Error{
        ErrorCode::device,
        fmt::format("a window needs GLFW, and {} cannot be loaded: {}", library_names.front(), remedy)});
  }
  const char* missing = nullptr;
#define VORPIPE_GLFW_LOAD(member, function)                                         \
  glfw.member = reinterpret_cast<decltype(glfw.member)>(dlsym(library, #function)); \
  if (glfw.member == nullptr) missing = #function;
  VORPIPE_GLFW_FUNCTIONS(VORPIPE_GLFW_LOAD)
#undef VORPIPE_GLFW_LOAD
  if (missing == nullptr) return {};
  return tl::unexpected(
      Error{ErrorCode::device,
            fmt::format("a window needs GLFW 3.3, and the one here lacks {}: {}", missing, remedy)});
}

}  // namespace

Result<std::shared_ptr<const Glfw>> Glfw::start() {
  static std::weak_ptr<const Glfw> running;
  if (auto shared = running.lock()) return shared;
  auto started = std::make_shared<Glfw>();
  VORPIPE_TRY(load(*started));
  if (started->init() == GLFW_FALSE) {
    return tl::unexpected(Error{ErrorCode::device, fmt::format("no display: {}", started->lastError())});
  }
  started->started_ = true;
  running = started;
  return started;
}

Glfw::~Glfw() {
  if (started_) terminate();
}

std::string Glfw::lastError() const {
  const char* said = nullptr;
  if (getError(&said) == GLFW_NO_ERROR || said == nullptr) return "GLFW does not say why";
  std::string line = said;
  std::ranges::replace(line, '\n', ' ');
  return line;
}

}  // namespace vorpipe::view
