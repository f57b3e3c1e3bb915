// Writes frames as a capture for Wireshark, one block per frame and one interface per line. As in the program's own
// captures (pty/capture_pcapng.h), each packet names its dissector, so Wireshark decodes Modbus RTU without a flag.
const kUpperPdu = 252;  // "Wireshark upper PDU": tags, then the bytes
const kStationPort = 19200;  // lets Wireshark distinguish requests from replies
const [kDissector, kPortType, kSourcePort, kDestinationPort] = [12, 24, 25, 26];
const kTcp = 2;
const kNanoseconds = 9;
const kUndecoded = /not a frame|incomplete/;

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

function numbers(write, size, ...values) {
  const view = new DataView(new ArrayBuffer(values.length * size));
  values.forEach((value, i) => write(view, i * size, value));
  return new Uint8Array(view.buffer);
}
const words = (...values) => numbers((view, at, value) => view.setUint32(at, value, true), 4, ...values);
const halves = (...values) => numbers((view, at, value) => view.setUint16(at, value), 2, ...values);  // tags are big-endian
const tag = (code, value) => joined(halves(code, 4), numbers((view, at, it) => view.setUint32(at, it), 4, value));
const text = (it) => new TextEncoder().encode(it);
const bytesOf = (hex) => new Uint8Array(((hex ?? '').match(/../g) ?? []).map((pair) => parseInt(pair, 16)));

function dataOf(frame, number, isText) {
  const bytes = bytesOf(frame.bytes);
  const isFrame = !isText && bytes.length > 0 && !kUndecoded.test(frame.remark ?? '');
  const dissector = text(isFrame ? 'mbrtu\0\0\0' : 'data');
  const ports = frame.way === 'in' ? [number + 1, kStationPort] : [kStationPort, number + 1];
  return joined(halves(kDissector, dissector.length), dissector, tag(kPortType, kTcp), tag(kSourcePort, ports[0]),
    tag(kDestinationPort, ports[1]), halves(0, 0), bytes);
}

/// `frames` and `lines` are as the server sends them, with `{ missed }` where frames are missing. The comment of a
/// packet describes the frame and its result, and says how many frames before it are missing.
export function pcapng(frames, lines) {
  const names = lines.map((line) => line.name);
  const section = block(0x0A0D0D0A, joined(words(0x1A2B3C4D), new Uint8Array([1, 0, 0, 0]), words(0xFFFFFFFF, 0xFFFFFFFF),
    option(4, text('understudy')), words(0)));
  const interfaces = names.map((name) => block(1, joined(new Uint8Array([kUpperPdu, 0, 0, 0]), words(0),
    option(2, text(name)), option(9, new Uint8Array([kNanoseconds])), words(0))));
  const packets = frames.map((frame, i) => {
    if (frame.key) return new Uint8Array(0);
    const hole = i > 0 && frames[i - 1].key ? `${frames[i - 1].missed} frames are missing before this one` : '';
    const number = Math.max(names.indexOf(frame.line), 0);
    const data = dataOf(frame, number, lines[number]?.text);
    const padded = new Uint8Array(Math.ceil(data.length / 4) * 4);
    padded.set(data);
    const comment = [frame.text, frame.remark, hole].filter(Boolean).join('; ');
    return block(6, joined(words(number, Math.floor(frame.time_ns / 2 ** 32), frame.time_ns % 2 ** 32, data.length, data.length),
      padded, option(1, text(comment)), option(2, words(frame.way === 'in' ? 1 : 2)), words(0)));
  });
  return joined(section, ...interfaces, ...packets);
}
