/// The scenes that devices are tested with, and their runs on all devices.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/selftest.h"

namespace vorpipe::selftests {

/// Sites, and the options for their cells and picture.
struct Scene {
  Sites sites;
  Box domain{0, 0, 1, 1};
  Outline outline{};
  Periodic periodic = Periodic::none;
  int width = 256, height = 256;  ///< of the picture
};

/// Parameters of a scene.
struct Scale {
  bool quick;
  std::uint64_t seed;
  /// Chooses `few` for quick tests, else `many`.
  [[nodiscard]] std::uint64_t of(std::uint64_t few, std::uint64_t many) const { return quick ? few : many; }
};

/// Limits lowered for a scene. A device is reopened for each of these.
enum class Masked : std::uint8_t {
  nothing,
  limits,  ///< few sites and bins at once, few cells per call
  bits,    ///< vertices on a coarse grid
};

enum class Traits : std::uint8_t {
  once = 0,     ///< made with one seed or none
  random = 1,   ///< other seeds give other scenes
  often = 2,    ///< likewise, but only some are hard: a quick test has several
  extreme = 3,  ///< beyond the supported range: it may be refused, but a wrong result is a fault
};

struct SceneKind {
  std::string_view group, name;
  Traits traits;
  Masked masked;
  Scene (*make)(const Scale& scale);
};

/// All kinds; those of a group follow each other.
std::span<const SceneKind> sceneKinds();

Mask maskOf(Masked masked, const Scale& scale);

/// The functions under test: pictures and cells of one device.
class Runs {
 public:
  virtual ~Runs() = default;
  virtual Result<Rendering> render(const Sites& sites, const RenderOptions& options) = 0;
  virtual Result<Diagram> cells(const Sites& sites, const CellsOptions& options) = 0;
  virtual Result<Arithmetic> arithmetic() = 0;
};

/// Opens the device with a mask.
using OpenRuns = std::function<Result<std::unique_ptr<Runs>>(const Mask& mask)>;

/// A usable device, and how to open it.
struct Tested {
  std::size_t device;  ///< index in SelftestReport::devices
  OpenRuns open;
  bool is_reference;  ///< the backend that all others are compared with
  bool masked;        ///< whether masks have an effect on it
};

/// Runs scenes of all `kinds` on all devices of `tested`. Fills in the runs and the arithmetic of each device
/// in `report`. `reference` opens the backend that they are compared with. Errors: the progress asked to stop
/// (cancelled); the reference cannot be opened (device).
Result<void> runScenes(std::span<const SceneKind> kinds, const std::vector<Tested>& tested,
                       const OpenRuns& reference, const SelftestOptions& options, SelftestReport& report);

/// The first number in `measured` that breaks one of vorpipe's bounds, in words; empty if all keep them.
/// `subpixel_bits` are those that the device reports.
std::string arithmeticFault(const Arithmetic& measured, int subpixel_bits);

}  // namespace vorpipe::selftests
