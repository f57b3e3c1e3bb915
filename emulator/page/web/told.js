// A recording in one file (`replay --export`): answers as the page's server would, from the contents of the file.
const kPlace = document.getElementById('told');
export const isTold = kPlace !== null;
const kMaxBefore = 200;  // frames, and events, from before a moment

/// Calls `take(least, greatest, dot)` for every dot of a course's row that lies in the stretch. A row is a list of
/// runs: the first dot, its minimum and its maximum.
function eachDot(course, row, from, to, take) {
  const size = (course.to_ns - course.from_ns) / course.dots;
  const first = Math.max(0, Math.floor((from - course.from_ns) / size));
  const last = Math.min(course.dots - 1, Math.floor((to - course.from_ns) / size));
  for (let i = 0; i < row.length; i += 3) {
    const end = Math.min(last, (row[i + 3] ?? course.dots) - 1);
    for (let dot = Math.max(first, row[i]); dot <= end; ++dot) take(row[i + 1], row[i + 2], dot);
  }
}

function lastIndex(list, fits) {
  let i = list.length - 1;
  while (i >= 0 && !fits(list[i])) --i;
  return i;
}

export class Told {
  constructor(hears) {
    this.hears = hears;
    this.data = JSON.parse(kPlace.textContent);
    this.at = this.data.timeline.at_ns;
    this.names = [];
    this.isMoved = true;
    this.moves = 0;
    setTimeout(() => this.hears.hello({ read_only: false, version: this.data.version, benches: [{ socket: this.data.name, state: 'there', epoch: 1 }] }));
  }

  watch(_bench, wanted) {
    this.names = wanted.names;
    this.tell();
  }

  /// Sends values, and after a move also the past, as soon as the caller is done.
  tell() {
    this.plan ??= setTimeout(() => {
      this.plan = undefined;
      const before = (list) => list.slice(0, lastIndex(list, (it) => it.time_ns <= this.at) + 1).slice(-kMaxBefore);
      const past = this.isMoved ? { frames: before(this.data.frames), events: before(this.data.events), status: this.statusNow() } : {};
      this.isMoved = false;
      const values = Object.fromEntries(this.names.map((name) => [name, this.valueOf(name)]));
      this.hears.look({ bench: 0, time_ns: this.at, paused: true, speed: 'manual', advancing: false, restores: this.moves, values, ...past });
    });
  }

  /// The file contains faults and power only for the moment at which it opens.
  statusNow() {
    const { status, timeline } = this.data;
    return this.at === timeline.at_ns ? status : { ...status, faults: [], devices: status.devices.map(({ name }) => ({ name })) };
  }

  /// The finest course that contains the stretch.
  courseOf(from, to) {
    const { courses } = this.data;
    return courses[Math.max(0, lastIndex(courses, (it) => it.from_ns <= from && it.to_ns >= to))];
  }

  valueOf(name) {
    if (this.at === this.data.timeline.at_ns) return this.data.values[name];
    const course = this.courseOf(this.at, this.at);
    let value = null;
    if (course.curves[name]) eachDot(course, course.curves[name], this.at, this.at, (least) => { value = least; });
    return value;
  }

  curve(name, course, from, to, dots) {
    const [least, greatest] = [new Array(dots).fill(null), new Array(dots).fill(null)];
    const row = course.curves[name];
    if (!row) return { least: [], greatest: [] };
    const size = (course.to_ns - course.from_ns) / course.dots;
    eachDot(course, row, from, to, (low, high, dot) => {
      if (low === null) return;
      const begin = course.from_ns + dot * size;
      const place = (time) => Math.min(dots - 1, Math.max(0, Math.floor((time - from) / (to - from) * dots)));
      for (let at = place(begin); at <= place(begin + size - 1); ++at) {
        if (least[at] === null || low < least[at]) least[at] = low;
        if (greatest[at] === null || high > greatest[at]) greatest[at] = high;
      }
    });
    return { least, greatest };
  }

  /// The moment after this many ticks, frames or events.
  stepped(by, steps) {
    const { begin_ns, end_ns } = this.data.timeline;
    if (by === 'tick') return (steps < 0 ? Math.ceil(this.at / 1e6) : Math.floor(this.at / 1e6)) * 1e6 + steps * 1e6;
    const times = [...new Set((by === 'frame' ? this.data.frames : this.data.events).map((it) => it.time_ns))];
    const place = steps > 0 ? times.findIndex((it) => it > this.at) + steps - 1 : lastIndex(times, (it) => it < this.at) + steps + 1;
    const isThere = steps > 0 ? times.some((it) => it > this.at) : place >= 0;
    return isThere ? times[place] ?? end_ns : steps > 0 ? end_ns : begin_ns;
  }

  answer(message) {
    const { data } = this;
    const { begin_ns, end_ns } = data.timeline;
    const [from_ns, to_ns] = [message.from_ns ?? begin_ns, message.to_ns ?? end_ns];
    switch (message.do) {
      case 'bench': return message.device === '*' ? { devices: Object.values(data.devices) } : { bench: data.bench };
      case 'timeline': return { timeline: data.timeline };
      case 'faults': return { kinds: [], trigger: [] };
      case 'curves': {
        const course = this.courseOf(from_ns, to_ns);
        return { from_ns, to_ns, curves: message.names.map((name) => this.curve(name, course, from_ns, to_ns, message.dots)) };
      }
      case 'spans': return { spans: this.courseOf(from_ns, to_ns).spans.filter((it) => it.end_ns >= from_ns && it.begin_ns <= to_ns) };
      case 'seek': {
        const to = message.by ? this.stepped(message.by, message.steps ?? 1) : message.to_ns;
        this.at = Math.min(Math.max(to, begin_ns), end_ns);
        this.isMoved = true;
        ++this.moves;
        this.tell();
        return { simulated_time_ns: this.at };
      }
      case 'get': {
        const missing = message.names.find((name) => !data.courses[0].curves[name]);
        return missing ? { ok: false, error: `this file does not contain ${missing}` } : {};
      }
      default: return { ok: false, error: 'this file does not contain that; open the recording itself: understudy replay FILE --page' };
    }
  }

  ask(_bench, message) { return Promise.resolve({ ok: true, ...this.answer(message) }); }
}
