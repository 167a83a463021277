/// What backends take of memory, for a forecast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace vorpipe {

/// What OpenGL's shaders say in one draw is caught in a buffer of this size.
inline constexpr std::size_t feedback_bytes = std::size_t{32} * 1024 * 1024;

/// Where several devices of a driver share the cells, fewer are not worth another device.
inline constexpr std::size_t cells_per_device = std::size_t{1} << 14;

/// By how much more code newer drivers come: Mesa 25.0.7 with LLVM 19 than 22.3.6 with LLVM 15. A forecast is
/// of these.
inline constexpr std::uint64_t newer_driver_bytes = 17'000'000;

/// What stays of drivers that are closed again, as measured with Mesa 22.3.6, LLVM 15 and libvulkan 1.3.
inline constexpr std::uint64_t looked_through_bytes = 57'000'000 + newer_driver_bytes;

/// In bytes. Those of the device count where its memory is the host's.
struct DeviceNeeds {
  std::uint64_t program;                  ///< code, libraries and driver, once it is open
  std::uint64_t compiling;                ///< what the driver takes besides while it makes a pipeline
  std::uint64_t site, bin, mark;          ///< on the device, for each
  std::uint64_t weight, heaviest;         ///< on the device, for each site and each bin, with weights
  std::uint64_t passing_site;             ///< on the host while sites are sent
  std::uint64_t entry;                    ///< on the device, for each cell of a call
  std::uint64_t answer, weighted_answer;  ///< for each cell of a slice
  std::uint64_t polygon;                  ///< on the device, for each cell of a slice that is drawn
  std::uint64_t slice, drawn_slice;       ///< most cells at a time
  std::uint64_t drawn;                    ///< on the host, for each site once it is drawn
  std::uint64_t pixel;                    ///< of a view, on the device
  std::uint64_t pool_pixel;               ///< of a view, on the host where there may be several devices
  std::uint64_t resizing_pixel;           ///< of a view, where views of several sizes follow each other
  std::uint64_t rasterizing;              ///< what a software device takes besides, once it draws
  int largest_view;
  std::uint64_t devices;         ///< devices at the same time, where each gets cells_per_device
  std::uint64_t further_device;  ///< for each of them but the first
  bool reserves_rows;            ///< room for as many neighbors as a row may have; else rows grow by doubling
};

/// Of one of the registry's names. Unknown ones need what "cpu" does.
DeviceNeeds deviceNeeds(std::string_view backend, int threads);

}  // namespace vorpipe
