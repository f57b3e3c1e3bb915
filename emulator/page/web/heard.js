// How often hosts read and write each register, and how long answers and the hosts' pauses take on each line, as seen
// in the frames.
const kTables = { 1: 'coil', 2: 'discrete', 3: 'holding', 4: 'input', 5: 'coil', 6: 'holding', 15: 'coil', 16: 'holding',
                  22: 'holding', 23: 'holding' };
const kOne = [5, 6, 22];  // functions that access one register
const kReads = [1, 2, 3, 4];
export const kBounds_ms = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];  // of the bars; the last bar has all longer durations

const newLine = () => ({ requests: 0, replies: 0, exceptions: 0, dropped: 0, latency: new Array(kBounds_ms.length + 1).fill(0),
  gaps: new Array(kBounds_ms.length + 1).fill(0), least: {}, greatest: {}, last: [], end_ns: undefined });

/// Counts a duration in its bar.
function count(line, what, ns) {
  const bar = kBounds_ms.findIndex((ms) => ns < ms * 1e6);
  ++line[what][bar < 0 ? kBounds_ms.length : bar];
  line.least[what] = Math.min(line.least[what] ?? Infinity, ns);
  line.greatest[what] = Math.max(line.greatest[what] ?? 0, ns);
}

export class Heard {
  constructor() {
    this.devices = new Map();  // by device: by "holding 4096", or by a word of its lines of text: how it is used
    this.lines = new Map();
  }

  get(device) { return this.devices.get(device); }

  use(device, word, frame, kind) {
    const words = this.devices.get(device) ?? this.devices.set(device, new Map()).get(device);
    const use = words.get(word) ?? words.set(word, { reads: 0, writes: 0, exceptions: 0, since_ns: frame.time_ns, last_ns: 0 }).get(word);
    ++use[kind];
    use.last_ns = frame.time_ns;
    return use;
  }

  take(bench, frame) {
    const line = this.lines.get(frame.line) ?? this.lines.set(frame.line, newLine()).get(frame.line);
    if (frame.remark) ++line.dropped;
    if (frame.way === 'in') return this.takeRequest(bench, line, frame);
    if (!frame.bytes) return;
    ++line.replies;
    if (frame.latency_ns !== undefined) count(line, 'latency', frame.latency_ns);
    line.end_ns = frame.time_ns;
    if (!frame.exception) return;
    ++line.exceptions;
    for (const use of line.last) ++use.exceptions;
  }

  takeRequest(bench, line, frame) {
    ++line.requests;
    if (line.end_ns !== undefined && frame.time_ns > line.end_ns) count(line, 'gaps', frame.time_ns - line.end_ns);
    line.end_ns = undefined;
    line.last = [];
    const of = bench.lines.find((it) => it.name === frame.line);
    if (of?.text) {
      for (const { device } of of.stations) for (const word of frame.text.match(/[A-Za-z][\w]*/g) ?? []) line.last.push(this.use(device, word, frame, 'writes'));
      return;
    }
    const bytes = (frame.bytes?.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
    const word = (at) => bytes[at] * 256 + bytes[at + 1];
    const code = bytes[1];
    const table = kTables[code];
    if (bytes.length < 8 || !table) return;
    const spans = code === 23 ? [[word(2), word(4), 'reads'], [word(6), word(8), 'writes']]
      : [[word(2), kOne.includes(code) ? 1 : word(4), kReads.includes(code) ? 'reads' : 'writes']];
    for (const device of frame.devices ?? []) {
      for (const [first, size, kind] of spans) {
        for (let i = 0; i < Math.min(size, 2000); ++i) line.last.push(this.use(device, `${table} ${first + i}`, frame, kind));
      }
    }
  }
}

const kWords = { u32: 2, s32: 2, f32: 2 };

/// How hosts use any part of the row, or nothing.
export function useOf(words, row) {
  if (!words) return undefined;
  if (row.address === undefined) return words.get(row.name);
  const first = Number(row.address);
  return words.get(`${row.table} ${first}`) ?? (kWords[row.type] === 2 ? words.get(`${row.table} ${first + 1}`) : undefined);
}
