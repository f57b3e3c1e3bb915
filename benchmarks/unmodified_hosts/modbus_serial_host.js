// Polls a register with modbus-serial; with "tcp" over Modbus TCP.
const ModbusRTU = require("modbus-serial");

async function main() {
  const client = new ModbusRTU();
  if (process.argv[2] === "tcp") await client.connectTCP("127.0.0.1", { port: 5020 });
  else await client.connectRTUBuffered(process.env.UNDERSTUDY_PORT, { baudRate: 19200, parity: "even" });
  client.setID(1);
  client.setTimeout(1500);
  for (let poll = 0; poll < 10; ++poll) {
    console.log(poll, (await client.readHoldingRegisters(1, 1)).data[0]);
    await new Promise((done) => setTimeout(done, 1000 * process.env.PAUSE_S));
  }
  client.setID(9);
  await client.readHoldingRegisters(1, 1).catch((error) => console.log(error.message));
  client.close(() => process.exit(0));
}
main();
