// The ladder of a PLC: contacts and coils as a drawing; live parts are lit. A click on one sets a breakpoint.
import { html, useEffect } from './preact.js';
import { unwant, valueOf, want } from './store.js';
import { conducts, nameOf, namesOf, partsOf, rungsOf } from './rungs.js';
import { grouped } from './small.js';

const kWidth = 88;   // of a contact, in dots
const kHeight = 50;  // of a row
const kRail = 44;    // the left rail, behind the number of the line
const kLeast = 5;    // cells between the rails
const kWide = 2;     // cells of an instruction other than a coil
const kLetters = { SET: 'S', RST: 'R', PLS: '↑', PLF: '↓', ALT: '~' };
const kCoil = /^(OUT|SET|RST|PLS|PLF|ALT)$/;
const isCoil = (output) => kCoil.test(output.word) && output.operands.length === 1;

const sum = (all) => all.reduce((a, b) => a + b, 0);

/** Returns the size of a part in cells: [columns, rows]. */
function sizeOf(part) {
  if (part.kind === 'output') return [isCoil(part) ? 1 : kWide, 1];
  if (part.kind === 'contact') return [part.operands.length > 1 ? kWide : 1, 1];
  if (part.kind === 'inverse') return [1, 1];
  const sizes = (part.kind === 'wire' ? part.ends : part.parts).map(sizeOf);
  const wide = (all) => Math.max(0, ...all.map(([w]) => w));
  const high = (all) => Math.max(1, ...all.map(([, h]) => h));
  if (part.kind === 'series') return [sum(sizes.map(([w]) => w)), high(sizes)];
  if (part.kind === 'parallel') return [wide(sizes), sum(sizes.map(([, h]) => h))];
  const blocks = part.blocks.map(sizeOf);
  return [sum(blocks.map(([w]) => w)) + wide(sizes), Math.max(high(blocks), sum(sizes.map(([, h]) => h)))];
}

/** Draws rungs. Live parts are lit; a part whose state is unknown (`null`) is drawn as dead. */
class Drawing {
  constructor(device, point) {
    this.shapes = [];
    this.get = (name) => valueOf(`${device}.${name}`);
    this.point = point;
  }
  line(x1, y1, x2, y2, isLive) {
    if (x1 !== x2 || y1 !== y2) this.shapes.push(html`<line class=${isLive ? 'live' : ''} x1=${x1} y1=${y1} x2=${x2} y2=${y2} />`);
  }
  /** An instruction that can be clicked: `shape` is drawn around (x, y), in the middle of its cells. */
  place(part, x, y, isOn, shape, label, below = '') {
    const { has, count, toggle } = this.point(part.line);
    const half = sizeOf(part)[0] * kWidth / 2;
    const text = `line ${part.line}: ${[part.word, ...part.operands].join(' ')}${count ? `; ${count.says}` : ''}`;
    this.shapes.push(html`<g class=${`part ${isOn ? 'live' : ''} ${has ? 'has_stop' : ''} ${count ? count.kind : ''}`} role="button" tabindex="0"
        aria-label=${text} aria-pressed=${has} onClick=${toggle} onKeyDown=${(event) => { if (event.key === 'Enter') toggle(); }}>
      <title>${text}</title><rect class="around" x=${x - half + 3} y=${y - kHeight / 2 + 2} width=${2 * half - 6} height=${kHeight - 4} rx="4" />
      ${shape}<text x=${x} y=${y - 13}>${label}</text>${below && html`<text class="below" x=${x} y=${y + 22}>${below}</text>`}
      ${has && html`<circle class="stop" cx=${x - half + 11} cy=${y - kHeight / 2 + 11} r="5" />`}</g>`);
  }
  contact(part, x, y, live) {
    const isOn = conducts(part, this.get);
    const isBox = part.operands.length > 1;
    const width = (isBox ? kWide : 1) * kWidth;
    const middle = x + width / 2;
    const mark = /I$/.test(part.word) ? html`<line x1=${middle - 10} y1=${y + 9} x2=${middle + 10} y2=${y - 9} />`
      : /P$/.test(part.word) ? html`<text x=${middle} y=${y + 4}>↑</text>` : /F$/.test(part.word) ? html`<text x=${middle} y=${y + 4}>↓</text>` : '';
    const arm = isBox ? width / 2 - 8 : 7;
    this.line(x, y, middle - arm, y, live);
    this.line(middle + arm, y, x + width, y, live && isOn);
    const values = part.operands.map((operand) => this.get(nameOf(operand, isBox))).filter((it) => typeof it === 'number');
    const shape = isBox
      ? html`<rect class="box" x=${middle - arm} y=${y - 11} width=${2 * arm} height="22" /><text x=${middle} y=${y + 5}>${`${part.operands[0]} ${/[=<>]+$/.exec(part.word)?.[0]} ${part.operands[1]}`}</text>`
      : html`<line x1=${middle - 7} y1=${y - 10} x2=${middle - 7} y2=${y + 10} /><line x1=${middle + 7} y1=${y - 10} x2=${middle + 7} y2=${y + 10} />${mark}`;
    this.place(part, middle, y, isOn, shape, isBox ? '' : part.operands[0], isBox ? values.map(grouped).join(', ') : '');
    return live && isOn;
  }
  /** Draws a part from (x, y) on. Returns whether its right end is live. */
  part(part, x, y, live) {
    if (part.kind === 'contact') return this.contact(part, x, y, live);
    if (part.kind === 'inverse') {
      this.line(x, y, x + kWidth, y, !live);
      this.shapes.push(html`<line x1=${x + kWidth / 2 - 6} y1=${y + 8} x2=${x + kWidth / 2 + 6} y2=${y - 8} />`);
      return !live;
    }
    if (part.kind === 'series') {
      let at = x;
      for (const one of part.parts) {
        live = this.part(one, at, y, live);
        at += sizeOf(one)[0] * kWidth;
      }
      return live;
    }
    const right = x + sizeOf(part)[0] * kWidth;
    let row = y;
    const ends = part.parts.map((one) => {
      const isLive = this.part(one, x, row, live);
      this.line(x + sizeOf(one)[0] * kWidth, row, right, row, isLive);
      const end = { row, isLive };
      row += sizeOf(one)[1] * kHeight;
      return end;
    });
    const isLive = ends.some((end) => end.isLive);
    this.line(x, y, x, ends.at(-1).row, live);
    this.line(right, y, right, ends.at(-1).row, isLive);
    return isLive;
  }
  output(part, x, y, live, right) {
    const [operand] = part.operands;
    const width = sizeOf(part)[0] * kWidth;
    const from = right - width;
    const middle = right - width / 2;
    this.line(x, y, from, y, live);
    const values = namesOf(part).map(this.get).filter((it) => typeof it === 'number');
    if (isCoil(part)) {
      this.line(from, y, middle - 11, y, live);
      this.line(middle + 11, y, right, y, live);
      const letter = kLetters[part.word] ?? '';
      return this.place(part, middle, y, values[0] !== undefined && values[0] !== 0,
                        html`<circle class="box" cx=${middle} cy=${y} r="11" /><text x=${middle} y=${y + 4}>${letter}</text>`, operand);
    }
    const arm = width / 2 - 6;
    this.line(from, y, middle - arm, y, live);
    this.line(middle + arm, y, right, y, live);
    const timed = part.word === 'OUT' ? this.get(nameOf(operand, true)) : undefined;
    const below = (timed !== undefined ? [timed] : values).map(grouped).join(', ');
    const isOn = part.word === 'OUT' ? values[0] !== undefined && values[0] !== 0 : live;
    this.place(part, middle, y, isOn, html`<rect class="box" x=${middle - arm} y=${y - 11} width=${2 * arm} height="22" />
      <text x=${middle} y=${y + 5}>${[part.word, ...part.operands].join(' ')}</text>`, '', below);
  }
  wire(wire, x, y, live, right) {
    let at = x;
    for (const block of wire.blocks) {
      live = this.part(block, at, y, live);
      at += sizeOf(block)[0] * kWidth;
    }
    let row = y;
    for (const end of wire.ends) {
      this.line(at, y, at, row, live);
      if (end.kind === 'wire') this.wire(end, at, row, live, right); else this.output(end, at, row, live, right);
      row += sizeOf(end)[1] * kHeight;
    }
  }
}

function Rung({ rung, columns, device, point }) {
  const [, rows] = sizeOf(rung);
  const right = kRail + columns * kWidth;
  const drawing = new Drawing(device, point);
  drawing.wire(rung, kRail, kHeight / 2, true, right);
  const line = partsOf(rung)[0]?.line;
  return html`<svg class="rung" width=${right + 6} height=${rows * kHeight} viewBox=${`0 0 ${right + 6} ${rows * kHeight}`} role="group" aria-label=${`rung at line ${line}`}>
    <text class="number" x=${kRail - 8} y=${kHeight / 2 + 4}>${line}</text>
    <line class="live" x1=${kRail} y1="0" x2=${kRail} y2=${rows * kHeight} /><line x1=${right} y1="0" x2=${right} y2=${rows * kHeight} />
    ${drawing.shapes}</svg>`;
}

/// Draws the area PLC of a listing. `point` returns for a line whether it has a breakpoint, what has been counted, and a
/// function that sets or deletes the breakpoint.
export function Ladder({ device, lines, point }) {
  const rungs = rungsOf(lines);
  const names = [...new Set(rungs.flatMap(partsOf).flatMap((part) => [...namesOf(part),
    ...(part.word === 'OUT' && part.operands.length > 1 ? [nameOf(part.operands[0], true)] : [])]))];
  useEffect(() => {
    want('ladder', names.map((name) => `${device}.${name}`));
    return () => unwant('ladder');
  }, [device, names.join()]);
  const columns = Math.max(kLeast, ...rungs.map((rung) => sizeOf(rung)[0]));
  return html`<div class="ladder" tabindex="0" role="region" aria-label="ladder">${rungs.map((rung, i) => html`<${Rung} key=${i}
    rung=${rung} columns=${columns} device=${device} point=${point} />`)}</div>`;
}
