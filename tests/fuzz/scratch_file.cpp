#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

#include "target.h"

namespace vorpipe::fuzz {
namespace {

/// A folder that is gone when the process ends.
struct Folder {
  std::string path;

  Folder() {
    std::error_code none;
    const bool in_memory = std::filesystem::is_directory("/dev/shm", none);
    path = (in_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path()).string() +
           "/vorpipe-fuzz-XXXXXX";
    require(::mkdtemp(path.data()) != nullptr, "a folder for files can be made");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

}  // namespace

const std::string& fileOf(std::string_view extension, std::string_view bytes) {
  static const Folder folder;
  static std::map<std::string, std::string, std::less<>> paths;
  auto known = paths.find(extension);
  if (known == paths.end()) {
    known = paths.emplace(extension, folder.path + "/input." + std::string(extension)).first;
  }
  std::ofstream file(known->second, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  require(file.good(), "a file can be written");
  return known->second;
}

}  // namespace vorpipe::fuzz
