// Qt's Modbus master: sends requests one after the other in one opening of the port, and prints a line for
// what became of each.
//
//   qt5_serialbus_host PORT BAUD N|E REQUEST...
//
//   STATION/read/ADDRESS/COUNT           1 2 3                   the values
//   STATION/inputs/ADDRESS/COUNT         the same with function 04
//   STATION/write/ADDRESS/VALUE,...      written                 function 06, or 10 hex if there are several
//   STATION/raw/FUNCTION/HEX             the data of the reply in hex
//   STATION/poll/ADDRESS/MASK            0                       reads until no bit of the mask is set
//
// Address 0: "broadcast" if it was sent and no reply waited for. Otherwise "exception N", "timeout" or
// "error TEXT". Numbers are decimal, or hex with 0x. The exit code tells only whether the port could be
// opened.
#include <QtCore/QCoreApplication>
#include <QtCore/QElapsedTimer>
#include <QtCore/QEventLoop>
#include <QtCore/QStringList>
#include <QtCore/QTextStream>
#include <QtCore/QThread>
#include <QtCore/QVariant>
#include <QtSerialBus/QModbusDataUnit>
#include <QtSerialBus/QModbusReply>
#include <QtSerialBus/QModbusRtuSerialMaster>
#include <memory>

namespace {

constexpr int kTimeoutMs = 5000;
// After a broadcast, before the next request: that begins with a flush, which throws away what the other end
// of a pty has not read by then. Qt's own setTurnaroundDelay() does not keep it apart (5.15).
constexpr int kTurnaroundMs = 100;
constexpr int kPollPatienceMs = 8000;

int number(const QString& text) { return text.toInt(nullptr, 0); }

using Reply = std::unique_ptr<QModbusReply>;

Reply send(QModbusRtuSerialMaster& master, const QStringList& words) {
  const int station = number(words[0]);
  const QString what = words[1];
  if (what == "raw") {
    const auto function = static_cast<QModbusPdu::FunctionCode>(number(words[2]));
    const QModbusRequest request(function, QByteArray::fromHex(words[3].toLatin1()));
    return Reply(master.sendRawRequest(request, station));
  }
  const auto table = what == "inputs" ? QModbusDataUnit::InputRegisters : QModbusDataUnit::HoldingRegisters;
  if (what == "write") {
    QVector<quint16> values;
    for (const QString& value : words[3].split(',')) values.push_back(static_cast<quint16>(number(value)));
    return Reply(master.sendWriteRequest({table, number(words[2]), values}, station));
  }
  const auto count = static_cast<quint16>(what == "poll" ? 1 : number(words[3]));
  return Reply(master.sendReadRequest({table, number(words[2]), count}, station));
}

void wait_for(const QModbusReply& reply) {
  QEventLoop loop;
  QObject::connect(&reply, &QModbusReply::finished, &loop, &QEventLoop::quit);
  if (!reply.isFinished()) loop.exec();
}

QString outcome(const QModbusReply& reply, const QString& what) {
  if (reply.error() == QModbusDevice::ProtocolError)
    return QString("exception %1").arg(static_cast<int>(reply.rawResult().exceptionCode()));
  if (reply.error() == QModbusDevice::TimeoutError) return "timeout";
  if (reply.error() != QModbusDevice::NoError) return "error " + reply.errorString();
  if (reply.type() == QModbusReply::Broadcast) return "broadcast";
  if (what == "raw") return reply.rawResult().data().toHex();
  if (what == "write") return "written";
  QStringList values;
  for (const quint16 value : reply.result().values()) values.push_back(QString::number(value));
  return values.join(' ');
}

QString run(QModbusRtuSerialMaster& master, const QStringList& words) {
  QElapsedTimer timer;
  timer.start();
  while (true) {
    const Reply reply = send(master, words);
    if (!reply) return "error " + master.errorString();
    wait_for(*reply);
    const QString text = outcome(*reply, words[1]);
    if (words[1] != "poll" || reply->error() != QModbusDevice::NoError) return text;
    const int bits = number(text) & number(words[3]);
    if (bits == 0 || timer.elapsed() > kPollPatienceMs) return QString::number(bits);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  const QStringList arguments = QCoreApplication::arguments();
  QTextStream out(stdout);
  if (arguments.size() < 4) return 2;
  QModbusRtuSerialMaster master;
  master.setConnectionParameter(QModbusDevice::SerialPortNameParameter, arguments[1]);
  master.setConnectionParameter(QModbusDevice::SerialBaudRateParameter, number(arguments[2]));
  const int parity = arguments[3] == "E" ? 2 : 0;  // QSerialPort::EvenParity, NoParity
  master.setConnectionParameter(QModbusDevice::SerialParityParameter, parity);
  master.setConnectionParameter(QModbusDevice::SerialDataBitsParameter, 8);
  master.setConnectionParameter(QModbusDevice::SerialStopBitsParameter, 1);
  master.setTimeout(kTimeoutMs);
  master.setNumberOfRetries(0);
  if (!master.connectDevice()) {
    out << master.errorString() << '\n';
    return 3;
  }
  for (const QString& request : arguments.mid(4)) {
    const QString became = run(master, request.split('/'));
    out << became << '\n';
    if (became == "broadcast") QThread::msleep(kTurnaroundMs);
  }
  master.disconnectDevice();
  return 0;
}
