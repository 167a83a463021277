// The one place where volk, the Vulkan loader's loader, is compiled.
#define VOLK_IMPLEMENTATION
#include <volk.h>
