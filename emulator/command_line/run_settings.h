// Settings of `run` that follow from several flags.
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
/// Throws UsageError if two flags contradict each other.
void require_flags_that_agree(const RunArguments& arguments);

/// Returns everything on which the result of a case depends besides its sources: the program's version, and
/// the command with the contents of the files that it names.
std::string maker_of(const RunArguments& arguments);
/// Returns the hash of a case's sources and of the program that ran it.
std::uint64_t made_of(const play::CaseList& case_list, std::size_t file, const std::string& maker);

}  // namespace understudy::emulator::command_line
