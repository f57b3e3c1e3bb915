// The last writer in a scan: host, PLC, keys, then C, X, Y, Z and U, and finally the system. Each pair of
// writers of a contact and of a register, and the result for command contacts.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace writers_test {

/// In their order.
constexpr const char* kWriters[] = {"host", "PLC", "C", "X", "Y", "Z", "U"};
bool is_program(const std::string& writer) { return writer.size() == 1; }

/// In the scan that M60 comes ON in.
struct Write {
  std::string writer;
  Value value;
};

std::string line_of(const std::string& item, Value value) {
  if (item[0] == 'D') return "MOV K" + std::to_string(value) + " " + item;
  return (value != 0 ? "SET " : "RST ") + item;
}

/// The register after the scan in which all of them have written it.
Value value_behind(const std::string& item, const std::vector<Write>& writes, const Set& set = {}) {
  std::string text;
  for (const Write& write : writes) {
    const std::string line = line_of(item, write.value) + "\n";
    if (is_program(write.writer)) text += "AREA " + write.writer + "\nWAT M60\n" + line + "TMR K9\nEND\n";
    if (write.writer == "PLC") text += "AREA PLC\nLD M60\n" + line + "END\n";
  }
  OneSuper40nc one({.set = set, .program = text});
  for (const Write& write : writes) {
    const std::size_t number = std::string("CXYZU").find(write.writer);
    if (is_program(write.writer)) one.set("M8" + std::to_string(number) + "00", 1);
  }
  one.run(3);
  for (const Write& write : writes) {
    if (write.writer == "host") one.set(item, write.value);
  }
  one.set("M60", 1);
  one.run(1);
  return one.get(item);
}

TEST(Super40ncWriters, TheLaterOneWins) {
  for (const std::string item : {"Y20", "M20", "M450", "D20", "D600", "D8117", "D8005", "D8023", "D9190"}) {
    const bool is_register = item[0] == 'D';
    for (std::size_t first = 0; first < std::size(kWriters); ++first) {
      for (std::size_t second = first + 1; second < std::size(kWriters); ++second) {
        for (const Value value : {0, 1}) {
          const Value other = is_register ? value + 70 : 1 - value;
          EXPECT_EQ(value_behind(item, {{kWriters[first], other}, {kWriters[second], value}}), value)
              << item << ": " << kWriters[first] << ", " << kWriters[second];
        }
      }
    }
  }
}

TEST(Super40ncWriters, AllAtOnceLeaveTheLast) {
  std::vector<Write> all;
  for (const char* writer : kWriters) {
    all.push_back({writer, static_cast<Value>(all.size()) + 1});
    EXPECT_EQ(value_behind("D20", all), all.back().value);
  }
}

TEST(Super40ncWriters, SignalsBelongToTheSystem) {
  struct Signal {
    const char* output;
    const char* time;
  };
  for (const auto& [output, time] :
       {Signal{"Y0", "D9191"}, {"Y3", "D9491"}, {"Y4", "D9192"}, {"Y8", "D9028"}, {"Y9", "D9029"}}) {
    for (const char* writer : kWriters) {
      EXPECT_EQ(value_behind(output, {{writer, 1}}), 1) << output << ", " << writer << ": 0 ms is the user's";
      EXPECT_EQ(value_behind(output, {{writer, 1}}, {{time, 20}}), 0) << output << ", " << writer;
    }
  }
}

/// The values read in a scan: an earlier line of another program has acted already.
TEST(Super40ncWriters, TheNextReaderSeesWhatWasWritten) {
  OneSuper40nc one({.program =
                        "AREA PLC\nLD M60\nINC D1\nMOV D1 D2\nEND\nAREA C\nLAB K1\nMOV D2 D3\nJMP K1\nEND\n"
                        "AREA U\nLAB K1\nMOV D3 D4\nJMP K1\nEND\n"});
  one.set("M8000", 1);
  one.set("M8400", 1);
  one.set("M60", 1);
  one.run(5);
  for (int scan = 0; scan < 20; ++scan) {
    one.run(1);
    EXPECT_EQ(one.get("D3"), one.get("D1"));
    EXPECT_EQ(one.get("D4"), one.get("D1"));
  }
}

// --- command contacts --------------------------------------------------------------------------------------

/// A level counts as the PLC has left it; an edge over the wire still counts.
TEST(Super40ncWriters, ThePlcClearsLevelsButNoEdges) {
  OneSuper40nc one({.program = "AREA PLC\nLD M1\nOUT M8103\nOUT M8105\nEND\n"});
  one.run(2);
  one.set("M8103", 1);
  one.run(2);
  EXPECT_FALSE(one.on("M8103"));
  EXPECT_FALSE(one.on("M8120"));
  one.set("M8105", 1);
  one.run(1);
  EXPECT_FALSE(one.on("M8105"));
  EXPECT_TRUE(one.on("M8197"));
}

TEST(Super40ncWriters, AKeyWinsOverThePlc) {
  OneSuper40nc one({.program = "AREA PLC\nLD M1\nOUT M8103\nEND\n"});
  one.run(2);
  one.set("M8560", 1);
  one.run(50);
  EXPECT_TRUE(one.on("M8103"));
  EXPECT_TRUE(one.on("M8120"));
  one.set("M8560", 0);
  one.run(20);
  EXPECT_FALSE(one.on("M8103"));
  EXPECT_FALSE(one.on("M8120"));
}

TEST(Super40ncWriters, StopsComeBeforeStarts) {
  const char* const kStops[] = {"M8002", "M8102", "M8584"};
  const char* const kStarts[] = {"M8103", "M8105", "M8106", "M8108", "M8100"};
  for (const char* stop : kStops) {
    for (const char* start : kStarts) {
      OneSuper40nc one({.program = "AREA X\nDRV K5000\nEND\n"});
      one.set("D8117", 500);
      one.set(start, 1);
      one.set(stop, 1);
      one.run(1);
      EXPECT_FALSE(one.on("M8120")) << stop << ", " << start;
      EXPECT_EQ(one.get("D8094"), std::string(stop) == "M8002" ? 19 : 0) << stop << ", " << start;
      one.run(20);
      EXPECT_FALSE(one.on("M8120")) << stop << ", " << start;
    }
  }
}

TEST(Super40ncWriters, TheMainStopKeyComesBeforeItsStart) {
  OneSuper40nc one({.set = Set{{"D9003", 1}}, .program = "AREA C\nLIN K5000\nEND\n"});
  one.set("M8000", 1);
  one.set("M8596", 1);
  one.run(3);
  EXPECT_FALSE(one.on("M8000") || one.on("M8120"));
}

/// PLC HOM takes its axis before the contacts do; ZERO SET comes before HOME, HOME before ZERO, ZERO before
/// jog.
TEST(Super40ncWriters, ContactsAreObeyedInTheirOrder) {
  struct Case {
    std::vector<std::string> contacts;
    const char* runs;  // a status contact, or none
    Value code;
  };
  for (const Case& each : {Case{{"M1", "M8103"}, "M8197", 21}, Case{{"M8103", "M8105"}, "M8197", 21},
                           Case{{"M8106", "M8105"}, "M8197", 21}, Case{{"M8103", "M8106"}, "M8198", 21},
                           Case{{"M8108", "M8103"}, nullptr, 21}, Case{{"M8103", "M8104"}, nullptr, 21}}) {
    OneSuper40nc one({.program = "AREA PLC\nLD M1\nHOM K1\nEND\n"});
    one.set("D8117", 5000);
    one.run(2);
    for (const std::string& contact : each.contacts) one.set(contact, 1);
    one.run(1);
    const std::string what = each.contacts[0] + ", " + each.contacts[1];
    EXPECT_TRUE(one.on("M8120")) << what;
    for (const char* status : {"M8197", "M8198", "M8199"}) {
      EXPECT_EQ(one.on(status), each.runs != nullptr && std::string(status) == each.runs) << what << status;
    }
    EXPECT_EQ(one.on("M8144"), std::string(each.runs == nullptr ? "" : each.runs) == "M8198")
        << what << ": jog + comes before jog -";
    EXPECT_EQ(one.get("D8094"), each.code) << what;
  }
  OneSuper40nc one;
  one.set("D8117", 5000);
  one.set("M8107", 1);
  one.set("M8106", 1);
  one.run(1);
  EXPECT_TRUE(one.on("M8196")) << "ZERO SET came first, so it is already there";
  EXPECT_EQ(one.get("D8117"), 0);
}

/// A program later in the order of a scan starts in it, an earlier one in the next.
TEST(Super40ncWriters, StrStartsWithinTheScanOrBehindIt) {
  const std::string areas = "CXYZU";
  for (std::size_t by = 0; by < areas.size(); ++by) {
    for (std::size_t of = 0; of < areas.size(); ++of) {
      if (by == of) continue;
      std::string fields = " * * * *";
      if (of > 0) fields.replace(2 * of - 1, 1, "K1");
      OneSuper40nc one({.program = std::string("AREA ") + areas[by] + "\nWAT M60\nSTR" + fields +
                                   "\nEND\nAREA " + areas[of] + "\nINC D1\nTMR K50\nEND\n"});
      one.set("M8" + std::to_string(by) + "00", 1);
      one.run(3);
      one.set("M60", 1);
      one.run(1);
      EXPECT_TRUE(one.on("M8" + std::to_string(of) + "00"));
      EXPECT_EQ(one.get("D1"), of > by ? 1 : 0) << areas[by] << " starts " << areas[of];
      one.run(1);
      EXPECT_EQ(one.get("D1"), 1) << areas[by] << " starts " << areas[of];
    }
  }
}

/// A host switches M8100 OFF while the PLC's SET has it ON: the PLC is later; a program's END later still.
TEST(Super40ncWriters, RunContactsFollowTheSameOrder) {
  OneSuper40nc one({.program = "AREA PLC\nLD M1\nSET M8100\nEND\nAREA X\nTMR K20\nEND\n"});
  one.set("M1", 1);
  one.run(5);
  EXPECT_TRUE(one.on("M8100"));
  one.set("M8100", 0);
  one.run(1);
  EXPECT_TRUE(one.on("M8100"));
  int scans_off = 0;
  for (int scan = 0; scan < 100; ++scan) {
    one.run(1);
    scans_off += one.on("M8100") ? 0 : 1;
  }
  EXPECT_GT(scans_off, 2) << "END has precedence in its scan";
  EXPECT_LT(scans_off, 10) << "SET starts it again in the next";
}

}  // namespace writers_test
}  // namespace understudy::emulator::models::super_40nc
