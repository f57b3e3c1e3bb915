// `understudy certificate`: evidence becomes a page and a file of JSON, which ssh-keygen signs with a key
// that the test makes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace certificate_test {

using nlohmann::json;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Certificate : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("box.yaml", bench_with("version_encoding: bcd"));
    folder_.write("plain.yaml", bench_with(""));
    folder_.write("talk.yaml",
                  "understudy: 1\nname: talk\nbench: box.yaml\nsteps:\n  - expect: { box.Version: 338 }\n");
    ASSERT_EQ(understudy({"run", folder_ / "talk.yaml", "--capture", folder_ / "captures"}).exit_code, 0);
    const Finished found =
        understudy({"calibrate", folder_ / "captures/talk.pcapng", "--bench", folder_ / "plain.yaml",
                    "--power-up", "-o", evidence_, "--box", "no. 3"});
    ASSERT_EQ(found.exit_code, 0) << found.output << found.errors;
  }
  static std::string bench_with(const std::string& choices) {
    return "understudy: 1\nlines:\n  line:\n    stations:\n      - { name: box, model: simple2-r3, choices: "
           "{ " +
           choices + " } }\n";
  }
  Finished certify() const { return understudy({"certificate", evidence_, "-o", certificate_}); }
  Finished verify() const {
    return understudy({"certificate", "--verify", certificate_, "--signers", folder_ / "signers"});
  }
  /// Makes a key, whose owner is trusted or not, and signs with it.
  void sign(const std::string& key, bool is_trusted) const {
    ASSERT_EQ(run({"ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", "", "-f", folder_ / key}).exit_code,
              0);
    if (is_trusted) folder_.write("signers", "alice@example.com " + text_of(folder_ / (key + ".pub")));
    std::filesystem::remove(certificate_ + ".sig");
    ASSERT_EQ(run({"ssh-keygen", "-Y", "sign", "-q", "-f", folder_ / key, "-n", "understudy", certificate_})
                  .exit_code,
              0);
  }
  const PrivateFolder folder_;
  const std::string evidence_ = folder_ / "evidence.json";
  const std::string certificate_ = folder_ / "box.certificate.json";
  const std::string page_ = folder_ / "box.certificate.html";
};

TEST_F(Certificate, SaysWhatWasMeasuredByWhich) {
  const Finished made = certify();
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  EXPECT_TRUE(has(made.output, "ssh-keygen -Y sign -f KEY -n understudy " + certificate_)) << made.output;
  const json file = json::parse(text_of(certificate_), nullptr, false);
  EXPECT_EQ(file["box"], "no. 3");
  bool is_named = false;
  for (const json& row : file["choices"]) {
    if (row["choice"] != "version_encoding") continue;
    is_named = true;
    EXPECT_EQ(row["option"], "bcd");
    EXPECT_TRUE(has(row["measured_by"], "captures/talk.pcapng:")) << row;
  }
  EXPECT_TRUE(is_named) << file;
  const auto digest_by_coreutils = [](const std::string& path) {
    return run({"sha256sum", path}).output.substr(0, 64);
  };
  EXPECT_EQ(file["page"]["sha256"], digest_by_coreutils(page_));
  EXPECT_EQ(file["evidence"][0]["sha256"], digest_by_coreutils(evidence_));
  EXPECT_EQ(file["evidence"][0]["captures"][0]["sha256"],
            digest_by_coreutils(folder_ / "captures/talk.pcapng"));
  const std::string page = text_of(page_);
  EXPECT_TRUE(has(page, "<h1>Certificate of no. 3</h1>")) << page;
  EXPECT_TRUE(has(page, "<td>version_encoding</td><td>bcd</td>")) << page;
  EXPECT_FALSE(has(page, "<script")) << page;
}

TEST_F(Certificate, IsVerifiedByTheKeyOfItsOwner) {
  ASSERT_EQ(certify().exit_code, 0);
  ASSERT_NO_FATAL_FAILURE(sign("key", true));
  const Finished good = verify();
  EXPECT_EQ(good.exit_code, 0) << good.output << good.errors;
  EXPECT_TRUE(has(good.output, "verified: Good \"understudy\" signature for alice@example.com"))
      << good.output;
  EXPECT_TRUE(has(good.output, "box.certificate.html: is the file that was certified")) << good.output;
  // A copy that has lost its capture is still good.
  std::filesystem::remove(folder_ / "captures/talk.pcapng");
  const Finished alone = verify();
  EXPECT_EQ(alone.exit_code, 0) << alone.output;
  EXPECT_TRUE(has(alone.output, "talk.pcapng: was not found")) << alone.output;
}

TEST_F(Certificate, IsRefusedAfterAnyChange) {
  ASSERT_EQ(certify().exit_code, 0);
  ASSERT_NO_FATAL_FAILURE(sign("key", true));
  for (const std::string& file : {evidence_, page_, folder_ / "captures/talk.pcapng", certificate_}) {
    const std::string before = text_of(file);
    std::ofstream(file, std::ios::app | std::ios::binary) << " ";
    const Finished changed = verify();
    EXPECT_EQ(changed.exit_code, 1) << file << changed.output << changed.errors;
    EXPECT_TRUE(has(changed.output, "NOT VERIFIED")) << changed.output;
    std::ofstream(file, std::ios::binary) << before;
  }
  EXPECT_EQ(verify().exit_code, 0);
}

TEST_F(Certificate, IsRefusedIfAStrangerSignedIt) {
  ASSERT_EQ(certify().exit_code, 0);
  ASSERT_NO_FATAL_FAILURE(sign("key", true));
  ASSERT_NO_FATAL_FAILURE(sign("other", false));
  const Finished other = verify();
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_TRUE(has(other.output, "NOT VERIFIED: no key in")) << other.output;
}

TEST_F(Certificate, RefusesWhatItCannotCertifyInOneLine) {
  const std::string rows =
      R"("devices": [{"name": "box", "model": "slim", "firmware": "1.0"}], "choices": [)";
  const auto evidence = [&](const std::string& name, const std::string& head, const std::string& row) {
    return folder_.write(name, R"({"understudy": 1, "kind": "evidence", )" + head + rows + row + "]}");
  };
  const auto measured = [](const std::string& option) {
    return R"({"choice": "box.echo", "state": "measured", "options": [")" + option + R"("], "capture": "c"})";
  };
  const std::string nameless = evidence("nameless.json", "", measured("a"));
  const std::string one = evidence("one.json", R"("box": "1", )", measured("a"));
  const std::string differing = evidence("differing.json", R"("box": "1", )", measured("b"));
  const std::string two = evidence("two.json", R"("box": "2", )", measured("a"));
  const std::string nothing = evidence("nothing.json", R"("box": "1", )", "");
  const std::string broken = evidence("broken.json", R"("box": "1", "explained": false, )", measured("a"));
  const std::string to = folder_ / "to.json";
  const struct {
    Words words;
    std::string what;
  } cases[] = {
      {{nameless, "-o", to}, "names no controller; expected --box NAME"},
      {{one, two, "-o", to}, "is of the controller '2', not of '1'"},
      {{one, differing, "-o", to}, "box.echo is measured as b, but as a by c:0"},
      {{nothing, "-o", to}, "no choice is measured"},
      {{broken, "-o", to}, "no options explain its captures"},
      {{folder_ / "plain.yaml", "-o", to}, "evidence: is none"},
      {{one, "-o", folder_ / "to.txt"}, "does not end in .json"},
      {{"--verify", one}, "expected --signers FILE"},
      {{"--verify", one, "--signers", one}, "certificate: is not one"},
      {{one}, "expected -o FILE.json"},
  };
  for (const auto& row : cases) {
    Words words{"certificate"};
    words.insert(words.end(), row.words.begin(), row.words.end());
    const Finished refused = understudy(words);
    EXPECT_EQ(refused.exit_code, 2) << row.what;
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    EXPECT_TRUE(has(refused.errors, row.what)) << refused.errors;
    EXPECT_FALSE(std::filesystem::exists(to)) << row.what;
  }
  ASSERT_EQ(certify().exit_code, 0);
  folder_.write("signers", "");
  EXPECT_TRUE(has(verify().errors, "signature: ")) << verify().errors;
}

}  // namespace certificate_test
}  // namespace understudy::acceptance
