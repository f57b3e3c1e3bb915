// Polls a register with Qt SerialBus.
#include <QCoreApplication>
#include <QModbusRtuSerialMaster>
#include <QSerialPort>
#include <QTimer>
#include <QVariant>
#include <cstdio>

int main(int count, char** words) {
  QCoreApplication program(count, words);
  QModbusRtuSerialMaster master;
  master.setConnectionParameter(QModbusDevice::SerialPortNameParameter,
                                qEnvironmentVariable("UNDERSTUDY_PORT"));
  master.setConnectionParameter(QModbusDevice::SerialBaudRateParameter, QSerialPort::Baud19200);
  master.setConnectionParameter(QModbusDevice::SerialParityParameter, QSerialPort::EvenParity);
  master.setTimeout(1000);
  master.setNumberOfRetries(0);
  if (!master.connectDevice()) return 1;
  int polls = 0;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [&] {
    if (polls == 10) return program.quit();
    const int number = polls++;
    QModbusReply* const reply =
        master.sendReadRequest(QModbusDataUnit(QModbusDataUnit::HoldingRegisters, 1, 1), number == 9 ? 9 : 1);
    QObject::connect(reply, &QModbusReply::finished, [reply, number] {
      if (reply->error() == QModbusDevice::NoError) {
        std::printf("%d %d\n", number, reply->result().value(0));
      } else {
        std::printf("%d %s\n", number, reply->errorString().toUtf8().constData());
      }
      reply->deleteLater();
    });
  });
  timer.start(1000 * qEnvironmentVariableIntValue("PAUSE_S"));
  return QCoreApplication::exec();
}
