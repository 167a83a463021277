/// A backend with the sites that it draws repeatedly.
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
  /// Opens a backend in place of the present one; calls `end` before, to release what uses the present one.
  /// Returns false if this backend is open already. If the new one does not work here, returns its error and
  /// the present one stays. `not_cpu` names a backend to prefer, if it works, where `backend` resolves to
  /// `cpu`; empty: none.
  Result<bool> open(const BackendOptions& backend, const std::string& not_cpu = {},
                    const std::function<void()>& end = {});

  void close();

  /// Call after open(). A domain without sites is white.
  Result<Rendering> render(const FixedSites& sites, const RenderOptions& options);

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] int threads() const { return backend_.threads; }
  [[nodiscard]] bool isOpen() const { return session_ != nullptr; }
  /// The sites drawn last; null before any were drawn.
  [[nodiscard]] KeptSites* kept() { return kept_ ? &*kept_ : nullptr; }
  [[nodiscard]] const FixedSites& keptOf() const { return kept_of_; }

 private:
  BackendOptions backend_{};
  std::string not_cpu_{};             ///< as tried last
  std::unique_ptr<Session> session_;  ///< outlives the members below
  std::optional<KeptSites> kept_;
  FixedSites kept_of_{};
};

}  // namespace vorpipe::view
