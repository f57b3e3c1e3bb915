// Some things are forbidden to ordinary users alone, so they cannot be seen as the administrator.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace understudy {

/// While it lives this process is an ordinary user (nobody) in all its threads, if it was the administrator.
/// What is in `folder`, and the folder, belongs to that user from then on.
class OrdinaryUser {
 public:
  explicit OrdinaryUser(const std::string& folder) : was_(geteuid()), was_group_(getegid()) {
    if (was_ != 0) return;
    EXPECT_EQ(chown(folder.c_str(), kNobody, kNobody), 0);
    EXPECT_EQ(setegid(kNobody), 0);
    EXPECT_EQ(seteuid(kNobody), 0);
  }
  ~OrdinaryUser() {
    if (was_ != 0) return;
    EXPECT_EQ(seteuid(was_), 0);
    EXPECT_EQ(setegid(was_group_), 0);
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t was_;
  gid_t was_group_;
};

}  // namespace understudy
