/// A backend that forwards every call to another; derived classes override some of them.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

class ForwardingBackend : public Backend {
 public:
  explicit ForwardingBackend(Backend& real) : real_(real) {}  ///< `real` outlives this

  const BackendInfo& info() const override { return real_.info(); }
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    return real_.upload(sites, palette_index);
  }
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override {
    return real_.cells(which, capacity, out);
  }
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override {
    return real_.cells(batch, out);
  }
  Result<void> begin(const View& view) override { return real_.begin(view); }
  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override {
    return real_.draw(which, capacity, status);
  }
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
                    std::span<CellStatus> status) override {
    return real_.draw(batch, marks, capacity, status);
  }
  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override {
    return real_.drawTriangles(corners, corner_of);
  }
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    return real_.read(rgba, ids);
  }
  Result<void> compute(std::span<const Operands> operands, std::span<Computed> out) override {
    return real_.compute(operands, out);
  }
  [[nodiscard]] double deviceSeconds() const override { return real_.deviceSeconds(); }
  std::vector<PipelineTime> pipelinesMade() override { return real_.pipelinesMade(); }
  std::vector<std::string> validationMessages() override { return real_.validationMessages(); }

 private:
  Backend& real_;
};

}  // namespace vorpipe
