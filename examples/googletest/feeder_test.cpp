// A host of one function, and its tests against a controller that is not there.
#include <gtest/gtest.h>
#include <modbus.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "understudy_bench.h"

namespace {

/// The host under test: moves axis A, and says where the controller believes it to be.
class Feeder {
 public:
  explicit Feeder(const std::string& port) : host_(modbus_new_rtu(port.c_str(), 19200, 'E', 8, 1)) {
    modbus_set_slave(host_.get(), 1);
    require(modbus_connect(host_.get()) == 0);
    require(modbus_write_register(host_.get(), 0x1014, 1) == 1);  // Aaxis_SVON
  }

  long feed(int pulses) {
    const uint16_t move[] = {static_cast<uint16_t>(pulses), static_cast<uint16_t>(pulses >> 16), 1200};
    require(modbus_write_registers(host_.get(), 0x1000, 3, move) == 3);  // Aaxis_Pulse, Aaxis_Speed
    require(modbus_write_register(host_.get(), 0x1005, 1) == 1);         // Aaxis_Move_INC
    uint16_t status = 0;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      require(modbus_read_registers(host_.get(), 0x0000, 1, &status) == 1);
    } while ((status & 0x10) != 0);
    uint16_t words[2] = {};
    require(modbus_read_registers(host_.get(), 0x0E04, 2, words) == 2);  // Cord_A
    return static_cast<int32_t>(static_cast<uint32_t>(words[1]) << 16 | words[0]);
  }

 private:
  static void require(bool is_well) {
    if (!is_well) throw std::runtime_error(modbus_strerror(errno));
  }
  struct Free {
    void operator()(modbus_t* host) const {
      modbus_close(host);
      modbus_free(host);
    }
  };
  std::unique_ptr<modbus_t, Free> host_;
};

class FeederTest : public testing::Test {
 protected:
  UnderstudyBench bench{BENCH};
  Feeder feeder{bench.port()};
};

TEST_F(FeederTest, FeedsThereAndBack) {
  EXPECT_EQ(feeder.feed(6400), 6400);
  EXPECT_EQ(bench.get("feeder.Cord_A"), 6400);
  EXPECT_EQ(feeder.feed(-6400), 0);
}

TEST_F(FeederTest, StopsWhereTheUpperLimitIs) {
  const long at = feeder.feed(20000);
  EXPECT_GE(at, 18000);
  EXPECT_LT(at, 18000 + 2 * 64);  // 1200 RPM are 64 pulses a millisecond
  EXPECT_EQ(bench.get("feeder.STATUS.12"), 1);
}

TEST_F(FeederTest, ABlockedMotorDoesNotShowInTheCoordinate) {
  bench.ctl({"inject", "stall", "feeder.A"});
  EXPECT_EQ(feeder.feed(3200), 3200);
  EXPECT_EQ(bench.get("feeder.ENCA"), 0);  // but here
}

TEST_F(FeederTest, ALostReplyIsAnError) {
  bench.ctl({"inject", "drop", "feeder", "function=6"});
  EXPECT_THROW(feeder.feed(3200), std::runtime_error);
}

}  // namespace
