#include "emulator/models/super_40nc/model.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/transition_tables.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/first_files.h"
#include "emulator/models/super_40nc/language.h"
#include "emulator/models/super_40nc/rows/choices.h"
#include "emulator/models/super_40nc/rows/parameters.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/terminals.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr std::array<Firmware, 1> kFirmwares{100};

constexpr std::array<std::string_view, 5> kKnownLimitations{
    ("The speed of an axis that is on a path or follows the hand wheel is compared at the end of each tick, "
     "and so are counters that count an encoder while the machine does not follow its pulses."),
    ("Changes of the CLR and LTC inputs take effect at the beginning of the next tick, unless a switch "
     "of the machine is wired to them."),
    ("An axis that follows the hand wheel moves by the sum of its counts in a tick, so turning it back "
     "and forth within a tick has no effect."),
    ("The chip's signals CSTA, CSTP, PCS, SD and DR are not modelled. Its ERC, CLR and LTC are "
     "modelled only with the choice `pins_fitted`."),
    ("The user table and the direct command of D8020, which the manual leaves unfinished, are plain "
     "storage unless a bench sets the choice `user_table`."),
};

constexpr std::array<int, 1> kBauds{19200};
constexpr pty::LineSettings kLine{.data_bits = 8, .parity = pty::Parity::even, .stop_bits = 1};
constexpr std::array<PortRow, 2> kPorts{
    PortRow{.kind = PortRow::Kind::rs232, .name = "RS232", .bauds = kBauds, .settings = kLine},
    PortRow{.kind = PortRow::Kind::rs485, .name = "RS485", .bauds = kBauds, .settings = kLine}};
constexpr std::array<std::uint8_t, 8> kFunctions{0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x0F, 0x10};
constexpr int kCharacterBits = 11;

constexpr MapPolicy kPolicy{.read_only = MapPolicy::ReadOnly::ignores_writes,
                            .out_of_range = MapPolicy::OutOfRange::stored};

constexpr std::array<std::string_view, 12> kStateRegisters{"D8117", "D8217", "D8317", "D8417",
                                                           "M8120", "M8220", "M8320", "M8420",
                                                           "M8000", "D8000", "D8094", "D8095"};

constexpr SectionRow kSections[] = {
    {"接點元件編號一覽表", "list of contacts"},
    {"暫存器元件編號一覽表", "list of registers"},
    {"M8 特殊接點的功用(一般用途)", "special contacts M8, general"},
    {"M8x 特殊接點的功用(XYZU 軸用)", "special contacts M8x, of the axes"},
    {"M85x 人機對應接點", "contacts M85x of the panel"},
    {"M86x 人機對應接點", "contacts M86x of the panel"},
    {"D8 特殊暫存器的功用(一般用途)", "special registers D8, general"},
    {"D8x 特殊暫存器的功用(XYZU 軸用)", "special registers D8x, of the axes"},
    {"D9 參數暫存器的功用(一般用)", "parameters D9, general"},
    {"D9x 參數暫存器的功用(XYZU 軸用)", "parameters D9x, of the axes"},
    {"ABSC , INCC 指令", "instructions ABSC, INCC"},
    {"ADD , SUB , MUL , DIV 指令", "instructions ADD, SUB, MUL, DIV"},
    {"CAL , RET 指令", "instructions CAL, RET"},
    {"CHK 指令", "instruction CHK"},
    {"CWR , CCWR 指令", "instructions CWR, CCWR"},
    {"Data 指令一覽表", "list of data instructions"},
    {"DRV 指令", "instruction DRV"},
    {"END 指令", "instruction END"},
    {"F 指令", "instruction F"},
    {"FMV 指令", "instruction FMV"},
    {"I/O接線圖", "wiring of inputs and outputs"},
    {"LD , LDI , OUT , OUTtc 指令", "instructions LD, LDI, OUT, OUTtc"},
    {"LDP , LDF 指令", "instructions LDP, LDF"},
    {"LIN 指令", "instruction LIN"},
    {"Logic 指令一覽表", "list of logic instructions"},
    {"MAN(手動)頁操作說明", "the manual page"},
    {"MRK 指令", "instruction MRK"},
    {"Motion指令一覽表", "list of motion instructions"},
    {"PSET 指令", "instruction PSET"},
    {"STP 指令", "instruction STP"},
    {"STR 指令", "instruction STR"},
    {"Sequence指令一覽表", "list of sequence instructions"},
    {"TMR 指令", "instruction TMR"},
    {"VDRV 指令", "instruction VDRV"},
    {"主畫面操作說明", "the main page"},
    {"人機系統參數設定", "the panel's settings"},
    {"參數使用說明", "use of parameters"},
    {"命令範例", "examples of commands"},
    {"基本參數說明", "base parameters"},
    {"寫入0x接點的傳輸協定", "frames that write contacts"},
    {"指令一覽表", "list of instructions"},
    {"讀取0x接點的傳輸協定", "frames that read contacts"},
    {"讀取4x暫存器的傳輸協定", "frames that read registers"},
    {"軟體架構", "structure of the software"},
};

constexpr ProofRow kProofs[] = {
    {"wire", "人機系統參數設定|讀取0x接點的傳輸協定|讀取4x暫存器的傳輸協定|寫入0x接點的傳輸協定"},
    {"contacts", "接點元件編號一覽表|M8 特殊接點的功用(一般用途)|M8x 特殊接點的功用(XYZU 軸用)"},
    {"special_registers",
     "暫存器元件編號一覽表|D8 特殊暫存器的功用(一般用途)|D8x 特殊暫存器的功用(XYZU 軸用)"},
    {"parameters", "D9 參數暫存器的功用(一般用)|D9x 參數暫存器的功用(XYZU 軸用)|基本參數說明|參數使用說明"},
    {"terminals", "I/O接線圖|X45./X46.|X40."},
    {"axis_parameters", "X1.|X2./X3.|X10./X11.|X13.|X16.|X30.|X52.|C13./C14.|C16.|C21."},
    {"homing_and_limits", "X20.|X25.|X33./X34."},
    {"panel", "主畫面操作說明|MAN(手動)頁操作說明|命令範例|M85x 人機對應接點"},
    {"plc", "軟體架構|END 指令"},
    {"plc_logic", "LDP , LDF 指令|LD , LDI , OUT , OUTtc 指令|Logic 指令一覽表"},
    {"plc_data", "Data 指令一覽表|FMV 指令|ADD , SUB , MUL , DIV 指令|ABSC , INCC 指令|DRV 指令"},
    {"motion_instructions", "Motion指令一覽表|CWR , CCWR 指令|LIN 指令|F 指令"},
    {"moves", "PSET 指令|MRK 指令|VDRV 指令"},
    {"programs", "STR 指令|STP 指令|CHK 指令"},
    {"sequence", "Sequence指令一覽表|CAL , RET 指令|TMR 指令|指令一覽表"},
};

constexpr StopStep kStop[] = {{"M8002"}};

}  // namespace

const Model& model() {
  static const RegisterMap registers(kRegisters, kPolicy);
  static const Model model{
      .name = kName,
      .title = "4-axis motion controller with a PLC, Modbus RTU on RS232 and RS485",
      .firmwares = kFirmwares,
      .registers = &registers,
      .named_parameters = named_parameters(),
      .language = &program_language(),
      .choices = kChoices,
      .sections = kSections,
      .proofs = kProofs,
      .transitions = transition_tables(),
      .terminals = terminals(),
      .axes = kAxes,
      .state_registers = kStateRegisters,
      .known_limitations = kKnownLimitations,
      .line = {.protocol = kModbusRtu, .ports = kPorts, .station_numbers = StationNumbers{0, 15, "D9000"}},
      .rtu = RtuRules{.end_silence = std::chrono::nanoseconds(3'500'000'000LL * kCharacterBits / kBauds[0]),
                      .functions = kFunctions},
      .first_files = &kFirstFiles,
      .stop = kStop,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<Super40nc>(settings);
      },
  };
  return model;
}

}  // namespace understudy::emulator::models::super_40nc
