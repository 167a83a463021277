/// Files for the tests of io: a fresh directory for each test, removed after it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vorpipe::test {

inline constexpr auto without_numpy = "there is no python3 with NumPy";

class InTemporaryDirectory : public ::testing::Test {
 protected:
  InTemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "vorpipe-io-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no temporary directory can be made: " + name);
    }
    directory_ = name;
  }
  ~InTemporaryDirectory() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }

  [[nodiscard]] std::string directory() const { return directory_.string(); }
  [[nodiscard]] std::string path(std::string_view name) const { return (directory_ / name).string(); }

  std::string write(std::string_view name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  static std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory_), {}));
  }

  /// Runs Python with NumPy in the directory; false where there is none. The build says which Python: a
  /// machine may have several, of which not all have NumPy.
  [[nodiscard]] bool numpy(const std::string& program) const {
    write("script.py", "import numpy as np\n" + program);
    const char* const chosen = std::getenv("VORPIPE_TEST_PYTHON");
    const std::string python = "'" + std::string(chosen == nullptr ? "python3" : chosen) + "'";
    if (std::system((python + " -c 'import numpy' 2>/dev/null").c_str()) != 0) {
      return false;
    }
    EXPECT_EQ(std::system(("cd '" + directory_.string() + "' && " + python + " script.py").c_str()), 0);
    return true;
  }

 private:
  std::filesystem::path directory_;
};

}  // namespace vorpipe::test
