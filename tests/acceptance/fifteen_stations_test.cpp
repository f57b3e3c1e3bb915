// Fifteen stations on one line and one host, libmodbus, that talks to them in any order: each keeps its own
// registers and its own motion, and replies are never mixed up.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "tests/acceptance/fifteen_stations.h"
#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace fifteen_stations_test {

using Json = nlohmann::json;

constexpr int kAaxisDecTime = 0x1004;
constexpr int kAaxisStop = 0x100E;

struct LineCase {
  const char* name;
  int baud;
  const char* timing;
  int rounds;         // of one request to each station
  Wait silence{100};  // no reply takes this long on this line

  friend std::ostream& operator<<(std::ostream& out, const LineCase& one) { return out << one.name; }
};

/// One host and what it knows of each station: the registers 0x1000 to 0x1004 that it has written, and how
/// many requests and bytes must have gone over the line.
class Traffic {
 public:
  Traffic(const RunningUnderstudy& daemon, const LineCase& line)
      : port_(daemon.port()), line_(line), random_(line.baud + line.rounds) {
    open();
    for (Registers& registers : known_) registers = Registers(5, 0);
  }

  /// Exchanges something with each station, in random order, with a broadcast or an absent station in
  /// between.
  void round(int number) {
    std::array<int, kStations> order{};
    std::iota(order.begin(), order.end(), 1);
    std::shuffle(order.begin(), order.end(), random_);
    const int pause_at = pick(kStations);
    for (int i = 0; i < kStations; ++i) {
      if (i == pause_at && number % 5 == 1) broadcast(number);
      if (i == pause_at && number % 5 == 3) ask_nobody();
      if (i == pause_at && number % 5 == 4) open();
      step(order[static_cast<std::size_t>(i)], number);
    }
  }

  void expect_all_known() {
    for (int station = 1; station <= kStations; ++station) expect_known(station);
  }

  /// The daemon must have counted the bytes that were sent and the replies that were due, and not a byte
  /// more.
  void expect_counted(const Json& line) const {
    EXPECT_EQ(line["bytes_in"], bytes_in_);
    EXPECT_EQ(line["bytes_out"], bytes_out_);
    EXPECT_EQ(line["bytes_discarded"], 0);
    EXPECT_EQ(line["collisions"], 0);
    ASSERT_EQ(line["stations"].size(), kStations);
    for (int station = 1; station <= kStations; ++station) {
      const Json& counted = line["stations"].at(static_cast<std::size_t>(station) - 1);
      const Sent& sent = sent_[static_cast<std::size_t>(station)];
      EXPECT_EQ(counted["address"], station);
      EXPECT_EQ(counted["requests"], sent.requests + broadcasts_) << "station " << station;
      EXPECT_EQ(counted["replies"], sent.requests) << "station " << station;
      EXPECT_EQ(counted["exceptions"], sent.refused) << "station " << station;
      EXPECT_EQ(counted["bytes_dropped"], 0) << "station " << station;
    }
  }

 private:
  struct Sent {
    int requests = 0;
    int refused = 0;
  };

  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  Registers& known(int station) { return known_[static_cast<std::size_t>(station)]; }

  void open() {
    host_.reset();  // before the next one opens
    host_ = std::make_unique<ModbusHost>(port_, HostSetup{.baud = line_.baud, .patience = kPatience});
    ASSERT_TRUE(host_->connected());
  }

  void count(int station, int bytes_in, int bytes_out) {
    host_->set_station(station);
    ++sent_[static_cast<std::size_t>(station)].requests;
    bytes_in_ += bytes_in;
    bytes_out_ += bytes_out;
  }

  // The ranges of two stations never meet, so no value can be another station's.
  static std::uint16_t speed(int station, int step) {
    return static_cast<std::uint16_t>(2000 * station + step % 2000);
  }
  static std::uint16_t ramp(int station, int step) {
    return static_cast<std::uint16_t>(180 * station + step % 180);
  }

  void step(int station, int number) {
    SCOPED_TRACE("round " + std::to_string(number) + ", station " + std::to_string(station));
    switch (pick(8)) {
      case 0: return write_one(station, kAaxisSpeed, speed(station, number));
      case 1: return write_one(station, kAaxisAccTime, ramp(station, number));
      case 2: return write_one(station, kAaxisDecTime, ramp(station, number));
      case 3: return write_all(station, number);
      case 4: return refuse(station);
      default: return expect_known(station);
    }
  }

  void write_one(int station, int address, std::uint16_t value) {
    count(station, 8, 8);
    EXPECT_TRUE(host_->write(address, value)) << modbus_strerror(host_->error());
    known(station)[static_cast<std::size_t>(address - kAaxisPulse)] = value;
  }

  void write_all(int station, int number) {
    const std::uint32_t pulses =
        static_cast<std::uint32_t>(1'000'000 * station + number) * (number % 2 == 0 ? 1U : ~0U);
    known(station) = {static_cast<std::uint16_t>(pulses), static_cast<std::uint16_t>(pulses >> 16),
                      speed(station, number), ramp(station, number), ramp(station, number + 1)};
    count(station, 9 + 2 * 5, 8);
    EXPECT_TRUE(host_->write(kAaxisPulse, known(station))) << modbus_strerror(host_->error());
  }

  /// libmodbus accepts an exception only from the station that it addressed.
  void refuse(int station) {
    const bool hole = pick(2) == 0;
    count(station, 8, 5);
    ++sent_[static_cast<std::size_t>(station)].refused;
    EXPECT_FALSE(hole ? !host_->read(kHole).empty() : host_->write(kAaxisAccTime, 3001));
    EXPECT_EQ(host_->error(), hole ? EMBXILADD : EMBXILVAL) << modbus_strerror(host_->error());
  }

  void expect_known(int station) {
    count(station, 8, 5 + 2 * 5);
    const bool input = pick(2) == 0;
    EXPECT_EQ(input ? host_->read_input(kAaxisPulse, 5) : host_->read(kAaxisPulse, 5), known(station))
        << "station " << station << ": " << modbus_strerror(host_->error());
  }

  void expect_silence(int station, const std::function<bool()>& request) {
    host_->set_station(station);
    host_->set_patience(line_.silence);
    EXPECT_FALSE(request()) << "address " << station;
    EXPECT_EQ(host_->error(), ETIMEDOUT) << modbus_strerror(host_->error());
    host_->set_patience(kPatience);
  }

  void broadcast(int number) {
    ++broadcasts_;
    bytes_in_ += 8;
    const auto value = static_cast<std::uint16_t>(number);  // below 2000: no station has it
    expect_silence(0, [&] { return host_->write(kAaxisSpeed, value); });
    for (int station = 1; station <= kStations; ++station) known(station)[2] = value;
  }

  void ask_nobody() {
    bytes_in_ += 8;
    expect_silence(kStations + 1 + pick(247 - kStations),
                   [&] { return !host_->read(kHardwareCode).empty(); });
  }

  std::string port_;
  LineCase line_;
  std::mt19937 random_;
  std::unique_ptr<ModbusHost> host_;
  std::array<Registers, kStations + 1> known_;
  std::array<Sent, kStations + 1> sent_{};
  int broadcasts_ = 0;
  int bytes_in_ = 0;
  int bytes_out_ = 0;
};

class FifteenStations : public testing::TestWithParam<LineCase> {
 protected:
  std::unique_ptr<RunningUnderstudy> daemon_ =
      RunningUnderstudy::of_bench(fifteen_stations(GetParam().baud, GetParam().timing));
};

TEST_P(FifteenStations, KeepTheirOwnValuesUnderInterleavedTraffic) {
  Traffic traffic(*daemon_, GetParam());
  for (int number = 1; number <= GetParam().rounds && !HasFailure(); ++number) traffic.round(number);
  traffic.expect_all_known();
  const Finished status = daemon_->ctl({"--json", "status"});
  traffic.expect_counted(Json::parse(status.output)["status"]["lines"].at(0));
  for (const std::string& line : lines_of(daemon_->errors())) {
    EXPECT_NE(line.find("a host sends requests to station "), std::string::npos) << line;
    EXPECT_TRUE(line.ends_with("the line has 1 (s1), 2 (s2), 3 (s3), 4 (s4), and 11 more")) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(On, FifteenStations,
                         testing::Values(LineCase{"AWire19200", 19200, "wire", 15},
                                         LineCase{"AWire115200", 115200, "wire", 60, Wait(50)},
                                         LineCase{"InstantTime", 19200, "instant", 100, Wait(30)}),
                         [](const auto& parameter) { return parameter.param.name; });

// --- motion ---------------------------------------------------------------------------------------

class FifteenMoves : public testing::Test {
 protected:
  /// Writes to address 0; libmodbus still waits for a reply.
  void broadcast(int address, int value) {
    host_.set_station(0);
    host_.set_patience(Wait(30));
    EXPECT_FALSE(host_.write(address, value));
    EXPECT_EQ(host_.error(), ETIMEDOUT);
    host_.set_patience(kPatience);
  }
  /// 300 RPM is 16,000 pulses per second, with 10 ms of acceleration and deceleration.
  void prepare(int station, int pulses) {
    host_.set_station(station);
    const auto low = static_cast<std::uint16_t>(pulses);
    EXPECT_TRUE(
        host_.write(kAaxisPulse, Registers{low, static_cast<std::uint16_t>(pulses >> 16), 300, 1, 1}));
  }
  std::int32_t position(int station) {
    host_.set_station(station);
    return host_.read_long(kCordA);
  }
  bool is_moving(int station) {
    host_.set_station(station);
    return host_.is_moving();
  }

  std::unique_ptr<RunningUnderstudy> daemon_ = RunningUnderstudy::of_bench(fifteen_stations(115200, "wire"));
  ModbusHost host_{daemon_->port(), {.baud = 115200}};
};

TEST_F(FifteenMoves, StartTogetherAndEndEachAtItsOwn) {
  broadcast(kAaxisSvon, 1);
  for (int station = 1; station <= kStations; ++station) prepare(station, 1000 * station);
  broadcast(kAaxisMoveInc, 1);
  std::array<std::int32_t, kStations + 1> last{};
  const auto until = std::chrono::steady_clock::now() + kPatience;
  for (int still = 0; still < kStations && !HasFailure();) {
    ASSERT_LT(std::chrono::steady_clock::now(), until) << still << " have arrived";
    // All run at one speed, so the nearest end comes first: when one stops, all below it have stopped.
    for (int station = kStations; station > still; --station) {
      const std::int32_t at = position(station);
      EXPECT_GE(at, last[static_cast<std::size_t>(station)]) << "station " << station;
      EXPECT_LE(at, 1000 * station) << "station " << station;
      last[static_cast<std::size_t>(station)] = at;
    }
    int arrived = still;
    for (int station = kStations; station > still; --station) {
      const bool moves = is_moving(station);
      if (!moves) arrived = std::max(arrived, station);
      EXPECT_FALSE(moves && station < arrived) << "station " << station << " after " << arrived;
    }
    still = arrived;
  }
  for (int station = 1; station <= kStations; ++station) EXPECT_EQ(position(station), 1000 * station);
}

TEST_F(FifteenMoves, StopAtOnePlaceWhenTheyAreToldTogether) {
  broadcast(kAaxisSvon, 1);
  for (int station = 1; station <= kStations; ++station) prepare(station, 1'000'000);
  broadcast(kAaxisMoveInc, 1);
  for (int station = 1; station <= kStations; ++station) EXPECT_TRUE(is_moving(station)) << station;
  broadcast(kAaxisStop, 1);
  for (int station = 1; station <= kStations; ++station)
    EXPECT_TRUE(eventually([&] { return !is_moving(station); })) << station;
  const std::int32_t first = position(1);
  EXPECT_GT(first, 160);  // more than the acceleration and deceleration need: 2 times 80 pulses
  EXPECT_LT(first, 1'000'000);
  for (int station = 2; station <= kStations; ++station)
    EXPECT_EQ(position(station), first) << "station " << station;
}

}  // namespace fifteen_stations_test
}  // namespace understudy::acceptance
