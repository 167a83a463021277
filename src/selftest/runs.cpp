#include "selftest/runs.h"

#include <utility>

namespace vorpipe::selftests {
namespace {

class SessionRuns final : public Runs {
 public:
  explicit SessionRuns(Session session) : session_(std::move(session)) {}

  Result<Rendering> render(const Sites& sites, const RenderOptions& options) override {
    return session_.render(sites, options);
  }
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options) override {
    return session_.cells(sites, options);
  }
  Result<Arithmetic> arithmetic() override { return session_.arithmetic(); }

 private:
  Session session_;
};

}  // namespace

OpenRuns sessionRuns(const BackendOptions& options) {
  return [options](const Mask& mask) -> Result<std::unique_ptr<Runs>> {
    BackendOptions masked = options;
    auto& limits = masked.mask.limits;
    limits.insert(limits.end(), mask.limits.begin(), mask.limits.end());
    auto session = Session::open(masked);
    if (!session) return tl::unexpected(std::move(session.error()));
    return std::make_unique<SessionRuns>(std::move(*session));
  };
}

}  // namespace vorpipe::selftests
