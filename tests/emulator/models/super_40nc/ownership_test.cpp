// Which motion gets an axis: the one that moves X keeps it. Each holder with each request, by host, keys, PLC
// and step programs, cell by cell. The manual says that a DRV waits for the one before it (《CHK 指令》),
// that VDRV 0 ends any motion (《VDRV 指令》), and what stops programs; the rest of the table is our reading.
#include <gtest/gtest.h>

#include <functional>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace ownership_test {

// The letters of a cell:
//   s starts    w waits until X is free, then does its own    v void: nothing changes, code 21
//   g continues until both have released it    n new speed or ratio
//   r comes to rest with a ramp    x stops at once    c and C's motion as well    . nothing happens, and no
//   code
//   - two programs have no LIN of one axis
constexpr const char* kAsks[] = {"jog +",   "jog -",   "HOME",   "ZERO", "wheel",   "D8020",
                                 "LIN",     "DRV",     "HOM",    "MRK",  "VDRV",    "MPG",
                                 "PLC DRV", "PLC HOM", "VDRV 0", "STP",  "STP of C"};
struct Row {
  const char* held_by;
  const char* cells;  // one for each of kAsks

  friend std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.held_by; }
};
// clang-format off
constexpr Row kTable[] = {
    // held by, and requested as in kAsks
    {"nobody",         "ssssssssssssss..."},
    {"jog",            "gvvvvvwwwwwwvvrx."},
    {"PJG",            "gvvvvvwwwwwwvvrx."},
    {"HOME",           "vvvvvvwwwwwwvvrx."},
    {"HOM",            "vvvvvvwwwwwwvvrxc"},
    {"ZERO",           "vvvvvvwwwwwwvvrx."},
    {"DRV",            "vvvvvvwwwwwwvvrxc"},
    {"LIN",            "vvvvvv-wwwwwvvrxc"},
    {"MRK",            "vvvvvvwwwwwwvvrxc"},
    {"PLC DRV",        "vvvvvvwwwwwwvvrx."},
    {"held DRV",       "vvvvvvwwwwwwvvrxc"},
    {"held LIN",       "vvvvvv-wwwwwvvrxc"},
    {"VDRV",           "vvvvvvvvvvnvvvrxc"},
    {"wheel",          "vvvv.vvvvvvvvvrx."},
    {"wheel by D8020", "vvvvv.vvvvvvvvrx."},
    {"MPG",            "vvvvvvvvvvvnvvrxc"},
};
// clang-format on
static_assert(std::size(kAsks) == 17);

constexpr const char* kPlc =
    "AREA PLC\nLD M201\nPJG K1\nLD M202\nMJG K1\nLD M203\nHOM K1\nLD M204\nDRV K777\nLD M207\nDRV K555\nLD "
    "M205\nSTP K1\n"
    "LD M206\nSTP * * * *\nEND\n";

/// As a line of a step program; empty if there is none.
std::string line_of(const std::string& what) {
  if (what.starts_with("held ")) return line_of(what.substr(5));
  for (const auto& [name, line] : {std::pair{"DRV", "DRV K20000"},
                                   {"LIN", "LIN K20000"},
                                   {"HOM", "HOM K1"},
                                   {"MRK", "MRK K20000"},
                                   {"VDRV", "VDRV K150"},
                                   {"VDRV 0", "VDRV K0"},
                                   {"MPG", "MPG K3"}}) {
    if (what == name) return line;
  }
  return "";
}
bool is_line(const std::string& what) { return !line_of(what).empty(); }

/// X is held by one of them; the other one requests it. C has LIN, so the line belongs to C.
struct Areas {
  char holds = 'C';
  char asks = 'X';
};
Areas areas_of(const std::string& held_by, const std::string& ask) {
  const bool x_holds = ask == "LIN" && held_by != "LIN" && held_by != "held LIN";
  return x_holds ? Areas{'X', 'C'} : Areas{};
}
const char* contact_of(char area) { return area == 'C' ? "M8000" : "M8100"; }

class Bench {
 public:
  Bench(const std::string& held_by, const std::string& ask)
      : held_by_(held_by), ask_(ask), areas_(areas_of(held_by, ask)), one_(given()) {
    one_.set("D8117", 50'000);
    one_.set("D9190", 400);  // X16, which MRK needs
    owned_by(areas_.holds);
    one_.run(2);
  }

  OneSuper40nc& one() { return one_; }
  const char* asking_program() const { return contact_of(areas_.asks); }
  const char* holding_program() const { return contact_of(areas_.holds); }
  bool is_held_by_c() const { return is_line(held_by_) && areas_.holds == 'C'; }

  void hold() {
    if (is_line(held_by_)) {
      one_.set(holding_program(), 1);
    } else if (const char* contact = contact_that_holds()) {
      one_.set(contact, 1);
    }
    one_.run(400);
    if (held_by_.starts_with("held ")) one_.press(areas_.holds == 'C' ? "M8006" : "M8588");
    one_.run(100);
    owned_by(is_line(ask_) ? areas_.asks : 'X');
    EXPECT_EQ(one_.on("M8120"), held_by_ != "nobody") << held_by_;
    EXPECT_EQ(one_.get("D8094"), 0) << held_by_;
  }
  void ask() {
    if (is_line(ask_)) return one_.set(asking_program(), 1);
    for (const auto& [name, contact] : {std::pair{"jog +", "M8103"},
                                        {"jog -", "M8104"},
                                        {"HOME", "M8105"},
                                        {"ZERO", "M8106"},
                                        {"wheel", "M8109"},
                                        {"D8020", "D8020"},
                                        {"PLC DRV", "M204"},
                                        {"PLC HOM", "M203"},
                                        {"STP", "M205"},
                                        {"STP of C", "M206"}}) {
      if (ask_ != name) continue;
      one_.set(held_by_ == ask_ || (held_by_ == "jog" && ask_ == "jog +") ? again(contact) : contact, 1);
    }
  }
  /// The holder releases the axis, or ends on its own.
  void let_go() {
    if (const char* contact = contact_that_holds()) one_.set(contact, 0);
    if (held_by_.starts_with("held ")) one_.set(holding_program(), 1);
    if (held_by_ == "VDRV" || held_by_ == "MPG") one_.press("M8102");
  }

  /// Its edges, one per tick.
  void turn_wheel(int counts) {
    for (int i = 0; i < counts; ++i) {
      one_.input("MPG", ++turned_);
      one_.run(1);
    }
    one_.run(1);
  }

 private:
  Given given() const {
    Given given{.program = kPlc};
    for (const auto& [area, what, marker] :
         {std::tuple{areas_.holds, held_by_, "SET M61"}, {areas_.asks, ask_, "SET M60"}}) {
      given.program += std::string("AREA ") + area + "\n" + line_of(what) + "\n" + marker + "\nEND\n";
    }
    world::PlantSetup plant;
    plant.home = world::PulseSpan{40'000, 60'000};
    plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
    given.plant[0] = plant;
    return given;
  }
  /// The same through another contact, if its own is ON already.
  static const char* again(const std::string& contact) {
    for (const auto& [one, other] :
         {std::pair{"M8103", "M201"}, {"M8105", "M8568"}, {"M8106", "M8572"}, {"M204", "M207"}}) {
      if (contact == one) return other;
    }
    return "M8109";
  }
  void owned_by(char area) { one_.set("D9003", area == 'C' ? 1 : 0); }
  const char* contact_that_holds() const {
    for (const auto& [name, contact] : {std::pair{"jog", "M8103"},
                                        {"PJG", "M201"},
                                        {"HOME", "M8105"},
                                        {"ZERO", "M8106"},
                                        {"PLC DRV", "M204"},
                                        {"wheel", "M8109"},
                                        {"wheel by D8020", "D8020"}}) {
      if (held_by_ == name) return contact;
    }
    return nullptr;
  }

  std::string held_by_;
  std::string ask_;
  Areas areas_;
  OneSuper40nc one_;
  std::int32_t turned_ = 0;
};

constexpr Value kTaken = 21;

/// The motion of X is the same as without the request.
void expect_undisturbed(Bench& asked, Bench& left_alone, const std::string& cell) {
  for (Bench* bench : {&asked, &left_alone}) bench->turn_wheel(3);
  EXPECT_EQ(asked.one().get("D8140"), left_alone.one().get("D8140")) << cell;
  EXPECT_EQ(asked.one().on("M8120"), left_alone.one().on("M8120")) << cell;
  EXPECT_EQ(asked.one().on("M8197"), left_alone.one().on("M8197")) << cell;
  EXPECT_EQ(asked.one().device().axes()->speed_pps(0), left_alone.one().device().axes()->speed_pps(0))
      << cell;
}

/// The line of the requesting program has been executed, in its own way.
void expect_done(Bench& bench, const std::string& ask, const std::string& cell) {
  OneSuper40nc& one = bench.one();
  for (Tick tick = 0; tick < 30'000 && !one.on("M60"); ++tick) one.run(1);
  EXPECT_TRUE(one.on("M60")) << cell;
  EXPECT_EQ(one.get("D8094"), 0) << cell;
  if (ask == "DRV" || ask == "LIN") {
    EXPECT_EQ(one.get("D8117"), 20'000) << cell;
  } else if (ask == "MRK") {
    EXPECT_EQ(one.get("D8117"), 20'400) << cell;
  } else if (ask == "HOM") {
    EXPECT_TRUE(one.on("M8195")) << cell;
  } else if (ask == "VDRV") {
    one.run(100);
    EXPECT_NEAR(one.device().axes()->speed_pps(0), pps_of(150), 1) << cell;
  } else if (ask == "MPG") {
    const Value before = one.get("D8117");
    bench.turn_wheel(5);
    EXPECT_EQ(one.get("D8117"), before + 15) << cell;
  }
}

void expect_cell(const std::string& held_by, const std::string& ask, char says) {
  if (says == '-') return;
  const std::string cell = held_by + " against " + ask;
  Bench asked(held_by, ask);
  Bench left_alone(held_by, ask);
  for (Bench* bench : {&asked, &left_alone}) bench->hold();
  OneSuper40nc& one = asked.one();
  const Value stood = one.get("D8140");
  asked.ask();
  for (Bench* bench : {&asked, &left_alone}) bench->one().run(1);
  const bool may_stop_c = says == 'c' && asked.is_held_by_c();
  switch (says) {
    case 'c':
      if (!may_stop_c) return;  // X's program holds it
      [[fallthrough]];
    case 'x':
      EXPECT_EQ(one.get("D8140"), stood) << cell;
      EXPECT_FALSE(one.on("M8120")) << cell;
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      EXPECT_FALSE(one.on(asked.holding_program())) << cell;
      one.run(500);
      asked.turn_wheel(3);
      EXPECT_EQ(one.get("D8140"), stood) << cell;
      break;
    case '.':
      for (Bench* bench : {&asked, &left_alone}) bench->one().run(100);
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      expect_undisturbed(asked, left_alone, cell);
      break;
    case 'v':
      EXPECT_EQ(one.get("D8094"), kTaken) << cell;
      for (Bench* bench : {&asked, &left_alone}) bench->one().run(100);
      if (is_line(ask)) {
        EXPECT_TRUE(one.on("M60")) << cell << ": the program continues";
      }
      expect_undisturbed(asked, left_alone, cell);
      for (Bench* bench : {&asked, &left_alone}) {
        bench->let_go();  // a level that is still ON needs a new edge
        bench->one().run(12'000);
      }
      expect_undisturbed(asked, left_alone, cell);
      break;
    case 'w':
      for (Bench* bench : {&asked, &left_alone}) bench->one().run(100);
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      EXPECT_FALSE(one.on("M60")) << cell;
      EXPECT_TRUE(one.on(asked.asking_program())) << cell;
      expect_undisturbed(asked, left_alone, cell);
      asked.let_go();
      expect_done(asked, ask, cell);
      break;
    case 's':
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      EXPECT_TRUE(one.on("M8120")) << cell;
      if (is_line(ask)) expect_done(asked, ask, cell);
      break;
    case 'g': {
      for (Bench* bench : {&asked, &left_alone}) bench->one().run(100);
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      expect_undisturbed(asked, left_alone, cell);
      asked.let_go();
      one.run(300);
      EXPECT_EQ(one.on("M8120"), true) << cell << ": the other one is still checked";
      const char* other = held_by == "jog" ? "M201" : "M8103";
      one.set(other, 0);
      one.run(100);
      EXPECT_FALSE(one.on("M8120")) << cell;
      break;
    }
    case 'n':
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      expect_done(asked, ask, cell);
      break;
    case 'r':
      one.run(100);
      EXPECT_FALSE(one.on("M8120")) << cell;
      EXPECT_TRUE(one.on("M60")) << cell;
      EXPECT_FALSE(one.on("M8195") || one.on("M8196")) << cell;
      EXPECT_EQ(one.get("D8094"), 0) << cell;
      break;
    default: ADD_FAILURE() << cell << " says " << says;
  }
}

class Super40ncOwnership : public testing::TestWithParam<Row> {};

TEST_P(Super40ncOwnership, IsAsTheTableSays) {
  const Row& row = GetParam();
  ASSERT_EQ(std::string(row.cells).size(), std::size(kAsks)) << row.held_by;
  for (std::size_t i = 0; i < std::size(kAsks); ++i) expect_cell(row.held_by, kAsks[i], row.cells[i]);
}
INSTANTIATE_TEST_SUITE_P(HeldBy, Super40ncOwnership, testing::ValuesIn(kTable), [](const auto& row) {
  std::string name;
  for (const char letter : std::string(row.param.held_by)) {
    if (letter != ' ') name += letter;
  }
  return name;
});

TEST(Super40ncOwnership, TheFirstWheelContactKeepsItsAxis) {
  const char* const contacts[] = {"M8108", "M8109", "M8110", "D8020"};
  const Value lengths[] = {1, 10, 100, 1};
  for (std::size_t first = 0; first < 4; ++first) {
    for (std::size_t second = 0; second < 4; ++second) {
      if (first == second) continue;
      OneSuper40nc one;
      one.set(contacts[first], 1);
      one.run(2);
      one.set(contacts[second], 1);
      one.run(2);
      EXPECT_EQ(one.get("D8094"), kTaken) << contacts[first] << ", " << contacts[second];
      one.input("MPG", 1);
      one.run(2);
      EXPECT_EQ(one.get("D8117"), lengths[first]) << contacts[first] << ", " << contacts[second];
    }
  }
}

/// The keys of the panel request like their contacts; M8x02, M8002 and the STOP key stop everything.
TEST(Super40ncOwnership, KeysAskAsTheirContactsDo) {
  for (const Row& row : kTable) {
    const std::string held_by = row.held_by;
    for (const auto& [key, ask] : {std::pair{"M8560", 0}, {"M8561", 1}, {"M8568", 2}, {"M8572", 3}}) {
      const bool is_its_own = (held_by == "jog" && ask == 0) || (held_by == "HOME" && ask == 2) ||
                              (held_by == "ZERO" && ask == 3);
      if (is_its_own) continue;  // its contact is already ON
      Bench bench(held_by, "jog +");
      bench.hold();
      bench.one().set(key, 1);
      bench.one().run(1);
      const char says = row.cells[static_cast<std::size_t>(ask)];
      EXPECT_EQ(bench.one().get("D8094"), says == 'v' ? kTaken : 0) << held_by << " against " << key;
      EXPECT_TRUE(bench.one().on("M8120")) << held_by << " against " << key;
    }
    for (const auto& [stop, code] : {std::pair{"M8102", 0}, {"M8584", 0}, {"M8002", 19}}) {
      Bench bench(held_by, "jog +");
      bench.hold();
      const Value stood = bench.one().get("D8140");
      bench.one().set(stop, 1);
      bench.one().run(1);
      EXPECT_EQ(bench.one().get("D8140"), stood) << held_by << ", " << stop;
      EXPECT_FALSE(bench.one().on("M8120")) << held_by << ", " << stop;
      const bool is_home = held_by == "HOME" || held_by == "HOM";
      EXPECT_EQ(bench.one().get("D8094"), code) << held_by << ", " << stop << (is_home ? ", home" : "");
    }
  }
}

}  // namespace ownership_test
}  // namespace understudy::emulator::models::super_40nc
