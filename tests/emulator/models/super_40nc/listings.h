// Runs the manual's 69 listings on the whole controller. A function for each listing checks what the manual
// says about it; a listing without one fails. Times are closed forms of the factory ramps.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <span>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {

using Set = std::vector<std::pair<std::string, Value>>;
using Places = std::array<Value, 4>;  // D8117, D8217, D8317, D8417

struct Listing {
  const char* name;
  void (*holds)(const std::string& program);

  friend std::ostream& operator<<(std::ostream& out, const Listing& listing) { return out << listing.name; }
};
inline std::string name_of_listing(const testing::TestParamInfo<Listing>& info) { return info.param.name; }

/// Checks that every file of a group, with these numbers, has a row.
inline void expect_all_of(char group, int first, int last, std::span<const Listing> rows) {
  std::set<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(std::string(PROJECT_FOLDER) +
                                                              "/tests/interpreter/super_40nc/samples")) {
    const std::string name = file.path().stem();
    const int number = std::stoi(name.substr(1));
    if (name.at(0) == group && number >= first && number <= last) files.insert(name);
  }
  std::set<std::string> names;
  for (const Listing& row : rows) names.insert(row.name);
  EXPECT_EQ(names, files);
}

// --- closed forms: 4000 pulses per revolution, 5000 rpm within 500 ms, a pulse is 0.001 mm ----------------
inline constexpr double kSlope = 5000 * 4000 / 60.0 / 0.5;
inline constexpr double kTolerance_ms = 3;

inline double pps_of(double rpm) { return rpm * 4000 / 60; }
/// Returns the time of a trapezoid, or of a triangle if the distance is too short.
inline double move_s(double distance, double speed) {
  return distance >= speed * speed / kSlope ? distance / speed + speed / kSlope
                                            : 2 * std::sqrt(distance / kSlope);
}
inline double drive_s(double distance, double rpm) { return move_s(distance, pps_of(rpm)); }

// --- observing ---------------------------------------------------------------------------------------------
inline Places positions(const OneSuper40nc& one) {
  return {one.get("D8117"), one.get("D8217"), one.get("D8317"), one.get("D8417")};
}

/// Switches a contact: "X3" from outside, everything else by a host's write. "T0" means the contact.
inline void put(OneSuper40nc& one, const std::string& contact, bool on) {
  if (contact[0] == 'X') {
    one.input(contact, on ? 1 : 0);
  } else {
    one.set(contact[0] == 'T' || contact[0] == 'C' ? "coil." + contact : contact, on ? 1 : 0);
  }
}

/// Steps through all states of some contacts, with a scan after each.
template <class Look>
void each_state(OneSuper40nc& one, const std::vector<std::string>& contacts, Look look) {
  for (unsigned states = 0; states < (1U << contacts.size()); ++states) {
    std::vector<bool> on;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      on.push_back((states >> i & 1U) != 0);
      put(one, contacts[i], on.back());
    }
    look(on);
  }
}

/// How long a step program stayed at one of its lines, in ticks.
struct Lap {
  Value step = 0;
  std::vector<Places> course{};
};

/// Starts program 0 (C) to 4 (U), and records its lines until it ends.
inline std::vector<Lap> laps(OneSuper40nc& one, int program, Tick at_most = 200'000) {
  const std::string contact = "M8" + std::to_string(program) + "00";
  const std::string pointer = "D8" + std::to_string(program) + "00";
  std::vector<Lap> all;
  one.set(contact, 1);
  for (Tick tick = 0; tick < at_most; ++tick) {
    one.run(1);
    if (!one.on(contact)) break;
    const Value step = one.get(pointer);
    if (all.empty() || all.back().step != step) all.push_back({.step = step});
    all.back().course.push_back(positions(one));
  }
  return all;
}

struct Leg {
  Value step;
  double seconds;
  Places end;
};

/// Checks that the motions of the named lines match in time and to the pulse. Returns them.
inline std::vector<Lap> expect_legs(OneSuper40nc& one, int program, const std::vector<Leg>& legs,
                                    Tick at_most = 200'000) {
  std::vector<Lap> found = laps(one, program, at_most);
  std::erase_if(found, [&](const Lap& lap) {
    return std::none_of(legs.begin(), legs.end(), [&](const Leg& leg) { return leg.step == lap.step; });
  });
  EXPECT_GE(found.size(), legs.size());
  for (std::size_t i = 0; i < std::min(found.size(), legs.size()); ++i) {
    EXPECT_EQ(found[i].step, legs[i].step) << "leg " << i;
    EXPECT_NEAR(static_cast<double>(found[i].course.size()), legs[i].seconds * 1000, kTolerance_ms)
        << "leg " << i << ", step " << legs[i].step;
    EXPECT_EQ(found[i].course.back(), legs[i].end) << "leg " << i << ", step " << legs[i].step;
  }
  return found;
}

/// The ticks until a contact is ON, and how many ticks it stays ON.
struct Pulse {
  Tick before = 0;
  Tick lasts = 0;
};
inline Pulse pulse_of(OneSuper40nc& one, const std::string& contact, Tick at_most = 100'000) {
  Pulse pulse;
  for (; !one.on(contact) && pulse.before < at_most; ++pulse.before) one.run(1);
  pulse.lasts = one.run_while(contact, at_most);
  return pulse;
}

/// Runs a program that ends immediately.
inline void run_through(OneSuper40nc& one, const char* contact) {
  one.set(contact, 1);
  one.run(6);
  EXPECT_FALSE(one.on(contact));
}

}  // namespace understudy::emulator::models::super_40nc
