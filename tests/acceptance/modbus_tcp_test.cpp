// A line on Modbus TCP: with libmodbus, mbpoll, pymodbus and raw sockets.
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <chrono>
#include <memory>
#include <regex>
#include <vector>

#include "tests/acceptance/running_understudy.h"
#include "tests/acceptance/tcp_client.h"

namespace understudy::acceptance {
namespace modbus_tcp_test {

const Bytes kRequest = pty::hex("12 34 00 00 00 06 01 03 00 01 00 01");
const Bytes kReply = pty::hex("12 34 00 00 00 05 01 03 02 C0 01");

struct Freed {
  void operator()(modbus_t* host) const {
    modbus_close(host);
    modbus_free(host);
  }
};
using Libmodbus = std::unique_ptr<modbus_t, Freed>;

Libmodbus connected(int port, int unit = 1) {
  Libmodbus host(modbus_new_tcp("127.0.0.1", port));
  EXPECT_EQ(modbus_connect(host.get()), 0) << modbus_strerror(errno);
  modbus_set_slave(host.get(), unit);
  modbus_set_response_timeout(host.get(), 5, 0);
  return host;
}

TEST(ModbusTcpLine, ServesLibmodbus) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const Libmodbus host = connected(listened_port(served));
  for (std::uint16_t speed = 100; speed < 400; ++speed) {
    ASSERT_EQ(modbus_write_register(host.get(), 0x1002, speed), 1) << modbus_strerror(errno);
    std::uint16_t read = 0;
    ASSERT_EQ(modbus_read_registers(host.get(), 0x1002, 1, &read), 1) << modbus_strerror(errno);
    EXPECT_EQ(read, speed);
  }
  std::uint16_t none = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 0x7000, 1, &none), -1);
  EXPECT_EQ(errno, EMBXILADD) << "the device's own exception";
}

TEST(ModbusTcpLine, ReportsThatAStationDoesNotAnswer) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const Libmodbus host = connected(listened_port(served), 9);
  std::uint16_t value = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), -1);
  EXPECT_EQ(errno, EMBXGTAR);
  modbus_set_slave(host.get(), 1);
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), 1) << modbus_strerror(errno);
  EXPECT_EQ(value, 0xC001);
}

TEST(ModbusTcpLine, ExecutesABroadcastWithoutAnAnswer) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const TcpClient client(listened_port(served));
  client.write(pty::hex("00 01 00 00 00 06 00 06 10 02 00 C8"));
  client.write(pty::hex("00 02 00 00 00 06 01 03 10 02 00 01"));
  EXPECT_EQ(client.read(11), pty::hex("00 02 00 00 00 05 01 03 02 00 C8")) << "nothing before it";
}

TEST(ModbusTcpLine, AnswersRequestsThatCameAtOnceOneAfterTheOther) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const TcpClient client(listened_port(served));
  Bytes many;
  Bytes answers;
  for (std::uint8_t i = 0; i < 40; ++i) {
    Bytes request = kRequest;
    Bytes reply = kReply;
    request[1] = reply[1] = i;
    many.insert(many.end(), request.begin(), request.end());
    answers.insert(answers.end(), reply.begin(), reply.end());
  }
  client.write(many);
  EXPECT_EQ(client.read(answers.size()), answers);
}

TEST(ModbusTcpLine, DisconnectsClientsOfOtherProtocols) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  for (const Bytes& other :
       {pty::hex("01 03 00 01 00 01 D5 CA"), Bytes{'G', 'E', 'T', ' ', '/', '\r', '\n'}}) {
    const TcpClient client(listened_port(served));
    client.write(other);
    EXPECT_TRUE(client.is_closed());
  }
  const TcpClient client(listened_port(served));
  client.write(kRequest);
  EXPECT_EQ(client.read(kReply.size()), kReply);
}

// Anyone who reaches the port can send this, without knowing a station.
TEST(ModbusTcpLine, OutlivesLengthsThatNoRequestHas) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  for (const char* header : {"00 00 00 00 00 00", "00 00 00 00 00 01", "00 00 00 00 01 2C"}) {
    for (const Bytes& before : {Bytes{}, kRequest, pty::hex("00 01 00 07 00 03 01 02 03")}) {
      Bytes sent = before;
      const Bytes wrong = pty::hex(header);
      sent.insert(sent.end(), wrong.begin(), wrong.end());
      sent.resize(sent.size() + 300);
      for (std::size_t size : {before.size() + 6, before.size() + 7, sent.size()}) {
        TcpClient(listened_port(served)).write(Bytes(sent.begin(), sent.begin() + std::ptrdiff_t(size)));
      }
    }
  }
  const Libmodbus host = connected(listened_port(served));
  std::uint16_t value = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), 1) << modbus_strerror(errno);
}

TEST(ModbusTcpLine, ForgetsTheRequestsOfAClientThatHasGone) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  {
    const TcpClient silent(listened_port(served));
    Bytes many;
    for (int i = 0; i < 2000; ++i) many.insert(many.end(), kRequest.begin(), kRequest.end());
    silent.write_what_goes(many);
    const Finished status = understudy({"ctl", "--control", served.control(), "status"});
    EXPECT_EQ(status.exit_code, 0) << status.errors;
  }
  const Libmodbus host = connected(listened_port(served));
  std::uint16_t value = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), 1) << modbus_strerror(errno);
}

// The request and the end of its client arrive together.
TEST(ModbusTcpLine, ServesTheRequestOfAClientThatHasGone) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  TcpClient(listened_port(served)).write(pty::hex("00 01 00 00 00 06 00 06 10 02 00 C8"));
  EXPECT_TRUE(eventually([&] { return served.ctl({"get", "Aaxis_Speed"}).output == "Aaxis_Speed 200\n"; }));
}

TEST(ModbusTcpLine, ReplaysWhatCameByIt) {
  const PrivateFolder folder;
  {
    RunningUnderstudy served({"--listen", "modbus-tcp://:0", "--record", folder / "r"});
    const TcpClient client(listened_port(served));
    client.write(kRequest);
    EXPECT_EQ(client.read(kReply.size()), kReply);
    EXPECT_EQ(served.stop(SIGTERM), 0);
  }
  const Finished replay = understudy({"replay", folder / "r"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
}

TEST(ModbusTcpLine, IsPolledByMbpoll) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const Finished host = run({"mbpoll", "-q", "-m", "tcp", "-p", std::to_string(listened_port(served)), "-a",
                             "1", "-0", "-t", "4:hex", "-r", "1", "-1", "127.0.0.1"});
  EXPECT_NE(host.output.find("0xC001"), std::string::npos) << host.output << host.errors;
}

TEST(ModbusTcpLine, IsReadByPymodbus) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const std::string script = "from pymodbus.client import ModbusTcpClient as C; c = C('127.0.0.1', port=" +
                             std::to_string(listened_port(served)) +
                             "); c.connect(); print(c.write_register(0x1002, 77, slave=1).isError(), "
                             "c.read_holding_registers(0x1002, 1, slave=1).registers)";
  const Finished host = run({"/usr/bin/python3", "-c", script});
  EXPECT_EQ(host.output, "False [77]\n") << host.errors;
}

// libmodbus addresses unit 255 unless another one is set.
TEST(ModbusTcpLine, IsReadByLibmodbusWithoutAUnit) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  const Libmodbus host = connected(listened_port(served), MODBUS_TCP_SLAVE);
  std::uint16_t value = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), 1) << modbus_strerror(errno);
  EXPECT_EQ(value, 0xC001);
}

TEST(ModbusTcpLine, ServesSeveralMastersAtOnce) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0"});
  std::vector<Libmodbus> masters;
  for (int i = 0; i < 4; ++i) masters.push_back(connected(listened_port(served)));
  for (int round = 0; round < 5; ++round) {
    for (const Libmodbus& master : masters) {
      std::uint16_t value = 0;
      EXPECT_EQ(modbus_read_registers(master.get(), 1, 1, &value), 1) << modbus_strerror(errno);
    }
  }
}

// A master that waits for half a second is informed in time, and its next request gets its own reply.
TEST(ModbusTcpLine, ReportsAnAbsentStationAsSoonAsRequested) {
  const RunningUnderstudy served({"--listen", "modbus-tcp://:0?timeout=50ms", "--timing", "instant"});
  const Libmodbus host = connected(listened_port(served), 9);
  std::uint16_t value = 0;
  EXPECT_EQ(modbus_read_registers(host.get(), 1, 1, &value), -1);
  EXPECT_EQ(errno, EMBXGTAR);
  const std::string reported =
      "understudy: line line: a host sends requests to station 9, which does not exist; the line has 1 "
      "(device)\n";
  EXPECT_TRUE(eventually([&] { return served.errors().find(reported) != std::string::npos; }))
      << served.errors();
  EXPECT_EQ(served.errors().find("unit 9"), std::string::npos) << "it is reported once: " << served.errors();
}

TEST(ModbusTcpLine, IsRefusedWhereLinesOfTextAreSpoken) {
  const Finished refused = understudy({"serve", "--model", "slim", "--listen", "modbus-tcp://:0"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("carries lines of text"), std::string::npos) << refused.errors;
}

}  // namespace modbus_tcp_test
}  // namespace understudy::acceptance
