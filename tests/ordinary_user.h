// Makes root an ordinary user for a while, because some operations are forbidden only to ordinary users.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace understudy {

/// While this object exists, the process is an ordinary user (nobody) in all its threads, if it was root.
/// `folder` and its contents then belong to that user.
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
