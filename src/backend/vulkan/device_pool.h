/// Several software devices that draw one picture.
#pragma once

#include <functional>
#include <memory>

#include "backend/backend.h"

namespace vorpipe::vulkan {

/// Opens one more of the same device.
using OpenDevice = std::function<Result<std::unique_ptr<Backend>>()>;

/// Software drivers run the geometry stage of a device on one thread. This spreads large batches over
/// up to `most_devices` devices, each with a picture of its own, opened when there is work for them. A
/// pixel that several pictures cover gets the cell that was drawn last, so that the picture is the
/// one that `first` alone would draw.
std::unique_ptr<Backend> makeDevicePool(std::unique_ptr<Backend> first, OpenDevice open, int most_devices);

}  // namespace vorpipe::vulkan
