// The numbers of the contacts and registers that the controller itself uses, with their names in the manual.
// Rows and code use these names; a number that occurs only in its row needs no name.
#pragma once

#include "interpreter/super_40nc/named.h"

namespace understudy::emulator::models::super_40nc {

/// Returns the contact of an axis that corresponds to a contact of axis X.
constexpr int of_axis(int contact_of_x, int axis) { return contact_of_x + 100 * axis; }

/// General special contacts M8.
namespace m8 {
inline constexpr int kStartOfC = 8000;
inline constexpr int kSingleStep = interpreter::super_40nc::named::kSingleStep;
inline constexpr int kEmergencyStop = interpreter::super_40nc::named::kEmergencyStop;
inline constexpr int kMotionInhibit = interpreter::super_40nc::named::kMotionInhibit;
inline constexpr int kMCodeFinished = 8005;
inline constexpr int kPause = 8006;
inline constexpr int kFactoryParameters = 8008;
}  // namespace m8

/// Special contacts M8x of X. Use of_axis() for the other axes.
namespace m8x {
inline constexpr int kStart = 8100;
inline constexpr int kSingleStep = 8101;
inline constexpr int kReset = interpreter::super_40nc::named::kReset;
inline constexpr int kJogPlus = 8103;
inline constexpr int kJogMinus = 8104;
inline constexpr int kHome = 8105;
inline constexpr int kZero = 8106;
inline constexpr int kZeroSet = 8107;
inline constexpr int kMpg1 = 8108;
inline constexpr int kMpg10 = 8109;
inline constexpr int kMpg100 = 8110;
}  // namespace m8x

/// Contacts M85x that the panel switches when its pages are turned. The panel's keys are in panel/keys.h.
namespace m85 {
inline constexpr int kParameterPageLeft = 8500;
inline constexpr int kEditPageLeft = 8501;
inline constexpr int kLogoOver = 8502;
inline constexpr int kEditPageEntered = 8507;
}  // namespace m85

/// General special registers D8.
namespace d8 {
inline constexpr int kVout1 = 8003;
inline constexpr int kVout2 = 8004;
inline constexpr int kFeedPercentage = 8005;
inline constexpr int kFeed = interpreter::super_40nc::named::kFeed;
inline constexpr int kPlane = interpreter::super_40nc::named::kPlane;
inline constexpr int kUserCommand = 8020;
inline constexpr int kUserData1 = 8021;
inline constexpr int kUserData2 = 8022;
inline constexpr int kVersion = 8099;
}  // namespace d8

/// Special registers D8x of X.
namespace d8x {
inline constexpr int kPlusLimitPort = 8118;
inline constexpr int kMinusLimitPort = 8119;
inline constexpr int kPrcmd = 8120;
inline constexpr int kRfa = 8132;
inline constexpr int kRcmp1 = 8144;
inline constexpr int kRcmp2 = 8145;
inline constexpr int kRcmp3 = 8146;
inline constexpr int kRcmp4 = 8147;
inline constexpr int kPrcmp5 = 8148;
inline constexpr int kPrci = 8150;
inline constexpr int kRmv = 8151;
inline constexpr int kRcmp5 = 8162;
inline constexpr int kRci = 8163;
}  // namespace d8x

/// General parameters D9.
namespace d9 {
inline constexpr int kStation = 9000;
inline constexpr int kFileNumber = 9001;
inline constexpr int kRecipeNumber = 9002;
inline constexpr int kSystemSpeed = interpreter::super_40nc::named::kDefaultFeed;
inline constexpr int kContinuousPath = interpreter::super_40nc::named::kContinuousPath;
inline constexpr int kLogoTime = 9007;
inline constexpr int kTargetSpeed = 9011;
inline constexpr int kSAcceleration = 9012;
inline constexpr int kSDeceleration = 9013;
inline constexpr int kAccelerationTime = 9014;
inline constexpr int kDecelerationTime = 9015;
inline constexpr int kArcPlane = interpreter::super_40nc::named::kDefaultPlane;
inline constexpr int kSwapXy = 9017;
inline constexpr int kSwapXz = 9018;
inline constexpr int kSwapYz = 9019;
inline constexpr int kEditLock = 9021;
inline constexpr int kKeyLock = 9025;
inline constexpr int kPassword = 9026;
inline constexpr int kFinishSignalTime = 9028;
inline constexpr int kEndSignalTime = 9029;
inline constexpr int kLinesOfPlc = 9036;
inline constexpr int kLinesOfX = 9037;
inline constexpr int kLinesOfY = 9038;
inline constexpr int kLinesOfZ = 9039;
inline constexpr int kLinesOfU = 9040;
inline constexpr int kLinesOfC = 9042;
inline constexpr int kFileCount = 9043;
inline constexpr int kPagesOfAFile = 9044;
inline constexpr int kLinesOfAFile = 9045;
}  // namespace d9

/// Parameters D9x, as numbers added to D9x00. The comments are the numbers on the panel.
namespace d9x {
inline constexpr int kPulseMode = 0;  // X0
inline constexpr int kOtStop = 1;
inline constexpr int kOrgLogic = 2;  // X32
inline constexpr int kAlmStop = 3;
inline constexpr int kElAlmErc = 4;
inline constexpr int kHomeErc = 5;
inline constexpr int kErcSignal = 6;
inline constexpr int kClrSignal = 9;
inline constexpr int kEncoderDirection = 13;
inline constexpr int kMpgMode = 15;       // X40
inline constexpr int kMpgDirection = 16;  // X41
inline constexpr int kPulseMask = 17;
inline constexpr int kEncoderDisable = 19;
inline constexpr int kMpgDisable = 20;
inline constexpr int kHomeMode = 21;  // X20
inline constexpr int kCNumber = 22;   // X31
inline constexpr int kC2Source = 23;
inline constexpr int kC3Source = 24;
inline constexpr int kC4Source = 25;
inline constexpr int kC4Enable = 26;
inline constexpr int kClrResetC = 27;
inline constexpr int kHomeResetC = 28;
inline constexpr int kCountCorrect = 29;
inline constexpr int kDisableC2ToC4 = 30;
inline constexpr int kCp1Source = 31;
inline constexpr int kCp1Method = 32;  // X35
inline constexpr int kCp1Action = 33;  // X35
inline constexpr int kCp2Source = 35;
inline constexpr int kCp2Method = 36;  // X36
inline constexpr int kCp2Action = 37;  // X36
inline constexpr int kCp3Source = 39;
inline constexpr int kCp3Method = 40;
inline constexpr int kCp3Action = 41;
inline constexpr int kCp4Source = 43;
inline constexpr int kCp4Method = 44;
inline constexpr int kCp4Action = 45;
inline constexpr int kCp5Source = 46;
inline constexpr int kCp5Method = 47;
inline constexpr int kCp5Action = 48;
inline constexpr int kLatchOfCounters = 50;
inline constexpr int kC3LatchSpeed = 51;
inline constexpr int kStopLatch = 52;
inline constexpr int kLatchResetC = 55;
inline constexpr int kBacklash = 56;  // X1
inline constexpr int kCorrectMode = 57;
inline constexpr int kPlusOtSignal = 63;      // X33
inline constexpr int kMinusOtSignal = 64;     // X34
inline constexpr int kDotPosition = 65;       // X61
inline constexpr int kAccelerationTime = 66;  // X2
inline constexpr int kDecelerationTime = 67;  // X3
inline constexpr int kSAcceleration = 68;     // X4
inline constexpr int kSDeceleration = 69;     // X5
inline constexpr int kPpr = 70;               // X6
inline constexpr int kCmx = 71;               // X10
inline constexpr int kCdv = 72;               // X11
inline constexpr int kZeroSetEnable = 74;     // X60
inline constexpr int kMaxSpeed = 75;          // X12
inline constexpr int kBiasSpeed = 76;         // X13
inline constexpr int kZeroSpeed = 77;         // X26
inline constexpr int kDefaultSpeed = 78;      // X14
inline constexpr int kHomeSpeed = 79;         // X21
inline constexpr int kCreepSpeed = 80;        // X22
inline constexpr int kHomeDirection = 81;     // X23
inline constexpr int kHomePosition = 82;      // X24
inline constexpr int kHomeOffset = 83;        // X30
inline constexpr int kZeroSequence = 84;      // X51
inline constexpr int kPlusSoftLimit = 85;     // X35
inline constexpr int kMinusSoftLimit = 86;    // X36
inline constexpr int kMpg1Rate = 87;          // X42
inline constexpr int kMpg10Rate = 88;         // X43
inline constexpr int kMpg100Rate = 89;        // X44
inline constexpr int kLowSpeedLength = 90;    // X16
inline constexpr int kFinishSignalTime = 91;  // X45
inline constexpr int kEndSignalTime = 92;     // X46
inline constexpr int kMoveOff = 93;           // X25
inline constexpr int kJogLow = 94;            // X53
inline constexpr int kJogMedium = 95;         // X54
inline constexpr int kJogHigh = 96;           // X55
inline constexpr int kJogDirection = 97;      // X52
inline constexpr int kKeyLock = 98;           // X56
inline constexpr int kHomeSequence = 99;      // X50
}  // namespace d9x

}  // namespace understudy::emulator::models::super_40nc
