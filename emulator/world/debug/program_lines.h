// Finds the instructions for source lines in a device's program, and the source lines for instructions. The
// source is the bench's program if the device still contains it, otherwise the listing that is read from the
// device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/program_parts.h"
#include "emulator/world/debug/breakpoint.h"

namespace understudy::emulator::world {

class ProgramLines {
 public:
  /// An instruction as interpreters report it (base/program_watch.h).
  struct Instruction {
    int part = 0;
    int number = 0;
    bool operator==(const Instruction&) const = default;
  };

  /// The device must have power and support programs.
  explicit ProgramLines(const Device& device);

  /// Returns the path of the bench's file, or an empty text if the source is the listing.
  const std::string& source() const { return source_; }
  /// Returns the text to which the lines belong: the bench's program or the listing.
  const std::string& text() const { return text_; }
  /// Returns the lines that contain an instruction, in order.
  std::vector<int> lines() const;
  /// Returns the first line, from `line` on, that contains an instruction, or 0.
  int line_from(int line) const;
  /// Returns the last line that contains an instruction, or 0.
  int last_line() const;
  /// Returns the first instruction of each part on that line.
  std::vector<Instruction> at(int line) const;
  /// Returns the part with that name, or null. An empty name means the only part.
  const ProgramPart* find_part(const std::string& name) const;
  std::vector<std::string> part_names() const;
  /// Returns the parts. Their instructions are in order.
  const std::vector<ProgramPart>& parts() const { return parts_; }
  std::optional<InstructionPlace> place(Instruction instruction) const;
  /// Returns the source line for a line of the listing, or 0 if there is none.
  int source_line(int listing_line) const;

 private:
  void take_texts(std::string text);

  std::string source_;
  std::string text_;
  std::vector<std::string> texts_;    // the lines of the source, without surrounding blanks
  std::vector<ProgramPart> parts_;    // the parts of the source; of parts with the same number, the first
  std::vector<ProgramPart> listing_;  // the parts of the listing, in the same way
};

}  // namespace understudy::emulator::world
