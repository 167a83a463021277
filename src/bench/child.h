/// Runs this program again, in a separate process.
#pragma once

#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::bench {

/// A temporary folder that exists as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// Empty if it could not be made.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Runs `program` with arguments, its standard error in the file `errors`, and waits for it. Errors: it
/// refused its arguments with exit code 2 (input), could not be started or failed (device), in the words of
/// its last line; `go_on` returned false, and it was ended (cancelled).
Result<void> runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& errors, const std::function<bool()>& go_on);

}  // namespace vorpipe::bench
