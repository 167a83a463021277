/// Memory needs of the backends, for a forecast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace vorpipe {

/// Size of the buffer that captures what OpenGL's shaders write in one draw, in bytes.
inline constexpr std::size_t feedback_bytes = std::size_t{32} * 1024 * 1024;

/// Fewer cells than this are not worth another device where several devices of a driver share the cells.
inline constexpr std::size_t cells_per_device = std::size_t{1} << 14;

/// Additional code size of newer drivers: Mesa 25.0.7 with LLVM 19 compared with 22.3.6 with LLVM 15. A
/// forecast assumes the newer ones.
inline constexpr std::uint64_t newer_driver_bytes = 17'000'000;

/// Memory that remains in use after drivers are closed again, measured with Mesa 22.3.6, LLVM 15 and
/// libvulkan 1.3.
inline constexpr std::uint64_t looked_through_bytes = 57'000'000 + newer_driver_bytes;

/// In bytes. Device memory counts only where it is the host's memory.
struct DeviceNeeds {
  std::uint64_t program;                  ///< code, libraries and driver, once the backend is open
  std::uint64_t compiling;                ///< what the driver needs in addition while it makes a pipeline
  std::uint64_t site, bin, mark;          ///< on the device, for each
  std::uint64_t weight, heaviest;         ///< on the device, per site and per bin, if there are weights
  std::uint64_t passing_site;             ///< on the host, per site, while sites are uploaded
  std::uint64_t entry;                    ///< on the device, for each cell of a call
  std::uint64_t answer, weighted_answer;  ///< for each cell of a slice
  std::uint64_t polygon;                  ///< on the device, for each cell of a slice that is drawn
  std::uint64_t slice, drawn_slice;       ///< maximum number of cells processed at a time
  std::uint64_t drawn;                    ///< on the host, for each site once it is drawn
  std::uint64_t pixel;                    ///< per pixel of a view, on the device
  std::uint64_t pool_pixel;      ///< per pixel of a view, on the host, if there may be several devices
  std::uint64_t resizing_pixel;  ///< per pixel of a view, if views of different sizes follow each other
  std::uint64_t rasterizing;     ///< what a software device needs in addition once it draws
  int largest_view;
  std::uint64_t devices;         ///< number of devices at the same time, if each gets cells_per_device cells
  std::uint64_t further_device;  ///< for each of these except the first
  bool reserves_rows;  ///< memory for the most neighbors of each row at once; else it grows by doubling
};

/// Returns the needs of a backend by its name in the registry. Unknown names get those of "cpu".
DeviceNeeds deviceNeeds(std::string_view backend, int threads);

}  // namespace vorpipe
