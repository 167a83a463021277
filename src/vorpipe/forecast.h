/// Forecasts how much memory a run takes, and how much there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"
#include "vorpipe/space.h"

namespace vorpipe {

struct MemoryPart {
  std::string what;
  std::uint64_t bytes = 0;
};

/// The large arrays of a run in the order of allocation and release, and how much memory they take at the
/// peak.
class MemoryPlan {
 public:
  using Array = std::size_t;

  Array take(std::string_view what, std::uint64_t bytes);
  void drop(Array array);

  /// next(): the next array that take() will return. dropSince(): drops all arrays from `first` on, except
  /// `kept`.
  [[nodiscard]] Array next() const { return arrays_.size(); }
  void dropSince(Array first, const std::vector<Array>& kept = {});

  /// Bytes at the peak.
  [[nodiscard]] std::uint64_t peak() const { return peak_; }
  /// The arrays at the peak by name, largest first; they add up to peak().
  [[nodiscard]] const std::vector<MemoryPart>& parts() const { return parts_; }

 private:
  std::vector<MemoryPart> arrays_, parts_;
  std::uint64_t bytes_ = 0, peak_ = 0;
};

/// Average number of edges of a cell: cells cover the plane.
inline constexpr std::uint64_t mean_edges = 6;

/// What determines the memory of a run.
struct Workload {
  std::uint64_t sites = 0;
  std::uint64_t images = 0;  ///< of the sites of a periodic domain: sitesAndImages() minus the sites
  bool weighted = false, periodic = false, outlined = false, globe = false;
  std::uint64_t density_pixels = 0;
  std::string backend = "cpu";  ///< as in DeviceInfo::backend
  /// The device's memory is this machine's, as with software drivers. (A graphics card's own memory is not
  /// counted.)
  bool device_on_host = true;
  bool beside_drivers = false;  ///< as in DeviceInfo
  int threads = 0;
};

/// Number of images that a run over so many sites in space looks at, as many as white noise needs; 0 without
/// a period.
std::uint64_t imagesInSpace(std::uint64_t sites, const Cells3Options& options);

/// Returns the workload of a run of Session::cells over these sites, on a device and with some CPU threads
/// (0: all). Errors: those of sitesAndImages().
Result<Workload> workloadOf(const Sites& sites, const CellsOptions& options, ImagesFor purpose,
                            const DeviceInfo& device, int threads);

/// Which images a picture with such colors needs: colors by measures need whole cells.
ImagesFor imagesFor(ColorBy color);

/// Plans a program that has opened a Session of the workload's backend: its code, libraries and driver.
void planSession(MemoryPlan& plan, const Workload& work);

/// Plans Session::cells. Returns the Diagram.
MemoryPlan::Array planCells(MemoryPlan& plan, const Workload& work, Detail detail);

/// The same for cells in space.
MemoryPlan::Array planCells(MemoryPlan& plan, const Workload& work, Detail3 detail);

/// Plans Session::render with the picture's options, as far as they are known. Returns the Rendering.
MemoryPlan::Array planPicture(MemoryPlan& plan, const Workload& work, const RenderOptions& options);

/// Plan the check() of results that planCells and planPicture plan.
void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail detail);
void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail3 detail);
void planPictureCheck(MemoryPlan& plan, const Workload& work, const RenderOptions& options);

/// How much memory a process may take.
struct MemoryLimit {
  std::uint64_t bytes = 0;
  std::string what;  ///< what sets the limit, in words that continue "... are there, "
};

/// The least of three limits: memory that the system has available or has given to this process already; what
/// the control groups of this process and their ancestors leave it (v1 and v2); and the limits on its address
/// space and data. `root` is where the system's files are; tests pass another folder.
MemoryLimit systemMemoryLimit(const std::string& root = "/");

}  // namespace vorpipe
