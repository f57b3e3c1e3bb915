// Polls a register with jsmodbus and serialport.
const jsmodbus = require("jsmodbus");
const { SerialPort } = require("serialport");

const port = new SerialPort({ path: process.env.UNDERSTUDY_PORT, baudRate: 19200, parity: "even" });
const client = new jsmodbus.client.RTU(port, 1);
port.on("open", async () => {
  for (let poll = 0; poll < 10; ++poll) {
    console.log(poll, (await client.readHoldingRegisters(1, 1)).response.body.values[0]);
    await new Promise((done) => setTimeout(done, 1000 * process.env.PAUSE_S));
  }
  port.close(() => process.exit(0));
});
