// Lists what vorpipe can draw with on this machine, and why it cannot use the rest.
#include <cstdio>
#include <string>

#include "vorpipe.h"

int main() {
  std::printf("vorpipe %s\n", std::string(vorpipe::version()).c_str());
  for (const auto& device : vorpipe::devices({})) {
    const auto& what = device.usable ? device.name : device.reason;
    std::printf("%s: %s\n", device.backend.c_str(), what.c_str());
  }
}
