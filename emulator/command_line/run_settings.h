// Settings of `run` that depend on several flags.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "emulator/command_line/commands.h"
#include "emulator/play/performing/case_list.h"

namespace understudy::emulator::command_line {

/// Throws UsageError.
play::Shard shard_of(const RunArguments& arguments);
/// Returns how many cases run at a time. Throws UsageError.
int jobs_of(const RunArguments& arguments);
/// Throws UsageError if flags contradict each other.
void require_flags_that_agree(const RunArguments& arguments);

/// Returns everything that affects the result of a case except its sources: the program's version, and the
/// command with the contents of its files.
std::string maker_of(const RunArguments& arguments);
/// Returns the hash of a case's sources and of the program that ran it.
std::uint64_t made_of(const play::CaseList& case_list, std::size_t file, const std::string& maker);

}  // namespace understudy::emulator::command_line
