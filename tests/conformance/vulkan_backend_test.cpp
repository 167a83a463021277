// What is the backend's "vulkan-geometry" alone; device_*_test.cpp is compiled with it.
#include "backend/vulkan/vulkan_backend.h"

#include <gtest/gtest.h>

#include "backend_scene.h"

namespace vorpipe::test {

std::unique_ptr<Backend> openBackend(const Mask& mask, int threads) {
  BackendOptions options;
  options.mask = mask;
  options.threads = threads;
  options.validation = true;
  Result<std::unique_ptr<Backend>> backend = makeVulkanGeometryBackend(options);
  if (!backend) {
    ADD_FAILURE() << backend.error().message;
    return nullptr;
  }
  return std::move(*backend);
}

std::string_view backendName() { return "vulkan-geometry"; }

Result<std::unique_ptr<Backend>> tryBackend() {
  BackendOptions options;
  options.validation = true;
  return makeVulkanGeometryBackend(options);
}

namespace {

TEST(VulkanBackend, TakesItsEntriesFromTheStorageRange) {
  const auto backend = openBackend({{}, {{"maxStorageBufferRange", 4096}}});
  ASSERT_TRUE(backend);
  EXPECT_EQ(backend->info().max_entries, 1024U);
}

}  // namespace
}  // namespace vorpipe::test
