/// Forecasts how much memory a run takes, and how much there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/devices.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

struct MemoryPart {
  std::string what;
  std::uint64_t bytes = 0;
};

/// The arrays of a run in the order of allocation and release, and the resulting memory of the process. Freed
/// memory stays with the process and serves later arrays that fit into it. `vorpipe` behaves this way, as
/// does any program with many arrays smaller than some megabytes.
class MemoryPlan {
 public:
  using Array = std::size_t;

  /// Adds an array of `bytes`, of which only the first `written` are ever touched: the others take no memory.
  Array take(std::string_view what, std::uint64_t bytes, std::uint64_t written);
  Array take(std::string_view what, std::uint64_t bytes) { return take(what, bytes, bytes); }
  void drop(Array array);
  void drop(const std::vector<Array>& arrays);

  /// next(): the next array that take() will return. dropSince(): drops all arrays from `first` on, except
  /// `kept`.
  [[nodiscard]] Array next() const { return blocks_.size(); }
  void dropSince(Array first, const std::vector<Array>& kept = {});

  /// Bytes at the peak.
  [[nodiscard]] std::uint64_t peak() const { return touched_bytes_; }
  /// What makes up the peak: arrays alive when it was reached, and memory retained from others. Largest
  /// first; they add up to peak().
  [[nodiscard]] const std::vector<MemoryPart>& parts() const { return parts_; }

 private:
  struct Block {
    std::string what;
    std::uint64_t begin, bytes, written;
    bool live;
  };
  std::uint64_t place(std::uint64_t bytes);
  std::uint64_t touch(std::uint64_t begin, std::uint64_t end);
  void noteParts();

  std::vector<Block> blocks_;
  std::map<std::uint64_t, std::uint64_t> free_;     ///< begin and end of free ranges below the top
  std::map<std::uint64_t, std::uint64_t> touched_;  ///< begin and end of ranges ever written
  std::uint64_t top_ = 0, touched_bytes_ = 0;
  std::vector<MemoryPart> parts_;
};

/// Average number of edges of a cell: cells cover the plane.
inline constexpr std::uint64_t mean_edges = 6;

/// Whether most cells are likely to meet in ties, which take memory: on a lattice, many sites share
/// coordinates or steps from one site to the next. Looks at some thousand sites.
bool areOnLattice(const Sites& sites);

/// What determines the memory of a run.
struct Workload {
  std::uint64_t sites = 0;
  std::uint64_t images = 0;  ///< of the sites of a periodic domain: sitesAndImages() minus the sites
  bool weighted = false, periodic = false, outlined = false;
  bool on_lattice = false;
  std::uint64_t density_pixels = 0;
  Search search = Search::grid;
  std::string backend = "cpu";  ///< as in DeviceInfo::backend
  /// The device's memory is this machine's, as with software drivers. (A graphics card's own memory is not
  /// counted.)
  bool device_on_host = true;
  bool beside_drivers = false;  ///< as in DeviceInfo
  int threads = 0;
};

/// Returns the workload of a run of Session::cells over these sites, on a device and with some CPU threads
/// (0: all). Errors: those of sitesAndImages().
Result<Workload> workloadOf(const Sites& sites, const CellsOptions& options, ImagesFor purpose,
                            const DeviceInfo& device, int threads);

/// Which images a picture with such colors needs: colors by measures need whole cells.
ImagesFor imagesFor(ColorBy color);

/// Plans a program that has opened a Session of the workload's backend: its code, libraries and driver.
void planSession(MemoryPlan& plan, const Workload& work);

/// Plans Session::cells. Returns the arrays of the Diagram.
std::vector<MemoryPlan::Array> planCells(MemoryPlan& plan, const Workload& work, Detail detail);

/// Plans Session::render. Returns the arrays of the Rendering.
std::vector<MemoryPlan::Array> planPicture(MemoryPlan& plan, const Workload& work, int width, int height,
                                           ColorBy color);

/// Plan the check() of results that planCells and planPicture plan.
void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail detail);
void planPictureCheck(MemoryPlan& plan, const Workload& work, int width, int height);

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
