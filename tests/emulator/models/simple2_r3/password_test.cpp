// The program's password (manual, 附錄 C; firmware 1.51 and later): while PROG_UNLOCK is 0, every cell of the
// program reads as 0, so a backup of it is empty, and NEW_PWD is void.
#include "emulator/device/memory/persistent_memory.h"
#include "tests/emulator/models/simple2_r3/switched_simple2.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::simple2_r3 {
namespace password_test {

constexpr std::size_t kPwdInput = 0xFF07;
constexpr std::size_t kUnlock = 0xFF08;
constexpr std::size_t kNewPwd = 0xFF09;

/// Reached over Modbus.
struct Locked : Switched {
  using Switched::Switched;

  world::Words words(std::size_t address, std::size_t count = 1) {
    return world::read(device(), address, count);
  }
  void write_word(std::size_t address, std::size_t word) {
    const world::Bytes request = world::write_request(address, word);
    EXPECT_EQ(world::answer(device(), request), world::text(request))
        << "the reply is always the ordinary one";
  }
  bool unlocked() { return words(kUnlock) == world::Words{1}; }
  /// A password that is kept, and the lock as after power-up.
  void lock_with(std::uint16_t password) {
    write_word(kNewPwd, password);
    run(6);
    cycle();
    EXPECT_FALSE(unlocked());
  }
  world::Words backup() {
    world::Words all;
    for (std::size_t line = 0; line < 256; line += 16) {
      const world::Words some = words(0x4000 + 4 * line, 64);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
};

world::Words filled_program() {
  world::Words cells;
  for (int i = 0; i < 1024; ++i) cells.push_back(static_cast<std::uint16_t>(1 + i % 255));
  return cells;
}

void load(Locked& feeder, const world::Words& cells) {
  for (std::size_t first = 0; first < cells.size(); first += 120) {
    const std::size_t count = std::min<std::size_t>(120, cells.size() - first);
    feeder.write(static_cast<std::uint16_t>(0x4000 + first),
                 world::Words(cells.begin() + static_cast<std::ptrdiff_t>(first),
                              cells.begin() + static_cast<std::ptrdiff_t>(first + count)));
  }
}

TEST(Password, IsNoneFromTheFactory) {
  Locked feeder;
  EXPECT_EQ(feeder.words(kPwdInput, 3), (world::Words{0, 1, 0}));
  load(feeder, filled_program());
  EXPECT_EQ(feeder.backup(), filled_program());
  feeder.cycle();
  EXPECT_TRUE(feeder.unlocked());
}

TEST(Password, MakesABackupEmptyUntilItIsEntered) {
  Locked feeder;
  load(feeder, filled_program());
  feeder.run(6000);
  feeder.lock_with(1234);
  EXPECT_EQ(feeder.backup(), world::Words(1024, 0));
  feeder.write_word(kPwdInput, 1234);
  EXPECT_TRUE(feeder.unlocked());
  EXPECT_EQ(feeder.backup(), filled_program());
}

TEST(Password, HidesTheProgramFromEveryWayOfReading) {
  Locked feeder;
  load(feeder, filled_program());
  feeder.run(6000);
  feeder.lock_with(7);
  EXPECT_EQ(world::answer(feeder.device(), world::read_pdu(0x04, 0x4000, 3)), "04 06 00 00 00 00 00 00");
  EXPECT_EQ(feeder.words(0x43FF), world::Words{0});
  EXPECT_EQ(feeder.get("MAIN_LINE255_JMP"), 0);
  for (const char* open : {"PROG_MEM0", "PROG_VAR0", "Parms_Speed1"}) {
    feeder.set(open, 5);
    EXPECT_EQ(feeder.get(open), 5) << open << " is not protected";
  }
}

TEST(Password, DoesNotHideTheProgramFromTheInterpreter) {
  Locked feeder;
  load(feeder, {0x05, 2, 1, 0, 0x02, 50, 0, 0, 0x05, 3, 1, 0, 0xFF, 0, 0, 0});
  feeder.run(200);
  feeder.lock_with(9);
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.run(20);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x04);
  EXPECT_EQ(feeder.words(0x4000, 16), world::Words(16, 0)) << "while it runs";
  EXPECT_EQ(feeder.get("PROG_MAIN_NowLine"), 1);
  feeder.run(60);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x0C);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status"));
}

TEST(Password, IsOpenedByItselfAloneAndClosedByAnythingElse) {
  for (const std::uint16_t password : {1, 0x00FF, 0x0100, 0x8000, 0xFFFF}) {
    Locked feeder;
    feeder.lock_with(password);
    for (const int wrong : {0, password - 1, (password + 1) & 0xFFFF, password ^ 0x8000, password ^ 1}) {
      feeder.write_word(kPwdInput, static_cast<std::size_t>(wrong));
      EXPECT_FALSE(feeder.unlocked()) << password << " " << wrong;
      feeder.write_word(kPwdInput, password);
      EXPECT_TRUE(feeder.unlocked()) << password;
    }
    feeder.write_word(kPwdInput, 0);
    EXPECT_FALSE(feeder.unlocked());
  }
}

TEST(Password, NewOneIsVoidWhileItIsLocked) {
  Locked feeder;
  feeder.lock_with(1234);
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{0}) << "it is not reported";
  feeder.write_word(kNewPwd, 5555);
  feeder.write_word(kNewPwd, 0);
  EXPECT_FALSE(feeder.bit("EEPROM_Writing")) << "no part of it is stored";
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{0});
  for (const std::size_t wrong : {5555, 0}) {
    feeder.write_word(kPwdInput, wrong);
    EXPECT_FALSE(feeder.unlocked());
  }
  feeder.run(100);
  feeder.cycle();
  EXPECT_FALSE(feeder.unlocked());
  feeder.write_word(kPwdInput, 1234);
  EXPECT_TRUE(feeder.unlocked());
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{1234}) << "a client with the token can read it";
}

TEST(Password, NewOneDoesNotShutOutWhoSetsIt) {
  Locked feeder;
  feeder.write_word(kNewPwd, 4321);
  EXPECT_TRUE(feeder.unlocked());
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{4321});
  feeder.write_word(kNewPwd, 8765);
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{8765});
  feeder.write_word(kPwdInput, 4321);
  EXPECT_FALSE(feeder.unlocked()) << "the old one is no longer good";
  feeder.write_word(kPwdInput, 8765);
  EXPECT_TRUE(feeder.unlocked());
}

TEST(Password, OutlivesThePowerAndItsInputDoesNot) {
  Locked feeder;
  feeder.lock_with(1234);
  feeder.write_word(kPwdInput, 1234);
  EXPECT_TRUE(feeder.unlocked());
  feeder.cycle(100);
  EXPECT_FALSE(feeder.unlocked());
  EXPECT_EQ(feeder.words(kPwdInput), world::Words{0});
}

TEST(Password, IsKeptLikeAnyWordInFiveMilliseconds) {
  for (const Tick cut : {5, 6}) {  // kept in tick 6
    Locked feeder;
    feeder.write_word(kNewPwd, 1234);
    feeder.run_to(cut);
    feeder.cycle();
    EXPECT_EQ(feeder.unlocked(), cut < 6) << cut;
  }
}

TEST(Password, OfZeroLocksNothingAfterPowerUp) {
  Locked feeder;
  feeder.lock_with(77);
  feeder.write_word(kPwdInput, 77);
  feeder.write_word(kNewPwd, 0);
  feeder.run(10);
  feeder.cycle();
  EXPECT_TRUE(feeder.unlocked());
}

TEST(Password, LetsProgramsBeWrittenStartedAndErasedWhileLocked) {
  Locked feeder;
  load(feeder, filled_program());
  feeder.run(6000);
  feeder.lock_with(3);
  feeder.write(0x4000, {0x05, 6, 1, 0, 0xFF, 0, 0, 0});
  EXPECT_EQ(feeder.words(0x4000, 4), world::Words(4, 0));
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.run(10);
  EXPECT_TRUE(feeder.bit("DOUT_6"));
  feeder.run(100);
  feeder.cycle();
  feeder.write_word(kPwdInput, 3);
  EXPECT_EQ(feeder.words(0x4000, 8), (world::Words{0x05, 6, 1, 0, 0xFF, 0, 0, 0}))
      << "and the written value is kept";
  feeder.write_word(kPwdInput, 0);
  feeder.set("PROG_MAIN_Erase_ALL", 1);
  feeder.write_word(kPwdInput, 3);
  EXPECT_EQ(feeder.backup(), world::Words(1024, 0));
}

TEST(Password, APartialLineWriteWhileLockedChangesOnlyItsCells) {
  Locked feeder;
  load(feeder, {1, 2, 3, 4});
  feeder.run(100);
  feeder.lock_with(3);
  feeder.write(0x4001, {9});
  feeder.write_word(kPwdInput, 3);
  EXPECT_EQ(feeder.words(0x4000, 4), (world::Words{1, 9, 3, 4}));
}

TEST(Password, FactoryResetTakesItAway) {
  Locked feeder;
  feeder.lock_with(1234);
  feeder.set("Factory_Reset", 1);
  EXPECT_TRUE(feeder.unlocked());
  EXPECT_EQ(feeder.words(kNewPwd), world::Words{0});
  EXPECT_EQ(feeder.backup(), world::Words(1024, 0)) << "and the program with it";
  feeder.run(501);
  feeder.cycle();
  EXPECT_TRUE(feeder.unlocked());
}

TEST(Password, OfAFactoryResetThatLostItsPowerIsStillThere) {
  Locked feeder;
  feeder.lock_with(1234);
  feeder.set("Factory_Reset", 1);
  feeder.run(500);
  feeder.cycle();
  EXPECT_FALSE(feeder.unlocked());
}

TEST(Password, RegistersAreRefusedWhereTheMapSaysSo) {
  Locked feeder;
  EXPECT_EQ(world::answer(feeder.device(), world::write_request(kUnlock, 1)), "86 02")
      << "PROG_UNLOCK is read-only";
  EXPECT_EQ(world::answer(feeder.device(), world::write_request(kPwdInput, {1, 1, 1})), "90 02");
  EXPECT_EQ(feeder.words(kPwdInput, 3), (world::Words{0, 1, 0}));
}

TEST(Password, IsNoneBefore151WhoeverSetOneLater) {
  for (const Firmware firmware : {139, 140, 141, 142, 150}) {
    Locked feeder({.firmware = firmware});
    load(feeder, {1, 2, 3, 4});
    for (const std::size_t address : {kPwdInput, kUnlock, kNewPwd}) {
      EXPECT_EQ(world::answer(feeder.device(), world::read_pdu(0x03, address, 1)), "83 02") << firmware;
      EXPECT_EQ(world::answer(feeder.device(), world::write_request(address, 1)), "86 02") << firmware;
    }
    feeder.run(100);
    feeder.cycle();
    EXPECT_EQ(feeder.words(0x4000, 4), (world::Words{1, 2, 3, 4})) << firmware;
  }
  // A memory with a password in a device whose firmware has none: open, and the password still there for a
  // firmware that has.
  DeviceSettings settings;
  settings.nv = NvImage{
      .model = "simple2-r3", .firmware = "1.52", .registers = {{"MAIN_LINE0_CMD", 5}, {"NEW_PWD", 1234}}};
  settings.firmware = 150;
  const auto old = world::make_simple2(settings);
  EXPECT_EQ(world::read(*old, 0x4000, 1), world::Words{5});
  settings.nv = old->memory()->nv_image();
  settings.firmware = 151;
  EXPECT_EQ(world::read(*world::make_simple2(settings), 0x4000, 1), world::Words{0});
}

}  // namespace password_test
}  // namespace understudy::emulator::models::simple2_r3
