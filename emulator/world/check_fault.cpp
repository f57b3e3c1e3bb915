#include "emulator/world/check_fault.h"
#include <cstddef>
#include <stdexcept>
#include <string>

#include "base/text/one_line.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/names/names.h"
#include "emulator/world/probe/probe_names.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

namespace {

using Kind = Fault::Kind;

}  // namespace

Expression parse_condition(const std::string& text, const NameResolver& names) {
  ExpressionParser parser(text, names);
  const Term term = parser.expression();
  parser.expect_end();
  if (term.unit != Unit::none) {
    throw NameError(quoted(text) + " is " + kind_of(term.unit) + "; expected a condition");
  }
  return parser.take();
}

void check_fault(const Inventory& inventory, const Fault& fault) {
  if (fault.kind == Kind::encoder_noise &&
      inventory.machine(fault.device, fault.place).encoder_counts_per_revolution == 0) {
    const KnownDevice& device = inventory.known()[fault.device];
    throw NameError(device.name + "." +
                    std::string(device.model->axes[static_cast<std::size_t>(fault.place)].name) +
                    " has no encoder; expected one in `plant`");
  }
  if (fault.kind == Kind::turn && !fault.of_input &&
      !inventory.machine(fault.device, fault.place).has_wheel) {
    const KnownDevice& device = inventory.known()[fault.device];
    throw NameError(device.name + "." +
                    std::string(device.model->axes[static_cast<std::size_t>(fault.place)].name) +
                    " has no hand wheel; expected `encoder: { on: wheel }` in `plant`");
  }
  const KnownDevice& known = inventory.known()[fault.device];
  protocol_of(*known.model).require_possible(known.name, fault);
  if (fault.trigger.when.empty()) return;
  try {
    check_condition(inventory, fault.trigger.when);
  } catch (const NameError& error) {
    throw FaultFieldError(std::string(fault_kind(fault.kind).name), "when", error.what());
  }
}

void check_condition(const Inventory& inventory, const std::string& when) {
  const ProbeNames names(inventory);
  try {
    const Expression condition = parse_condition(when, names);
    for (const Expression::Name& name : condition.names) {
      if (!names.is_of_scenarios(name.number.handle)) continue;
      throw NameError(quoted(name.spelling) +
                      " cannot be used in a fault; expected a value that the bench itself has");
    }
  } catch (const std::runtime_error& error) {
    throw NameError(error.what());
  }
}

}  // namespace understudy::emulator::world
