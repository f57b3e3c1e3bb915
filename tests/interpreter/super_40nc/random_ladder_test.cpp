// Ladders from random expressions, compiled in two ways and compared with the expression itself: by blocks
// alone, and by contacts in series and in parallel, branches and relays wherever they are possible.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/interpreter/program_counts.h"
#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace random_ladder_test {

using Random = std::mt19937;

struct Expression {
  enum class Kind { contact, comparison, both, either, opposite } kind;
  Operand contact = {};
  int relation = 0;  // of a comparison: in kSigns
  Operand first = {};
  Operand second = {};
  std::unique_ptr<Expression> left = {};
  std::unique_ptr<Expression> right = {};
};
using Tree = std::unique_ptr<Expression>;

constexpr const char* kSigns[] = {"=", ">", "<", "<>", "<=", ">="};

Tree make(Expression::Kind kind) {
  auto made = std::make_unique<Expression>();
  made->kind = kind;
  return made;
}

int below(Random& random, int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); }

Operand random_contact(Random& random) {
  switch (below(random, 6)) {
    case 0: return y(below(random, 4));
    case 1: return m(below(random, 4));
    case 2: return t(below(random, 3));
    case 3: return c(below(random, 3));
    case 4: return m(8020 + below(random, 3));
    default: return x(below(random, 8));
  }
}

Operand random_value(Random& random) {
  switch (below(random, 5)) {
    case 0: return {Letter::k, below(random, 5) - 2};
    case 1: return t(below(random, 3));
    case 2: return c(below(random, 3));
    case 3: return d(8020 + below(random, 3));
    default: return d(below(random, 4));
  }
}

/// Its depth limits the blocks that are open at once.
Tree random_tree(Random& random, int depth) {
  if (depth == 0 || below(random, 5) == 0) {
    Tree leaf = make(below(random, 3) == 0 ? Expression::Kind::comparison : Expression::Kind::contact);
    leaf->contact = random_contact(random);
    leaf->relation = below(random, 6);
    leaf->first = random_value(random);
    leaf->second = random_value(random);
    return leaf;
  }
  const int kind = below(random, 5);
  Tree tree = make(kind < 2    ? Expression::Kind::both
                   : kind == 4 ? Expression::Kind::opposite
                               : Expression::Kind::either);
  tree->left = random_tree(random, depth - 1);
  if (tree->kind != Expression::Kind::opposite) tree->right = random_tree(random, depth - 1);
  return tree;
}

bool holds(int relation, std::int32_t a, std::int32_t b) {
  switch (relation) {
    case 0: return a == b;
    case 1: return a > b;
    case 2: return a < b;
    case 3: return a != b;
    case 4: return a <= b;
    default: return a >= b;
  }
}

bool truth(const Expression& e, ScriptedMachine& machine) {
  switch (e.kind) {
    case Expression::Kind::contact: return machine.contact(e.contact);
    case Expression::Kind::comparison:
      return holds(e.relation, machine.value(e.first), machine.value(e.second));
    case Expression::Kind::both: return truth(*e.left, machine) && truth(*e.right, machine);
    case Expression::Kind::either: return truth(*e.left, machine) || truth(*e.right, machine);
    case Expression::Kind::opposite: return !truth(*e.left, machine);
  }
  return false;
}

bool is_leaf(const Expression& e) {
  return e.kind == Expression::Kind::contact || e.kind == Expression::Kind::comparison;
}

/// A leaf as a contact: `word` is LD, AND or OR.
std::string leaf(const Expression& e, const std::string& word, bool inverted = false) {
  if (e.kind == Expression::Kind::contact) {
    const std::string opposite = word == "LD" ? "LDI" : word == "AND" ? "ANI" : "ORI";
    return (inverted ? opposite : word) + " " + text_of(e.contact) + "\n";
  }
  constexpr int kOpposites[] = {3, 4, 5, 0, 1, 2};
  const std::string prefix = word == "AND" ? "AD" : word;
  return prefix + kSigns[inverted ? kOpposites[e.relation] : e.relation] + " " + text_of(e.first) + " " +
         text_of(e.second) + "\n";
}

/// Each part a block, joined by ANB and ORB; INV for the opposite.
std::string by_blocks(const Expression& e) {
  if (is_leaf(e)) return leaf(e, "LD");
  if (e.kind == Expression::Kind::opposite) return by_blocks(*e.left) + "INV\n";
  return by_blocks(*e.left) + by_blocks(*e.right) + (e.kind == Expression::Kind::both ? "ANB\n" : "ORB\n");
}

/// Contacts wherever they are possible, with negations pushed down to them, and sometimes a branch or a
/// relay.
class ByContacts {
 public:
  explicit ByContacts(Random& random) : random_(random) {}

  std::string of(const Expression& e, bool inverted = false) {
    if (is_leaf(e)) return leaf(e, "LD", inverted);
    if (e.kind == Expression::Kind::opposite) return of(*e.left, !inverted);
    const bool is_series = (e.kind == Expression::Kind::both) != inverted;
    const std::string text = of(*e.left, inverted) + detour();
    if (is_leaf(*e.right)) return text + leaf(*e.right, is_series ? "AND" : "OR", inverted);
    return text + of(*e.right, inverted) + (is_series ? "ANB\n" : "ORB\n");
  }

 private:
  /// Leaves the result unchanged.
  std::string detour() {
    const std::string relay = "M" + std::to_string(100 + below(random_, 50));
    switch (below(random_, 8)) {
      case 0: return "OUT " + relay + "\n";
      case 1: return "MPS\nAND X7\nOUT " + relay + "\nMPP\n";
      case 2: return "MPS\nINV\nMRD\nANI X6\nOUT " + relay + "\nMPP\n";
      case 3: return "INV\nINV\n";
      case 4: return "NOP\n";
      default: return "";
    }
  }
  Random& random_;
};

void change(Random& random, ScriptedMachine& machine) {
  for (int i = 0; i < 8; ++i) machine.set(x(i), random() % 2 != 0);
  for (int i = 0; i < 4; ++i) {
    machine.set(y(i), random() % 2 != 0);
    machine.set(m(i), random() % 2 != 0);
    machine.write(d(i), below(random, 5) - 2);
  }
  for (int i = 0; i < 3; ++i) {
    machine.set(t(i), random() % 2 != 0);
    machine.set(c(i), random() % 2 != 0);
    machine.write(t(i), below(random, 5) - 2);
    machine.write(c(i), below(random, 5) - 2);
    machine.set_special_contact(8020 + i, random() % 2 != 0);
    machine.registers[8020 + i] = below(random, 5) - 2;
  }
}

/// Returns whether a contact of a listing conducts, by its words.
bool conducts(const Instruction& line, ScriptedMachine& machine) {
  const std::string text = text_of(line);
  const std::string word = text.substr(0, text.find(' '));
  const std::size_t sign = word.find_first_of("<>=");
  if (sign == std::string::npos) return machine.contact(line.fields[0]) == !word.ends_with("I");
  for (int relation = 0; relation < 6; ++relation) {
    if (word.substr(sign) == kSigns[relation])
      return holds(relation, machine.value(line.fields[0]), machine.value(line.fields[1]));
  }
  return false;
}

/// Adds what a scan does to a ladder whose contacts no line switches.
void count_scan(const AreaProgram& program, ScriptedMachine& machine, LineTally& counts) {
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    const std::string text = text_of(program.lines[i]);
    if (text == "NOP") continue;
    LineCount& count = counts[{5, static_cast<int>(i)}];
    ++count.runs;
    const std::string word = text.substr(0, 2);
    const bool is_join = text == "ANB" || text == "ORB";
    const bool is_contact = word == "LD" || word == "AN" || word == "AD" || word == "OR";
    if (is_contact && !is_join) count.decide(conducts(program.lines[i], machine));
    if (text == "END") return;
  }
}

TEST(Super40ncRandomLadder, TwoWaysEqualTheExpression) {
  constexpr int kExpressions = 10000;
  int longest = 0;
  int on = 0;
  for (int seed = 0; seed < kExpressions; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const Tree tree = random_tree(random, 1 + seed % 6);
    const std::string text =
        "AREA PLC\n" + by_blocks(*tree) + "OUT Y20\n" + ByContacts(random).of(*tree) + "OUT Y21\nEND\n";
    const Checked checked = check(text);
    ASSERT_TRUE(checked.program) << seed << "\n" << text << to_string(checked.errors.at(0));
    Running plc(text);
    ProgramCounts counts;
    LineTally expected_counts;
    plc.machine.set_watch(&counts);
    plc.run_plc();
    longest = std::max(longest, static_cast<int>(std::count(text.begin(), text.end(), '\n')));
    for (int round = 0; round < 8; ++round) {
      change(random, plc.machine);
      const bool expected = truth(*tree, plc.machine);
      count_scan(*checked.program->area(Area::plc), plc.machine, expected_counts);
      plc.scan();
      ASSERT_EQ(plc.machine.contact(y(20)), expected) << seed << "\n" << list(*checked.program);
      ASSERT_EQ(plc.machine.contact(y(21)), expected) << seed << "\n" << list(*checked.program);
      on += expected ? 1 : 0;
    }
    ASSERT_EQ(counts.lines, expected_counts) << seed << "\n" << list(*checked.program);
  }
  EXPECT_GT(longest, 80);
  EXPECT_GT(on, kExpressions);
  EXPECT_LT(on, 7 * kExpressions);
}

}  // namespace random_ladder_test
}  // namespace understudy::interpreter::super_40nc
