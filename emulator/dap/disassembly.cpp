// Shows the instructions of programs with their addresses, and sets breakpoints at them. Controllers count
// instructions, not bytes: the upper half of an address is the number of a program, and the lower half is the
// number of an instruction.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

constexpr int kInstructionBits = 32;
constexpr std::int64_t kFirstProgram = 1;  // so that instructions before the first one have addresses, too
constexpr std::int64_t kMaxInstructions = 100'000;

std::string hex(std::int64_t address) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(address));
  return text;
}

}  // namespace

std::string Session::address_of(std::size_t device, const std::string& program, std::int64_t instruction) {
  std::size_t space = 0;
  while (space < spaces_.size() && (spaces_[space].device != device || spaces_[space].program != program))
    ++space;
  if (space == spaces_.size()) spaces_.push_back({device, program});
  return hex(((static_cast<std::int64_t>(space) + kFirstProgram) << kInstructionBits) + instruction);
}

Session::Address Session::parsed_address(const Json& arguments, const char* key) const {
  const std::string text = require_text(arguments, key);
  const auto address = parse_integer(text);
  const std::int64_t space = address ? (*address >> kInstructionBits) - kFirstProgram : -1;
  if (space < 0 || space >= static_cast<std::int64_t>(spaces_.size()))
    throw RequestError(std::string(key) + ": " + quoted(text) +
                       " is not an address; expected one from `stackTrace`");
  constexpr std::int64_t kLow = (std::int64_t{1} << kInstructionBits) - 1;
  return {static_cast<std::size_t>(space), (*address & kLow) + whole_or(arguments, "offset", 0)};
}

/// Returns as many entries as the client requests. Those outside the program are marked as invalid.
Json Session::disassemble(const Json& arguments) {
  const Address from = parsed_address(arguments, "memoryReference");
  const std::int64_t count = require_whole(arguments, "instructionCount");
  if (count < 0 || count > kMaxInstructions)
    throw RequestError("instructionCount: expected 0 to " + std::to_string(kMaxInstructions));
  const std::int64_t shift = whole_or(arguments, "instructionOffset", 0);
  if (shift < -kMaxInstructions || shift > kMaxInstructions)
    throw RequestError("instructionOffset: expected at most " + std::to_string(kMaxInstructions) +
                       " instructions before or after the address");
  const Thread space = spaces_[from.space];
  const Json reply =
      link_->ask({{"do", "source"}, {"device", devices_[space.device].name}, {"instructions", true}});
  Json code = Json::array();
  for (const Json& program : reply["programs"]) {
    if (text_or(program, "program") == space.program) code = program["instructions"];
  }
  const Json source = source_json(space.device);
  Json all = Json::array();
  for (std::int64_t i = from.instruction + shift; static_cast<std::int64_t>(all.size()) < count; ++i) {
    Json entry{{"address", address_of(space.device, space.program, i)}};
    if (i < 0 || i >= static_cast<std::int64_t>(code.size())) {
      entry["instruction"] = "";
      entry["presentationHint"] = "invalid";
      all.push_back(std::move(entry));
      continue;
    }
    const Json& one = code[static_cast<std::size_t>(i)];
    entry["instruction"] = one["code"];
    if (one.contains("cells")) {
      std::string numbers;
      for (const Json& cell : one["cells"]) numbers += (numbers.empty() ? "" : " ") + cell.dump();
      entry["instructionBytes"] = numbers;
    }
    if (i == 0 && !space.program.empty()) entry["symbol"] = space.program;
    if (const int line = one.value("line", 0); line > 0) {
      entry["location"] = source;
      entry["line"] = line - line_offset_;
    }
    all.push_back(std::move(entry));
  }
  return {{"instructions", std::move(all)}};
}

Json Session::set_instruction_breakpoints(const Json& arguments) {
  const Json& wanted = require_list(arguments, "breakpoints");
  delete_those(kInstructions);
  Json all = Json::array();
  for (const Json& one : wanted) {
    const int id = ++last_id_;
    try {
      const Address address = parsed_address(one, "instructionReference");
      const Thread& space = spaces_[address.space];
      Json message{
          {"do", "break"}, {"device", devices_[space.device].name}, {"instruction", address.instruction}};
      if (!space.program.empty()) message["program"] = space.program;
      add_common_fields(one, message);
      all.push_back(set_one(kInstructions, id, std::move(message)));
      all.back()["instructionReference"] = one["instructionReference"];
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError& error) {
      all.push_back({{"id", id}, {"verified", false}, {"message", error.what()}});
    }
  }
  return {{"breakpoints", std::move(all)}};
}

}  // namespace understudy::emulator::dap
