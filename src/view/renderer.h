/// A backend with the sites that it draws again and again.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "view/document.h"
#include "vorpipe.h"

namespace vorpipe::view {

class Renderer {
 public:
  /// Whether another backend was opened, in place of the one before, after `end` has ended what uses that:
  /// the one that is open already stays, as it does where the other does not work here. `not_cpu` names a
  /// backend that is taken where `backend` comes to `cpu`, if it works; empty: none.
  Result<bool> open(const BackendOptions& backend, const std::string& not_cpu = {},
                    const std::function<void()>& end = {});

  void close();

  /// After open(). A domain without sites is white.
  Result<Rendering> render(const FixedSites& sites, const RenderOptions& options);

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] int threads() const { return backend_.threads; }
  [[nodiscard]] bool isOpen() const { return session_ != nullptr; }
  /// Those that were drawn last; null before there were any.
  [[nodiscard]] KeptSites* kept() { return kept_ ? &*kept_ : nullptr; }
  [[nodiscard]] const FixedSites& keptOf() const { return kept_of_; }

 private:
  BackendOptions backend_{};
  std::string not_cpu_{};             ///< that was tried
  std::unique_ptr<Session> session_;  ///< outlives what follows
  std::optional<KeptSites> kept_;
  FixedSites kept_of_{};
};

}  // namespace vorpipe::view
