#include "io/base/extension.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace vorpipe {

std::string lowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string inputExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".gz" ? lowerExtension(std::filesystem::path(path).stem().string()) : extension;
}

}  // namespace vorpipe
