#include <charconv>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <system_error>

#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/text_argument.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"

// The Simple2-R3 program as text and back. Its cells are a line of four numbers for each line of the program,
// as a master writes them from 0x4000 on; what follows the last line that is not all zeros is left out.
namespace understudy::emulator::command_line {

namespace {

using interpreter::simple2::Line;
using interpreter::simple2::Lines;

/// Null, and one line on standard error, if it cannot be read.
FileText content_of(const std::string& file) {
  auto text = read_text_argument(file);
  if (!text) std::fprintf(stderr, "%s: %s; expected a file\n", file.c_str(), text.why.c_str());
  return text;
}

int refuse(const std::string& file, std::size_t line, const std::string& what) {
  std::fprintf(stderr, "%s:%zu: %s\n", file.c_str(), line, what.c_str());
  return kExitBadInput;
}

}  // namespace

int assemble_program(const std::string& file) {
  const auto text = content_of(file);
  if (!text) return kExitBadInput;
  const auto assembly = interpreter::simple2::assemble(*text);
  for (const auto& error : assembly.errors) {
    std::fprintf(stderr, "%s:%s\n", file.c_str(), to_string(error).c_str());
  }
  if (!assembly.lines) return kExitBadInput;
  std::size_t count = assembly.lines->size();
  while (count > 0 && (*assembly.lines)[count - 1] == Line{}) --count;
  for (std::size_t i = 0; i < count; ++i) {
    const Line& line = (*assembly.lines)[i];
    std::printf("%d %d %d %d\n", line.command, line.data1, line.data2, line.flag);
  }
  return kExitWell;
}

int disassemble_program(const std::string& file) {
  const auto text = content_of(file);
  if (!text) return kExitBadInput;
  Lines lines{};
  std::size_t next = 0;
  std::size_t number = 0;
  std::istringstream rows(*text);
  for (std::string row; std::getline(rows, row);) {
    ++number;
    std::istringstream words(row);
    std::string word;
    int cells[4] = {};
    std::size_t found = 0;
    for (; words >> word; ++found) {
      if (found == 4) return refuse(file, number, "more than four cells; expected CMD DATA1 DATA2 JMP");
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), cells[found]);
      if (error != std::errc{} || end != word.data() + word.size() || cells[found] < 0 ||
          cells[found] > 255) {
        return refuse(file, number, quoted(word) + " is not a cell; expected 0 to 255");
      }
    }
    if (found == 0) continue;
    if (found < 4) return refuse(file, number, "fewer than four cells; expected CMD DATA1 DATA2 JMP");
    if (next == lines.size()) return refuse(file, number, "one line too many; expected at most 256");
    const auto cell = [&](int i) { return static_cast<std::uint8_t>(cells[i]); };
    lines[next++] = {.command = cell(0), .data1 = cell(1), .data2 = cell(2), .flag = cell(3)};
  }
  std::fputs(interpreter::simple2::disassemble(lines).c_str(), stdout);
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
