/// How much memory a run takes, told before it begins, and how much there is.
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

/// The arrays of a run in the order in which they come and go, and how much memory the process has when it
/// has been through them. Memory that was freed stays with the process, and serves arrays that fit into it:
/// so it is with `vorpipe`, and with any program that has many arrays smaller than some megabytes.
class MemoryPlan {
 public:
  using Array = std::size_t;

  /// An array of `bytes`, of which the first `written` are ever touched: the others take no memory.
  Array take(std::string_view what, std::uint64_t bytes, std::uint64_t written);
  Array take(std::string_view what, std::uint64_t bytes) { return take(what, bytes, bytes); }
  void drop(Array array);
  void drop(const std::vector<Array>& arrays);

  /// The next array to be taken; and to drop all that were taken since then, but for some.
  [[nodiscard]] Array next() const { return blocks_.size(); }
  void dropSince(Array first, const std::vector<Array>& kept = {});

  /// Bytes at the peak.
  [[nodiscard]] std::uint64_t peak() const { return touched_bytes_; }
  /// What they are: arrays that there were when the peak was reached, and what was kept of others. Largest
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
  std::map<std::uint64_t, std::uint64_t> free_;     ///< begin and end of what is free below the top
  std::map<std::uint64_t, std::uint64_t> touched_;  ///< begin and end of what was ever written
  std::uint64_t top_ = 0, touched_bytes_ = 0;
  std::vector<MemoryPart> parts_;
};

/// Edges of a cell, on average: cells cover the plane.
inline constexpr std::uint64_t mean_edges = 6;

/// Whether most cells are likely to meet in ties, which takes memory: sites on a lattice have coordinates, or
/// steps from one site to the next, in common. Looks at some thousand sites.
bool areOnLattice(const Sites& sites);

/// What a run is about.
struct Workload {
  std::uint64_t sites = 0;
  std::uint64_t images = 0;  ///< of the sites of a periodic domain: sitesAndImages() less the sites
  bool weighted = false, periodic = false, outlined = false;
  bool on_lattice = false;
  std::uint64_t density_pixels = 0;
  Search search = Search::grid;
  std::string backend = "cpu";  ///< as DeviceInfo::backend has it
  /// The device's memory is this machine's, as with software drivers. (What a graphics card holds of its own
  /// is not counted.)
  bool device_on_host = true;
  bool beside_drivers = false;  ///< as in DeviceInfo
  int threads = 0;
};

/// What a run of Session::cells over these sites is about, on a device and with some CPU threads (0: all).
/// Errors: those of sitesAndImages().
Result<Workload> workloadOf(const Sites& sites, const CellsOptions& options, ImagesFor purpose,
                            const DeviceInfo& device, int threads);

/// Which images a picture with such colors takes: colors by measures take whole cells.
ImagesFor imagesFor(ColorBy color);

/// Plans a program that has opened a Session of the workload's backend: its code, libraries and driver.
void planSession(MemoryPlan& plan, const Workload& work);

/// Plans Session::cells. Returns the arrays of the Diagram.
std::vector<MemoryPlan::Array> planCells(MemoryPlan& plan, const Workload& work, Detail detail);

/// Plans Session::render. Returns the arrays of the Rendering.
std::vector<MemoryPlan::Array> planPicture(MemoryPlan& plan, const Workload& work, int width, int height,
                                           ColorBy color);

/// Plan check() of what planCells and planPicture plan.
void planCellsCheck(MemoryPlan& plan, const Workload& work, Detail detail);
void planPictureCheck(MemoryPlan& plan, const Workload& work, int width, int height);

/// How much memory a process may take.
struct MemoryLimit {
  std::uint64_t bytes = 0;
  std::string what;  ///< what sets it, in words that continue "... are there, "
};

/// The least of what the system has available or has given to this process already, of what the control
/// groups of this process and those around them leave it (v1 and v2), and of the limits on its address space
/// and data. `root` is where the system's files are: another folder for tests.
MemoryLimit systemMemoryLimit(const std::string& root = "/");

}  // namespace vorpipe
