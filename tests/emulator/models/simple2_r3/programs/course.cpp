#include "tests/emulator/models/simple2_r3/programs/course.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>

#include "emulator/device/axes.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/world/stations/server.h"
#include "interpreter/simple2/listing.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/simple2_r3/programs/course_text.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

using Words = std::vector<std::uint16_t>;
using Bytes = std::vector<std::uint8_t>;

constexpr Tick kTickBeforeStart = 999;  // so slot 0 is tick 1000: also a multiple of the 5 ms of sync mode
constexpr std::size_t kMaxWritten = 123;
constexpr std::size_t kMaxRead = 125;
constexpr std::uint16_t kFirstCell = 0x4000;

// --- the host ------------------------------------------------------------------------------------

Bytes reply_to(OneSimple2& box, const Bytes& pdu) {
  const world::ModbusReply reply = world::serve(box.device(), pdu);
  return {reply.pdu.begin(), reply.pdu.begin() + static_cast<std::ptrdiff_t>(reply.size)};
}

Bytes request(std::uint8_t function, std::size_t first, std::size_t second) {
  return {function, static_cast<std::uint8_t>(first >> 8), static_cast<std::uint8_t>(first),
          static_cast<std::uint8_t>(second >> 8), static_cast<std::uint8_t>(second)};
}

void write_by_frame(OneSimple2& box, std::size_t first, std::span<const std::uint16_t> words) {
  Bytes pdu = request(0x10, first, words.size());
  const Bytes wanted = pdu;  // the reply: function, address, quantity
  pdu.push_back(static_cast<std::uint8_t>(2 * words.size()));
  for (const std::uint16_t word : words) {
    pdu.push_back(static_cast<std::uint8_t>(word >> 8));
    pdu.push_back(static_cast<std::uint8_t>(word));
  }
  EXPECT_EQ(reply_to(box, pdu), wanted) << "at " << first;
}

void write_by_frame(OneSimple2& box, std::string_view name, Value value) {
  PreparedWrite write;
  const auto place = box.device().register_bank()->find(name);
  ASSERT_TRUE(place) << name;
  ASSERT_EQ(prepare_value(*box.device().register_bank(), *place, value, write), Refusal::none)
      << name << " = " << value;
  if (write.count == 2) return write_by_frame(box, write.first, write.words);
  const Bytes pdu = request(0x06, write.first, write.words[0]);
  EXPECT_EQ(reply_to(box, pdu), pdu) << name << " = " << value;
}

Words read_by_frame(OneSimple2& box, std::size_t first, std::size_t count) {
  const Bytes reply = reply_to(box, request(0x03, first, count));
  Words words;
  for (std::size_t i = 2; i + 1 < reply.size(); i += 2) {
    words.push_back(static_cast<std::uint16_t>(reply[i] << 8 | reply[i + 1]));
  }
  return words;
}

Words cells_of(const std::string& listing) {
  std::ifstream file(std::string(TEST_FACTS "/models/simple2_r3/programs/") + listing);
  EXPECT_TRUE(file) << listing;
  std::ostringstream text;
  text << file.rdbuf();
  const interpreter::simple2::Assembly assembly = interpreter::simple2::assemble(text.str());
  for (const auto& error : assembly.errors) ADD_FAILURE() << listing << ":" << to_string(error);
  Words cells;
  for (const auto& line : assembly.lines.value_or(interpreter::simple2::Lines{})) {
    cells.insert(cells.end(), {line.command, line.data1, line.data2, line.flag});
  }
  return cells;
}

void load(OneSimple2& box, const std::string& listing) {
  const Words cells = cells_of(listing);
  for (std::size_t at = 0; at < cells.size(); at += kMaxWritten) {
    write_by_frame(box, kFirstCell + at,
                   std::span(cells).subspan(at, std::min(kMaxWritten, cells.size() - at)));
  }
  Words back;
  while (back.size() < cells.size()) {
    const Words more =
        read_by_frame(box, kFirstCell + back.size(), std::min(kMaxRead, cells.size() - back.size()));
    ASSERT_FALSE(more.empty());
    back.insert(back.end(), more.begin(), more.end());
  }
  EXPECT_EQ(back, cells) << listing;
}

// --- looking -------------------------------------------------------------------------------------

/// One look at the device.
struct View {
  Value status = 0;
  Value outputs = 0;
  Value line = 0;
  bool runs = false;
  std::array<Value, 2> coordinates{};
  std::array<Value, 2> counters{};
  std::array<Value, 2> modes{};
  std::vector<Value> watched;
};

View look(const OneSimple2& box, const std::vector<std::string>& watched) {
  View view{.status = box.get("STATUS"),
            .outputs = box.get("DOUT_ALL"),
            .line = box.get("PROG_MAIN_NowLine"),
            .runs = box.get("PROG_MAIN_RunTime_Status") != 0,
            .coordinates = {box.get("Cord_A"), box.get("Cord_B")},
            .counters = {box.get("Counter1_Value"), box.get("Counter2_Value")},
            .modes = {box.get("Aaxis_Mode"), box.get("Baxis_Mode")},
            .watched = {}};
  for (const std::string& name : watched) view.watched.push_back(box.get(name));
  return view;
}

std::string at(Value coordinate) { return "@" + std::to_string(coordinate); }

void compare_outputs(const View& before, const View& after, std::set<std::string>& events) {
  for (int i = 0; i < 7; ++i) {
    const Value bit = Value{1} << i;
    if (((before.outputs ^ after.outputs) & bit) == 0) continue;
    events.insert(((after.outputs & bit) != 0 ? "+D" : "-D") + std::to_string(i));
  }
}

void compare_axis(std::size_t axis, const View& before, const View& after, std::set<std::string>& events) {
  constexpr std::array<const char*, 8> kBits{"alarm", "ready", "move",  "homing",
                                             "home",  "servo", "upper", "lower"};
  constexpr std::size_t kMove = 2;
  const std::string letter(1, axis == 0 ? 'A' : 'B');
  for (std::size_t i = 0; i < kBits.size(); ++i) {
    const Value bit = Value{1} << (2 * i + axis);
    if (((before.status ^ after.status) & bit) == 0) continue;
    std::string event = ((after.status & bit) != 0 ? "+" : "-") + std::string(kBits[i]) + letter;
    if (i == kMove) event += at(after.coordinates[axis]);
    events.insert(event);
  }
  const bool rests = ((before.status | after.status) & (Value{1} << (2 * kMove + axis))) == 0;
  if (rests && before.coordinates[axis] != after.coordinates[axis]) {
    events.insert("cord" + letter + "=" + std::to_string(after.coordinates[axis]));
  }
  if (before.modes[axis] != after.modes[axis]) {
    events.insert("mode" + letter + "=" + std::to_string(after.modes[axis]));
  }
  if (before.counters[axis] != after.counters[axis]) {
    events.insert("C" + std::to_string(axis + 1) + "=" + std::to_string(after.counters[axis]));
  }
}

std::set<std::string> compare(const View& before, const View& after,
                              const std::vector<std::string>& watched) {
  std::set<std::string> events;
  if (before.runs != after.runs) events.insert(after.runs ? "run" : "stop");
  if (before.line != after.line) events.insert("L" + std::to_string(after.line));
  compare_outputs(before, after, events);
  for (std::size_t axis = 0; axis < 2; ++axis) compare_axis(axis, before, after, events);
  for (std::size_t i = 0; i < watched.size(); ++i) {
    if (before.watched[i] == after.watched[i]) continue;
    events.insert(watched[i] + "=" + std::to_string(after.watched[i]));
  }
  return events;
}

// --- what the table asks for -----------------------------------------------------------------------

/// The registers that the table names, and the ms in which it asks where an axis is during a move.
struct Wishes {
  std::vector<std::string> watched;
  std::map<Tick, std::set<char>> samples;
};

Wishes wishes_of(const Course& wanted) {
  Wishes wishes;
  std::set<std::string> names;
  for (const auto& [ms, events] : wanted) {
    for (const std::string& event : events) {
      const std::string name = event.substr(0, event.find('='));
      if (name == event) continue;
      if (name == "A" || name == "B") {
        wishes.samples[ms].insert(name.front());
      } else if (std::isupper(static_cast<unsigned char>(name.front())) != 0 && name != "C1" &&
                 name != "C2") {
        names.insert(name);
      }
    }
  }
  wishes.watched.assign(names.begin(), names.end());
  return wishes;
}

// --- playing -------------------------------------------------------------------------------------

/// A box with the program running, and what is done to it in chronological order.
struct Stage {
  explicit Stage(const Play& given) : play(given), box(given.given) {
    for (const auto& some : play.deeds) deeds.insert(deeds.end(), some.begin(), some.end());
    std::stable_sort(deeds.begin(), deeds.end(), [](const Deed& a, const Deed& b) { return a.at < b.at; });
    for (const auto& [name, value] : play.host) write_by_frame(box, name, value);
    load(box, play.listing);
  }

  void go_to(Tick ms) { box.run_to(kTickBeforeStart + 1 + ms); }
  /// What comes from outside before tick `ms`.
  void do_deeds(Tick ms) {
    if (play.encoder_a) box.device().axes()->set_encoder(0, play.encoder_a(ms));
    for (; next < deeds.size() && deeds[next].at <= ms; ++next) deeds[next].does(box);
  }
  /// What happens before the program runs.
  void prepare() {
    const Tick first = deeds.empty() ? 0 : std::min<Tick>(deeds.front().at, 0);
    for (Tick ms = first; ms < 0; ++ms) {
      go_to(ms - 1);
      do_deeds(ms);
    }
    go_to(-1);
  }
  void start() { write_by_frame(box, "PROG_MAIN_RunTime_START", play.first_line); }

  const Play& play;
  OneSimple2 box;
  std::vector<Deed> deeds;
  std::size_t next = 0;
};

void play_and_look(Stage& stage, const Wishes& wishes, Course& course) {
  stage.prepare();
  View before = look(stage.box, wishes.watched);
  before.line = -1;  // so that the first line is reported as well
  stage.start();
  for (Tick ms = 0; ms <= stage.play.until; ++ms) {
    stage.do_deeds(ms);
    stage.go_to(ms);
    const View after = look(stage.box, wishes.watched);
    std::set<std::string> events = compare(before, after, wishes.watched);
    if (const auto wish = wishes.samples.find(ms); wish != wishes.samples.end()) {
      for (const char axis : wish->second) {
        events.insert(std::string(1, axis) + "=" + std::to_string(stage.box.coordinate(axis)));
      }
    }
    if (!events.empty()) course[ms] = events;
    before = after;
  }
}

void play_in_leaps(Stage& stage) {
  stage.prepare();
  stage.start();
  if (stage.play.encoder_a) {  // which moves all the time
    for (Tick ms = 0; ms <= stage.play.until; ++ms) {
      stage.do_deeds(ms);
      stage.go_to(ms);
    }
    return;
  }
  while (stage.next < stage.deeds.size() && stage.deeds[stage.next].at <= stage.play.until) {
    const Tick ms = stage.deeds[stage.next].at;
    stage.go_to(ms - 1);
    stage.do_deeds(ms);
  }
  stage.go_to(stage.play.until);
}

}  // namespace

Deed input_goes(Tick at, int number, bool on) {
  return {at, [number, on](OneSimple2& box) { box.input(number, on); }};
}

std::vector<Deed> input_is_on(Tick from, Tick to, int number) {
  return {input_goes(from, number, true), input_goes(to, number, false)};
}

Deed host_writes(Tick at, std::string_view name, Value value) {
  return {at, [name = std::string(name), value](OneSimple2& box) { write_by_frame(box, name, value); }};
}

void expect_course(const Play& play, std::string_view table) {
  const Course wanted = course_of_table(table);
  Stage stage(play);
  Course happened;
  play_and_look(stage, wishes_of(wanted), happened);
  if (const Tick differs = first_difference(wanted, happened); differs >= 0) {
    ADD_FAILURE() << play.listing << ": first difference at " << differs << " ms\ncalculated:\n"
                  << to_string(wanted, differs - 10, 12) << "happened:\n"
                  << to_string(happened, differs - 10, 12);
  }
  EXPECT_FALSE(wanted.empty());

  Stage leaping(play);
  play_in_leaps(leaping);
  EXPECT_TRUE(same_state(stage.box.device(), leaping.box.device())) << play.listing << ", with fast-forward";
}

}  // namespace understudy::emulator::models::simple2_r3
