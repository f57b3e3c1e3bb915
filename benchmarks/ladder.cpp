// Measures a scan of the SUPER-40NC's PLC: 1,000 mixed steps, compared with the simplest possible steps.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/plc.h"
#include "tests/interpreter/super_40nc/plain_machine.h"

namespace understudy::benchmarks {
namespace {

using namespace interpreter::super_40nc;

constexpr int kRounds = 31;
constexpr int kScans = 2000;

/// Rungs as people write them, 25 steps each: contacts, blocks, branches, edges, timers, counters, numbers.
std::string rungs(int count) {
  std::string text = "AREA PLC\n";
  for (int i = 0; i < count; ++i) {
    const auto number = [&](int first, int limit) { return std::to_string((i * 7 + first) % limit); };
    text += "LD X" + number(0, 24) + "\nOR M" + number(3, 300) + "\nANI X" + number(5, 24) + "\nOUT M" +
            number(3, 300) + "\nLD M" + number(1, 300) + "\nAND X" + number(2, 24) + "\nLDI M" +
            number(9, 300) + "\nANI Y" + number(4, 16) + "\nORB\nMPS\nAND T" + number(0, 50) + "\nOUT Y" +
            number(1, 16) + "\nMPP\nINV\nOUT T" + number(0, 50) + " K500\nLD> D" + number(0, 400) +
            " K20\nAND M" + number(7, 300) + "\nMOV K7 D" + number(1, 400) + "\nLDP X" + number(6, 24) +
            "\nOUT C" + number(2, 16) + " K9\n";
  }
  return text + "END\n";
}

template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

double seconds_of(const std::function<void()>& work) {
  const auto start = processor_time_here();
  work();
  return std::chrono::duration<double>(processor_time_here() - start).count();
}

/// Measures the simplest possible steps, which only load a cell by its number and combine it.
double bare_ns(const PlainMachine& machine, std::size_t steps) {
  std::vector<std::uint32_t> numbers(steps);
  for (std::size_t i = 0; i < steps; ++i)
    numbers[i] = static_cast<std::uint32_t>(i * 37 % machine.memory.size());
  return seconds_of([&] {
           for (int scan = 0; scan < kScans; ++scan) {
             std::uint32_t result = 1;
             for (const std::uint32_t number : numbers)
               result = (result ^ machine.memory[number]) & (number | 1);
             keep(result);
           }
         }) *
         1e9 / kScans / static_cast<double>(steps);
}

int run() {
  constexpr int kRungs = 40;
  const Checked checked = check(rungs(kRungs));
  if (!checked.program) {
    std::printf("%s\n", to_string(checked.errors.at(0)).c_str());
    return 2;
  }
  PlainMachine machine;
  NoPrograms programs;
  const Options options;
  const AreaProgram& program = *checked.program->area(Area::plc);
  std::size_t steps = 0;
  for (const Instruction& line : program.lines) steps += static_cast<std::size_t>(steps_of(line));
  const Ladder ladder(program, machine.layout(), options);
  PlcState plc;
  interpreter::super_40nc::run(plc, ladder, machine);
  std::vector<double> each;
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    const double bare = bare_ns(machine, steps);
    const double ns = seconds_of([&] {
                        for (int i = 0; i < kScans; ++i) {
                          for (int k = 0; k < 4; ++k)
                            machine.memory[static_cast<std::size_t>((i * 5 + k * 7) % 24)] ^= 1;
                          scan(plc, ladder, machine, programs, options);
                        }
                      }) *
                      1e9 / kScans / static_cast<double>(steps);
    each.push_back(ns);
    ratios.push_back(ns / bare);
  }
  std::printf("a scan of %zu mixed steps, changing inputs: %.2f ns per step, %.1f us in total\n", steps,
              median(each), median(each) * static_cast<double>(steps) / 1000);
  print_verdict("a step, relative to one that only loads and combines a cell", median(ratios), 4.0);
  return 0;
}

}  // namespace
}  // namespace understudy::benchmarks

int main() { return understudy::benchmarks::run(); }
