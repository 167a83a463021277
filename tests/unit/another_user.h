/// A user who may not do everything, as root may.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <string_view>

namespace vorpipe::test {

/// While it lives, a process of root's is that of another user, to whom a directory is given. Any other
/// process stays as it is.
class AnotherUser {
 public:
  explicit AnotherUser(const std::string& directory) : was_root_(::geteuid() == 0) {
    constexpr ::uid_t nobody = 65534;  // there as on most systems; no other process needs to be this user's
    constexpr ::gid_t nogroup = 65534;
    if (!was_root_ || ::chown(directory.c_str(), nobody, nogroup) != 0 || ::setegid(nogroup) != 0) return;
    is_ = ::seteuid(nobody) == 0;
  }
  ~AnotherUser() {
    if (!was_root_) return;
    EXPECT_EQ(::seteuid(0), 0);
    EXPECT_EQ(::setegid(0), 0);
  }
  AnotherUser(const AnotherUser&) = delete;
  AnotherUser& operator=(const AnotherUser&) = delete;

  /// Why root is still root; empty if it is not, or never was.
  [[nodiscard]] std::string_view whyNot() const {
    return !was_root_ || is_ ? "" : "root may do everything, and cannot become another user here";
  }

 private:
  bool was_root_, is_ = false;
};

}  // namespace vorpipe::test
