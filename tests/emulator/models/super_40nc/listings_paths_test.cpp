// The manual's listings of interpolated moves on the whole controller: where and when each line ends, and
// that arcs keep to their circles.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace listings_paths_test {

const Set kOfC{{"D9003", 4}};
const Set kInXy{{"D9003", 4},
                {"D9016", 0}};  // these listings name no plane, and C23 is YZ in the factory settings

struct Arc {
  double centre_x, centre_y;  // in LU, like the others
  double radius;
  double sweep_degrees;  // positive: counter-clockwise
  std::size_t first = 0, second = 1;
};

/// Seen from its centre, a path keeps its distance, turns in one direction, and turns as far as it should.
void expect_arc(const Places& from, const Lap& lap, const Arc& arc) {
  const auto angle = [&](const Places& at) {
    return std::atan2(static_cast<double>(at[arc.second]) - arc.centre_y,
                      static_cast<double>(at[arc.first]) - arc.centre_x);
  };
  double swept = 0;
  double last = angle(from);
  for (const Places& at : lap.course) {
    const double distance = std::hypot(static_cast<double>(at[arc.second]) - arc.centre_y,
                                       static_cast<double>(at[arc.first]) - arc.centre_x);
    ASSERT_NEAR(distance, arc.radius, 1);
    const double turned = std::remainder(angle(at) - last, 2 * M_PI);
    ASSERT_GE(turned * arc.sweep_degrees, -0.02 * M_PI);  // one pulse at rest
    swept += turned;
    last = angle(at);
    for (std::size_t other = 0; other < 4; ++other) {
      if (other != arc.first && other != arc.second) {
        ASSERT_EQ(at[other], from[other]);
      }
    }
  }
  EXPECT_NEAR(swept * 180 / M_PI, arc.sweep_degrees, 0.01);
}

void m1(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  one.set("D400", 20'000);
  const double path = 152'643;
  expect_legs(one, 0,
              {{1, move_s(path, 50'000), {80'000, 120'000, -50'000, 0}}, {6, move_s(path, 20'000), {}}});
}

void m2(const std::string& program) {
  OneSuper40nc one({.set = Set{{"D9003", 4}, {"D9028", 50}}, .program = program});
  const Places ends[] = {{12'150, 35'500, 1500, 22'300},
                         {12'150, 35'500, -12'000, 65'000},
                         {12'150, 36'000, -12'000, 65'000},
                         {}};
  const auto distance = [](const Places& a, const Places& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += std::pow(static_cast<double>(a[i] - b[i]), 2);
    return std::sqrt(sum);
  };
  expect_legs(one, 0,
              {{0, move_s(distance({}, ends[0]), 10'000), ends[0]},
               {5, move_s(distance(ends[0], ends[1]), 20'000), ends[1]},
               {9, move_s(500, 20'000), ends[2]},
               {13, move_s(distance(ends[2], ends[3]), 20'000), ends[3]}});
  EXPECT_TRUE(one.on("Y8"));  // of the last line
  one.run(60);
  EXPECT_FALSE(one.on("Y8"));
  one.set("M8000", 1);
  for (int line = 0; line < 4; ++line) {
    const Pulse pulse = pulse_of(one, "Y8");
    EXPECT_EQ(pulse.lasts, 50) << line;
  }
  EXPECT_FALSE(one.on("M8000"));
}

void m3(const std::string& program) {
  OneSuper40nc one({.set = kInXy, .program = program});
  const Places begin{20'000, 25'000, 0, 0};
  const Places end{48'000, 25'000, 0, 0};
  const auto found = expect_legs(one, 0, {{1, 0.715, begin}, {5, 0.955, end}, {9, 1.319, end}});
  expect_arc(begin, found.at(1), {34'000, 25'000, 14'000, 180});
  expect_arc(end, found.at(2), {55'000, 32'000, 7000 * std::sqrt(2.0), -360});
  const auto lowest = std::min_element(found[1].course.begin(), found[1].course.end(),
                                       [](const Places& a, const Places& b) { return a[1] < b[1]; });
  EXPECT_NEAR(static_cast<double>((*lowest)[1]), 11'000, 1);
}

void m4(const std::string& program) {
  OneSuper40nc one({.set = kInXy, .program = program});
  const Places begin{20'000, 25'000, 0, 0};
  const Places end{65'000, 80'000, 0, 0};
  const auto found = expect_legs(
      one, 0, {{1, 0.715, begin}, {5, move_s(88'165, 50'000), end}, {9, move_s(97'374, 50'000), begin}});
  expect_arc(begin, found.at(1), {56'057.3, 41'407.6, 39'614.9, -127.514});
  expect_arc(end, found.at(2), {35'777.8, 58'000, 36'577.8, -152.527});
}

void m5(const std::string& program) {
  OneSuper40nc one({.set = kInXy, .program = program});
  const Places begin{20'000, 15'000, 0, 0};
  const Places end{30'000, 23'000, 0, 0};
  const auto length = [](double degrees) { return degrees / 180 * M_PI * 10'000; };
  const auto found = expect_legs(one, 0,
                                 {{1, move_s(25'000, 50'000), begin},
                                  {5, move_s(length(280.370), 50'000), end},
                                  {9, move_s(length(79.630), 50'000), begin}});
  expect_arc(begin, found.at(1), {20'201.6, 24'998.0, 10'000, -280.370});
  expect_arc(end, found.at(2), {29'798.4, 13'002.0, 10'000, 79.630});
}

void m6(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  const double arc_s = move_s(M_PI * 12'000, 10'000);
  const Places ends[] = {{14'000, 18'000, 0, 0}, {38'000, 18'000, 0, 0}, {62'000, 18'000, 0, 0}};
  const auto found = expect_legs(
      one, 0,
      {{0, move_s(std::hypot(14'000, 18'000), 10'000), ends[0]}, {5, arc_s, ends[1]}, {10, arc_s, ends[2]}});
  expect_arc(ends[0], found.at(1), {26'000, 18'000, 12'000, 180});
  expect_arc(ends[1], found.at(2), {50'000, 0, 12'000, -180, 0, 2});
}

/// Pressed once each, both ways of writing it move in the same way.
void m7(const std::string& program) {
  OneSuper40nc one({.program = program});
  const auto press = [&](const char* button, double x_s, double y_s, const Places& end) {
    one.set(button, 1);
    const Tick begin = one.now();
    one.run(1);
    const Tick x = 1 + one.run_while("M8120");
    const Tick y = one.now() - begin + one.run_while("M8220");
    EXPECT_NEAR(static_cast<double>(x), x_s * 1000, kTolerance_ms) << button;
    EXPECT_NEAR(static_cast<double>(y), std::max(x_s, y_s) * 1000, kTolerance_ms) << button;
    EXPECT_EQ(positions(one), end);
    one.run(500);  // it is held down
    EXPECT_EQ(positions(one), end);
    one.set(button, 0);
    one.run(2);
  };
  press("M100", drive_s(2200, 100), drive_s(1500, 150), {2200, 1500, 0, 0});
  press("M101", drive_s(800, 100), drive_s(1500, 150), {3000, 3000, 0, 0});
}

void m8a(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  expect_legs(one, 0,
              {{1, move_s(std::hypot(22'000, 20'000), 10'000), {22'000, 20'000, 0, 0}},
               {5, move_s(8000, 10'000), {22'000, 12'000, 0, 0}},
               {9, move_s(20'000, 10'000), {42'000, 12'000, 0, 0}},
               {13, move_s(11'000, 10'000), {42'000, 23'000, 0, 0}}});
}
void m8b(const std::string& program) {
  m8a(program);
  std::string printed = program;  // two operands have lost their conditions
  printed.replace(printed.find("K-8000"), 6, "K8000");
  printed.replace(printed.find("LIN K20000\n"), 11, "LIN K2000\n");
  OneSuper40nc one({.set = kOfC, .program = printed});
  expect_legs(one, 0,
              {{1, move_s(std::hypot(22'000, 20'000), 10'000), {22'000, 20'000, 0, 0}},
               {5, move_s(8000, 10'000), {22'000, 28'000, 0, 0}},
               {9, move_s(2000, 10'000), {24'000, 28'000, 0, 0}},
               {13, move_s(11'000, 10'000), {24'000, 39'000, 0, 0}}});
}

constexpr Listing kListings[] = {{"M1", m1}, {"M2", m2},  {"M3", m3},  {"M4", m4},   {"M5", m5},
                                 {"M6", m6}, {"M7a", m7}, {"M7b", m7}, {"M8a", m8a}, {"M8b", m8b}};

class PathListing : public testing::TestWithParam<Listing> {};
TEST_P(PathListing, DoesWhatTheManualSays) { GetParam().holds(sample(GetParam().name)); }
INSTANTIATE_TEST_SUITE_P(Of, PathListing, testing::ValuesIn(kListings), name_of_listing);

TEST(PathListings, AreAllHere) { expect_all_of('M', 1, 8, kListings); }

}  // namespace listings_paths_test
}  // namespace understudy::emulator::models::super_40nc
