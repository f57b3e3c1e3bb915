// Which addresses of which device hosts use, taken from their requests.
const kTables = { 1: 'coil', 2: 'discrete', 3: 'holding', 4: 'input', 5: 'coil', 6: 'holding', 15: 'coil', 16: 'holding',
                  22: 'holding', 23: 'holding' };
const kOne = [5, 6, 22];  // functions that access one register

/// `heard` contains, for each device, a set of "holding 4096", or of the words of its lines of text.
export function hear(heard, bench, frame) {
  if (frame.way !== 'in' || !bench) return;
  const line = bench.lines.find((it) => it.name === frame.line);
  const of = (device) => heard.get(device) ?? heard.set(device, new Set()).get(device);
  if (line?.text) {
    for (const { device } of line.stations) for (const word of frame.text.match(/[A-Za-z][\w]*/g) ?? []) of(device).add(word);
    return;
  }
  const bytes = (frame.bytes?.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
  const word = (at) => bytes[at] * 256 + bytes[at + 1];
  const [station, code] = bytes;
  const table = kTables[code];
  if (bytes.length < 8 || !table) return;
  const spans = code === 23 ? [[word(2), word(4)], [word(6), word(8)]] : [[word(2), kOne.includes(code) ? 1 : word(4)]];
  for (const { device, address } of line?.stations ?? []) {
    if (station !== 0 && address !== undefined && address !== station) continue;
    for (const [first, count] of spans) {
      for (let i = 0; i < Math.min(count, 2000); ++i) of(device).add(`${table} ${first + i}`);
    }
  }
}

const kWords = { u32: 2, s32: 2, f32: 2 };

/// Returns whether hosts have used any part of the row.
export function isHeard(words, row) {
  if (!words) return false;
  if (row.address === undefined) return words.has(row.name);
  const first = Number(row.address);
  return words.has(`${row.table} ${first}`) || (kWords[row.type] === 2 && words.has(`${row.table} ${first + 1}`));
}
