// Frames as a capture that Wireshark opens: a block a frame, an interface a line.
const kUser0 = 147;  // DLT_USER0, as the program's own captures of Modbus RTU and text
const kNanoseconds = 9;

function block(type, body) {
  const padded = Math.ceil(body.length / 4) * 4;
  const bytes = new Uint8Array(12 + padded);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, type, true);
  view.setUint32(4, bytes.length, true);
  bytes.set(body, 8);
  view.setUint32(8 + padded, bytes.length, true);
  return bytes;
}

function option(code, value) {
  const padded = Math.ceil(value.length / 4) * 4;
  const bytes = new Uint8Array(4 + padded);
  const view = new DataView(bytes.buffer);
  view.setUint16(0, code, true);
  view.setUint16(2, value.length, true);
  bytes.set(value, 4);
  return bytes;
}

function joined(...parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) { all.set(part, at); at += part.length; }
  return all;
}

const words = (...numbers) => {
  const view = new DataView(new ArrayBuffer(numbers.length * 4));
  numbers.forEach((number, i) => view.setUint32(i * 4, number, true));
  return new Uint8Array(view.buffer);
};
const text = (it) => new TextEncoder().encode(it);
const bytesOf = (hex) => Uint8Array.from((hex ?? '').match(/../g) ?? [], (pair) => parseInt(pair, 16));

/// `frames` and `lines` as the server tells them.
export function pcapng(frames, lines) {
  const names = lines.map((line) => line.name);
  const section = block(0x0A0D0D0A, joined(words(0x1A2B3C4D), new Uint8Array([1, 0, 0, 0]), words(0xFFFFFFFF, 0xFFFFFFFF)));
  const interfaces = names.map((name) => block(1, joined(new Uint8Array([kUser0, 0, 0, 0]), words(0),
    option(2, text(name)), option(9, new Uint8Array([kNanoseconds])), words(0))));
  const packets = frames.filter((frame) => frame.bytes).map((frame) => {
    const data = bytesOf(frame.bytes);
    const padded = new Uint8Array(Math.ceil(data.length / 4) * 4);
    padded.set(data);
    return block(6, joined(words(Math.max(names.indexOf(frame.line), 0), Math.floor(frame.time_ns / 2 ** 32), frame.time_ns % 2 ** 32,
      data.length, data.length), padded, option(1, text(frame.text)), option(2, words(frame.way === 'in' ? 1 : 2)), words(0)));
  });
  return joined(section, ...interfaces, ...packets);
}
