// `understudy photograph`, with `serve` and with boxes made here in the place of the real controller.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "pty/rtu_crc.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/acceptance/tcp_client.h"

namespace understudy::acceptance {
namespace photograph_test {

using nlohmann::json;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

json json_of(const std::string& path) { return json::parse(text_of(path), nullptr, false); }

Finished photograph(const std::string& port, const std::string& model, const std::string& output,
                    const Words& more = {}) {
  Words words{"photograph", port, "--model", model, "-o", output};
  words.insert(words.end(), more.begin(), more.end());
  return understudy(words);
}

/// A pseudo-terminal with a controller that this test makes: it is given each request of 8 bytes.
class FakeBox {
 public:
  using Answer = std::function<Bytes(const Bytes& request)>;

  explicit FakeBox(Answer answer) : master_(::posix_openpt(O_RDWR | O_NOCTTY)), answer_(std::move(answer)) {
    ::grantpt(master_.get());
    ::unlockpt(master_.get());
    path_ = ::ptsname(master_.get());
    slave_ = Descriptor(::open(path_.c_str(), O_RDWR | O_NOCTTY));  // stays open, so that nothing hangs up
    termios raw{};
    ::tcgetattr(slave_.get(), &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_.get(), TCSANOW, &raw);
    thread_ = std::thread([this] { run(); });
  }
  ~FakeBox() {
    is_over_ = true;
    thread_.join();
  }
  FakeBox(const FakeBox&) = delete;
  FakeBox& operator=(const FakeBox&) = delete;

  const std::string& path() const { return path_; }

 private:
  void run() {
    Bytes received;
    while (!is_over_) {
      pollfd ready{.fd = master_.get(), .events = POLLIN, .revents = 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      std::uint8_t byte = 0;
      if (::read(master_.get(), &byte, 1) != 1) return;
      received.push_back(byte);
      if (received.size() < 8) continue;
      const Bytes reply = answer_(received);
      received.clear();
      if (::write(master_.get(), reply.data(), reply.size()) < 0) return;
    }
  }

  Descriptor master_;
  Descriptor slave_;
  std::string path_;
  Answer answer_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

std::string diagnostic(const Finished& finished, int exit_code) {
  EXPECT_EQ(finished.exit_code, exit_code) << finished.output;
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  return finished.errors;
}

const Words kSoon{"--timeout", "20ms"};

/// A bench whose only device is called "box".
std::string bench_of(const std::string& model, const std::string& more = "", const std::string& line = "") {
  return "understudy: 1\nlines:\n  line:\n    link: port\n    timing: instant\n" + line +
         "    stations:\n      - name: box\n        model: " + model + "\n" + more;
}

TEST(Photograph, FillsAnImageWithWhatTheMemoryHolds) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(bench_of(
      "simple2-r3", "        set: { Aaxis_Resoultion: 1600, DIN0_Aaxis_Alarm: 1, Aaxis_Speed: 77 }\n"));
  const Finished finished = photograph(served->port(), "simple2-r3", folder / "box.nv.json");
  ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find(" at 19200 8E1: "), std::string::npos) << finished.output;
  const json registers = json_of(folder / "box.nv.json")["registers"];
  EXPECT_EQ(registers, (json{{"Aaxis_Resoultion", 1600}, {"DIN0_Aaxis_Alarm", 1}}));
  const json photo = json_of(folder / "box.photo.json");
  const auto has = [&](const std::string& name, int value, const std::string& place) {
    for (const json& row : photo["values"])
      if (row["name"] == name) return row["value"] == value && row["place"] == place;
    return false;
  };
  EXPECT_TRUE(has("Aaxis_Speed", 77, "holding.0x1002"));
  EXPECT_TRUE(has("HW_Code", 49153, "holding.0x0001"));
  EXPECT_EQ(photo["refused"], json::array());
}

TEST(Photograph, SendsReadsOnly) {
  const PrivateFolder folder;
  for (const std::string model : {"simple2-r3", "rs-m8194h", "super-40nc"}) {
    const std::string capture = folder / model;
    {
      const auto served = RunningUnderstudy::of_model(model, {"--capture", capture, "--timing", "instant"});
      EXPECT_EQ(photograph(served->port(), model, folder / "box.nv.json").exit_code, 0) << model;
    }
    int requests = 0;
    for (const std::string& line : lines_of(text_of(capture))) {
      std::istringstream words(line);
      std::string time, way, name, station, function;
      words >> time >> way >> name >> station >> function;
      if (way != "in") continue;
      ++requests;
      EXPECT_TRUE(function == "01" || function == "02" || function == "03" || function == "04") << line;
    }
    EXPECT_GT(requests, 10) << model;
  }
}

TEST(Photograph, AsksAChainOnlyQueriesAndForItsProgram) {
  const PrivateFolder folder;
  const std::string capture = folder / "capture";
  {
    const auto served = RunningUnderstudy::of_bench(
        bench_of("slim",
                 "        modules: 2\n        set: { T1PR3: 250, N7: 12, R2: 3 }\n"
                 "        program: |\n          HON\n          MA 500\n"),
        {"--capture", capture});
    const Finished finished = photograph(served->port(), "slim", folder / "box.nv.json");
    ASSERT_EQ(finished.exit_code, 0) << finished.errors;
  }
  const json image = json_of(folder / "box.nv.json");
  EXPECT_EQ(image["registers"]["N7"], 12) << image;
  EXPECT_EQ(image["reals"]["R2"], 3.0) << image;
  EXPECT_EQ(image["program"], (json{"HON", "MA 500"})) << image;
  EXPECT_EQ(json_of(folder / "box.photo.json")["refused"], json::array());
  int queries = 0;
  for (const std::string& line : lines_of(text_of(capture))) {
    if (line.find(" in ") == std::string::npos || line.starts_with("#")) continue;
    ++queries;
    const bool is_harmless =
        line.find(" 3F ") != std::string::npos || line.find(" 55 4C 50 0D") != std::string::npos;
    EXPECT_TRUE(is_harmless) << line;
  }
  EXPECT_GT(queries, 100);
}

TEST(Photograph, FindsTheSpeedAndSaysWhichItTried) {
  const PrivateFolder folder;
  const RunningUnderstudy fast({"--baud", "115200"});
  const Finished found = photograph(fast.port(), "simple2-r3", folder / "box.nv.json", kSoon);
  EXPECT_EQ(found.exit_code, 0) << found.errors;
  EXPECT_NE(found.output.find(" at 115200 8E1: "), std::string::npos) << found.output;
  const std::string wrong =
      diagnostic(photograph(fast.port() + ",19200", "simple2-r3", folder / "none.nv.json", kSoon), 1);
  EXPECT_NE(wrong.find("station 1 did not answer at 19200 8E1; expected"), std::string::npos) << wrong;
  const std::string nobody = diagnostic(
      photograph(fast.port(), "simple2-r3", folder / "none.nv.json", {"--timeout", "20ms", "--station", "9"}),
      1);
  EXPECT_NE(nobody.find("station 9 did not answer at 19200 8E1, 115200 8E1; expected"), std::string::npos)
      << nobody;
  EXPECT_FALSE(std::filesystem::exists(folder / "none.nv.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none.photo.json"));
}

TEST(Photograph, GoesThroughEachKindOfAdapter) {
  const PrivateFolder folder;
  for (const std::string scheme : {"rtu", "rfc2217", "modbus-tcp"}) {
    const RunningUnderstudy served({"--listen", scheme + "://:0", "--timing", "instant"});
    const std::string url = scheme + "://127.0.0.1:" + std::to_string(listened_port(served));
    const Finished finished = photograph(url, "simple2-r3", folder / scheme + ".nv.json");
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_NE(finished.output.find("1285 values, 0 refused"), std::string::npos) << finished.output;
  }
}

TEST(Photograph, RemovesTheEchoOfAnAdapter) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(bench_of("simple2-r3", "", "    echo: on\n"));
  const Finished finished = photograph(served->port(), "simple2-r3", folder / "box.nv.json");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("the adapter echoes"), std::string::npos) << finished.output;
  const FakeBox only_echo([](const Bytes& request) { return request; });
  const std::string reported =
      diagnostic(photograph(only_echo.path(), "simple2-r3", folder / "none.nv.json", kSoon), 1);
  EXPECT_NE(reported.find("the adapter echoes the request"), std::string::npos) << reported;
}

Bytes with_checksum(Bytes frame) {
  pty::append_rtu_crc(frame);
  return frame;
}

/// Answers a read of registers with zeros.
Bytes zeros_for(const Bytes& request, std::uint8_t station) {
  const auto count = static_cast<std::size_t>(request[5]);
  Bytes reply{station, request[1], static_cast<std::uint8_t>(2 * count)};
  reply.resize(3 + 2 * count);
  return with_checksum(reply);
}

TEST(Photograph, NamesAnotherStationThatAnswers) {
  const PrivateFolder folder;
  const FakeBox other([](const Bytes& request) { return zeros_for(request, 5); });
  const std::string reported =
      diagnostic(photograph(other.path(), "simple2-r3", folder / "b.nv.json", kSoon), 1);
  EXPECT_NE(reported.find("station 5 answered a request to station 1"), std::string::npos) << reported;
}

TEST(Photograph, SaysThatBytesAreNoAnswer) {
  const PrivateFolder folder;
  const FakeBox noise([](const Bytes&) { return Bytes{0xFC, 0x00, 0x7F}; });
  const std::string reported =
      diagnostic(photograph(noise.path(), "simple2-r3", folder / "b.nv.json", kSoon), 1);
  EXPECT_NE(reported.find("bytes arrived that are not a reply"), std::string::npos) << reported;
}

TEST(Photograph, SaysWhenABoxStopsAnswering) {
  const PrivateFolder folder;
  int asked = 0;
  const FakeBox dying([&](const Bytes& request) { return ++asked > 6 ? Bytes() : zeros_for(request, 1); });
  const std::string reported =
      diagnostic(photograph(dying.path(), "simple2-r3", folder / "b.nv.json", kSoon), 1);
  EXPECT_NE(reported.find("stopped answering after "), std::string::npos) << reported;
  EXPECT_TRUE(json_of(folder / "b.photo.json")["ended"].is_string());
}

TEST(Photograph, KeepsWhatItHasWhenItIsInterrupted) {
  for (const int signal_number : {SIGHUP, SIGINT, SIGTERM}) {
    const PrivateFolder folder;
    std::atomic<int> asked = 0;
    const FakeBox slow([&](const Bytes& request) {
      ++asked;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return zeros_for(request, 1);
    });
    Process process(
        {UNDERSTUDY_BINARY, "photograph", slow.path(), "--model", "simple2-r3", "-o", folder / "b.nv.json"});
    ASSERT_TRUE(eventually([&] { return asked > 3; }));
    process.send(signal_number);
    EXPECT_EQ(process.wait(kPatience), 1) << signal_number;
    EXPECT_NE(process.errors().find("photograph: interrupted"), std::string::npos) << process.errors();
    const json photo = json_of(folder / "b.photo.json");
    EXPECT_EQ(photo["ended"], "interrupted");
    EXPECT_GT(photo["values"].size(), 0U);
    EXPECT_LT(photo["values"].size(), 1285U);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.nv.json"));
  }
}

TEST(Photograph, AsksOneByOneWhereABlockIsRefused) {
  const PrivateFolder folder;
  constexpr int kHole = 0x1003;  // Aaxis_AccTime
  const FakeBox holed([](const Bytes& request) {
    const int first = request[2] << 8 | request[3];
    const bool has_hole = first <= kHole && kHole < first + request[5];
    return has_hole ? with_checksum({1, 0x83, 2}) : zeros_for(request, 1);
  });
  const Finished finished = photograph(holed.path(), "simple2-r3", folder / "b.nv.json", kSoon);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(
      json_of(folder / "b.photo.json")["refused"],
      (json::array({{{"name", "Aaxis_AccTime"}, {"place", "holding.0x1003"}, {"why", "exception 2"}}})));
  // Zero is not a resolution: the image is one that a bench takes.
  const auto served =
      RunningUnderstudy::of_bench(bench_of("simple2-r3", "        nv: " + folder.path() + "/b.nv.json\n"));
  EXPECT_EQ(served->ports().size(), 1U);
}

TEST(Photograph, IsTheMemoryOfADeviceOnABench) {
  const PrivateFolder folder;
  {
    const auto served =
        RunningUnderstudy::of_bench(bench_of("simple2-r3", "        set: { Aaxis_Resoultion: 1600 }\n"));
    ASSERT_EQ(photograph(served->port(), "simple2-r3", folder / "box.nv.json").exit_code, 0);
  }
  const auto served =
      RunningUnderstudy::of_bench(bench_of("simple2-r3", "        nv: " + folder.path() + "/box.nv.json\n"));
  EXPECT_EQ(understudy({"poll", served->port(), "--model", "simple2-r3", "Aaxis_Resoultion"}).output,
            "Aaxis_Resoultion 1600\n");
}

TEST(Photograph, RefusesWhatItCannotDoInOneLine) {
  const PrivateFolder folder;
  const std::string good = folder / "b.nv.json";
  const std::string bench = folder.write("bench.nv.json", bench_of("simple2-r3"));
  const std::string beside = folder / "mine.nv.json";
  folder.write("mine.photo.json", "notes of mine\n");
  std::filesystem::create_directory(folder / "sub.nv.json");
  const struct {
    std::string port, model, output;
    Words more;
    int exit_code;
    std::string what;
  } cases[] = {
      {"/dev/none",
       "simple2-r3",
       good,
       {},
       3,
       "/dev/none: No such file or directory; expected a serial port"},
      {"/dev/null", "simple2-r3", good, {}, 3, "/dev/null: is not a serial port"},
      {"/dev/none,19k2", "simple2-r3", good, {}, 2, "'19k2' is not a speed"},
      {"/dev/none,19200,9E1", "simple2-r3", good, {}, 2, "'9E1' is not a framing"},
      {"rtu://127.0.0.1:1,9600", "simple2-r3", good, {}, 2, "carries none"},
      {"rtu://127.0.0.1", "simple2-r3", good, {}, 2, "expected rtu://HOST:PORT"},
      {"modbus-tcp://127.0.0.1:1", "slim", good, {}, 1, "carries Modbus, but slim speaks text"},
      {"/dev/none", "simple2-r3", folder / "b.json", {}, 2, "expected a name that ends in .nv.json"},
      {"/dev/none", "simple2-r3", bench, {}, 3, "it is a bench; expected an NV image to replace"},
      {"/dev/none", "simple2-r3", beside, {}, 3, "it is not a photograph; expected one to replace"},
      {"/dev/none", "simple2-r3", folder / "none/b.nv.json", {}, 3, "No such file or directory"},
      {"/dev/none", "simple2-r3", folder / "sub.nv.json", {}, 3, "it is a directory"},
      {"/dev/none", "simple2-r3", good, {"--arrays"}, 2, "simple2-r3 has no long arrays"},
      {"/dev/none", "simple2", good, {}, 2, "the nearest is 'simple2-r3'"},
      {"/dev/none", "simple2-r3", good, {"--firmware", "9.99"}, 2, "is not a firmware version of simple2-r3"},
      {"/dev/none", "simple2-r3", good, {"--modules", "2"}, 2, "has no modules"},
      {"/dev/none", "slim", good, {"--station", "2"}, 2, "has no station number"},
      {"/dev/none", "slim", good, {"--modules", "9"}, 2, "expected 1 to 8"},
      {"/dev/none", "slim", good, {"--timeout", "soon"}, 2, "is not a duration"},
  };
  for (const auto& row : cases) {
    const std::string reported =
        diagnostic(photograph(row.port, row.model, row.output, row.more), row.exit_code);
    EXPECT_NE(reported.find(row.what), std::string::npos) << reported;
  }
}

}  // namespace photograph_test
}  // namespace understudy::acceptance
