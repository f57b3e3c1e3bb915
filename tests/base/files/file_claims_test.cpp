#include "base/files/file_claims.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace understudy {
namespace file_claims_test {

namespace fs = std::filesystem;

/// A folder with a bench, which is claimed, and two more files.
class FileClaimsTest : public testing::Test {
 protected:
  FileClaimsTest() {
    std::string pattern = testing::TempDir() + "understudy-claims-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    fs::create_directory(at("inner"));
    for (const char* const name : {"bench.yaml", "other.yaml", "inner/third.yaml"}) {
      std::ofstream(at(name)) << name;
    }
    claims_.add({at("bench.yaml"), "the bench itself"});
  }
  ~FileClaimsTest() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
  FileClaims claims_;
  const std::string refusal_ = "is the bench itself; expected another path";
};

TEST_F(FileClaimsTest, AFileIsItselfHoweverItsPathIsSpelled) {
  fs::create_symlink("bench.yaml", at("relative link"));
  fs::create_symlink(at("relative link"), at("link to a link"));
  fs::create_hard_link(at("bench.yaml"), at("inner/hard link"));
  fs::create_directory_symlink(at("inner"), at("linked folder"));
  for (const std::string name :
       {"bench.yaml", "./bench.yaml", "inner/../bench.yaml", "relative link", "link to a link",
        "inner/hard link", "linked folder/hard link", "linked folder/../bench.yaml"}) {
    EXPECT_EQ(claims_.objection_to(at(name)), refusal_) << name;
  }
  EXPECT_EQ(claims_.objection_to(fs::relative(at("bench.yaml")).string()), refusal_);
  for (const std::string name : {"other.yaml", "new.yaml", "inner/bench.yaml", "linked folder/third.yaml"}) {
    EXPECT_EQ(claims_.objection_to(at(name)), "") << name;
  }
  EXPECT_EQ(claims_.objection_to(""), "");
}

TEST_F(FileClaimsTest, AFileThatIsNotThereYetIsOneAsWell) {
  fs::create_symlink("new.txt", at("dangling"));
  fs::create_directory_symlink("inner", at("linked folder"));
  claims_.add({at("inner/../new.txt"), "what --capture writes"});
  claims_.add({at("linked folder/later.txt"), "what --trace writes"});
  EXPECT_EQ(claims_.objection_to(at("new.txt")), "is what --capture writes; expected another path");
  EXPECT_EQ(claims_.objection_to(at("dangling")), "is what --capture writes; expected another path");
  EXPECT_EQ(claims_.objection_to(at("inner/later.txt")), "is what --trace writes; expected another path");
  EXPECT_EQ(claims_.objection_to(at("later.txt")), "");
  // In a folder that does not exist either, only the text of the path counts.
  claims_.add({at("none/a"), "what --record writes"});
  EXPECT_NE(claims_.objection_to(at("none/./a")), "");
}

TEST_F(FileClaimsTest, WhatIsNoRegularFileIsLeftOut) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  for (const std::string& path : {std::string("/dev/null"), at("pipe"), at("inner")}) {
    claims_.add({path, "what --junit writes"});
    EXPECT_EQ(claims_.objection_to(path), "") << path;
  }
  fs::create_symlink("loop", at("loop"));  // leads nowhere; opening it reports that
  EXPECT_EQ(claims_.objection_to(at("loop")), "");
}

TEST_F(FileClaimsTest, TheFirstClaimStands) {
  claims_.add({{at("bench.yaml"), "included"}, {at("other.yaml"), "a program"}});
  EXPECT_EQ(claims_.objection_to(at("bench.yaml")), refusal_);
  EXPECT_EQ(claims_.objection_to(at("other.yaml")), "is a program; expected another path");
}

TEST_F(FileClaimsTest, AFolderIsRefusedForAClaimedFileAmongThoseItGets) {
  const std::vector<std::string> endings{".jsonl", ".jsonl.1"};
  EXPECT_EQ(claims_.objection_to_folder(folder_, endings), "");
  EXPECT_EQ(claims_.objection_to_folder(folder_, {".yaml"}),
            "holds bench.yaml, which is the bench itself; expected another folder");
  EXPECT_EQ(claims_.objection_to_folder(at("inner"), {".yaml"}), "");
  claims_.add({at("inner/a.jsonl.1"), "what --junit writes"});
  EXPECT_EQ(claims_.objection_to_folder(at("inner/."), endings),
            "holds a.jsonl.1, which is what --junit writes; expected another folder");
  EXPECT_EQ(claims_.objection_to_folder(folder_, endings), "");
}

}  // namespace file_claims_test
}  // namespace understudy
