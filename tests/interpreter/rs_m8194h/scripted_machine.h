// A controller for macros under test. Motion, inputs and readings are functions of the time; the actions of
// macros are recorded with their times.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/text.h"

namespace understudy::interpreter::rs_m8194h {

class ScriptedMachine : public Machine {
 public:
  const Macro* macro(const MacroName& name) const override {
    const auto found = macros.find(name);
    return found == macros.end() ? nullptr : &found->second;
  }
  std::int32_t variable(std::size_t number) const override { return variables.at(number); }
  void set_variable(std::size_t number, std::int32_t value) override { variables.at(number) = value; }
  std::uint8_t byte_variable(std::size_t number) const override { return byte_variables.at(number); }

  std::int32_t read(const Command& command) const override {
    const auto found = readings.find(text_of(command));
    return found == readings.end() ? 0 : found->second;
  }
  bool stand(std::uint32_t axes) const override { return (axes & moving) == 0; }
  bool frnet_input(std::uint32_t group, std::uint32_t channel) const override {
    return std::ranges::find(inputs, group * 16 + channel) != inputs.end();
  }
  Took carry_out(const Command& command) override {
    if (command.row().use.starts_motion && (command.values[0] & moving) != 0) return Took::waits;
    note(text_of(command).substr(std::string("RSM_MACRO_").size()));
    return Took::done;
  }

  int take_isr() override {
    if (isrs.empty() || isrs.front().first > now_ms) return 0;
    const int number = isrs.front().second;
    isrs.erase(isrs.begin());
    return number;
  }
  void mp_ended() override { note("end"); }
  void terminated() override { note("terminated"); }
  void report(const ExecutionFault& fault) override {
    note("fault " + std::to_string(row_of(fault.fault).download_error) + " " + to_string(fault.macro) +
         " line " + std::to_string(fault.line));
  }

  void note(const std::string& what) { log.push_back(std::to_string(now_ms) + " " + what); }

  /// Stores macros that are given as a listing.
  void store(const std::string& text) {
    ParsedListing parsed = parse_listing(text);
    for (const TextError& error : parsed.errors) ADD_FAILURE() << to_string(error) << "\n" << text;
    for (ListedMacro& listed : parsed.listing.macros) macros[listed.name] = listed.macro;
  }

  std::map<MacroName, Macro> macros;
  std::array<std::int32_t, kVariableCount> variables{};
  std::array<std::uint8_t, kByteVariableCount> byte_variables{};
  std::map<std::string, std::int32_t> readings;
  std::uint32_t moving = 0;                        // axes
  std::vector<std::uint32_t> inputs;               // 16 * group + channel of each input that is on
  std::vector<std::pair<std::int64_t, int>> isrs;  // the times and numbers of the ISRs
  std::int64_t now_ms = 0;
  std::vector<std::string> log;
};

}  // namespace understudy::interpreter::rs_m8194h
