// A ladder as rungs: reads the list of instructions of a PLC into contacts in series and in parallel, and what they
// switch. A line that belongs to no rung, such as END, is left out.

/**
 * A contact, or contacts in series or in parallel. `line` counts from 1, in the text.
 * @typedef {{ kind: 'contact', word: string, operands: string[], line: number }
 *   | { kind: 'series' | 'parallel', parts: Part[] } | { kind: 'inverse', line: number }} Part
 * What a wire leads to: an instruction that it switches, or wires behind further contacts.
 * @typedef {{ kind: 'output', word: string, operands: string[], line: number }} Output
 * @typedef {{ kind: 'wire', blocks: Part[], ends: (Output | Wire)[] }} Wire
 */

const kContact = /^(LD|AND?|AD|OR)(I|P|F|=|<>|<=|>=|<|>)?$/;
const kCompares = /[=<>]/;
const kSwitches = /^(OUT|SET|RST|PLS|PLF|ALT)$/;  // contacts; other instructions have values

/** @returns {Wire} */
const newWire = () => ({ kind: 'wire', blocks: [], ends: [] });

/** @param {'series' | 'parallel'} kind @param {Part | undefined} a @param {Part} b @returns {Part} */
function joined(kind, a, b) {
  if (!a) return b;
  return { kind, parts: [...(a.kind === kind ? a.parts : [a]), ...(b.kind === kind ? b.parts : [b])] };
}

/** Puts a contact behind the last block, or beside it. @param {Wire} wire @param {'series' | 'parallel'} how @param {Part} part */
function join(wire, how, part) {
  wire.blocks.push(joined(how, wire.blocks.pop(), part));
}

/** Returns the words of a line of a listing, without its step number and remark. */
const wordsOf = (text) => text.replace(/[;#].*/, '').trim().replace(/^\d+\s+/, '').toUpperCase().split(/[\s,]+/).filter((word) => word !== '');

/** Returns the lines of the area PLC, counted from 1, or none if the text has no such area. */
function linesOfPlc(lines) {
  let inPlc = false;
  return lines.map((text, i) => ({ words: wordsOf(text), line: i + 1 })).filter(({ words }) => {
    if (words[0] !== 'AREA') return inPlc && words.length > 0;
    inPlc = words[1] === 'PLC';
    return false;
  });
}

export const hasLadder = (lines) => linesOfPlc(lines).length > 0;

/** Reads rungs, one instruction after another. */
class Reader {
  /** @type {Wire[]} */ rungs = [];
  /** @type {Wire | null} */ wire = null;    // the one that is being read
  /** @type {Wire[]} */ branches = [];       // those that MPS has kept

  /** Begins a block: of the wire that is read, or of a new rung if that one already switches something. */
  load(contact) {
    if (!this.wire || this.wire.ends.length > 0) this.begin();
    this.wire.blocks.push(contact);
  }
  begin() {
    this.wire = newWire();
    this.branches = [];
    this.rungs.push(this.wire);
  }
  /** The wire for the next contact: behind an output, the rest of a rung is a wire of its own. */
  open() {
    if (!this.wire) this.begin();
    if (this.wire.ends.length > 0) this.branch(this.wire);
    return this.wire;
  }
  branch(from) {
    const wire = newWire();
    from.ends.push(wire);
    this.wire = wire;
  }
  take([word, ...operands], line) {
    const kind = /** @type {const} */ ('contact');
    const contact = kContact.exec(word);
    if (contact?.[1] === 'LD') return this.load({ kind, word, operands, line });
    if (contact && (contact[1] === 'OR')) return join(this.open(), 'parallel', { kind, word, operands, line });
    if (contact) return join(this.open(), 'series', { kind, word, operands, line });
    if (word === 'INV') return join(this.open(), 'series', { kind: 'inverse', line });
    if (word === 'ANB' || word === 'ORB') {
      const { blocks } = this.open();
      if (blocks.length < 2) return;  // a block behind a branch joins the branch by itself
      const last = blocks.pop();
      return blocks.push(joined(word === 'ANB' ? 'series' : 'parallel', blocks.pop(), last));
    }
    if (word === 'MPS') {
      this.branches.push(this.wire ?? this.open());
      return this.branch(this.branches.at(-1));
    }
    if (word === 'MRD' || word === 'MPP') {
      const from = word === 'MRD' ? this.branches.at(-1) : this.branches.pop();
      return from && this.branch(from);
    }
    if (word === 'NOP' || word === 'END') return;
    if (!this.wire) this.begin();
    this.wire.ends.push({ kind: 'output', word, operands, line });
  }
}

/** @returns {Wire[]} */
export function rungsOf(lines) {
  const reader = new Reader();
  for (const { words, line } of linesOfPlc(lines)) reader.take(words, line);
  return reader.rungs;
}

/** Returns the name of a contact or a value: T and C have both. */
export function nameOf(operand, isValue) {
  if (/^[TC]\d/.test(operand)) return `${isValue ? 'holding' : 'coil'}.${operand}`;
  return operand;
}

/** Returns the names of what an instruction reads or switches. */
export function namesOf({ kind, word, operands }) {
  const hasValues = kind === 'contact' ? kCompares.test(word) : !kSwitches.test(word);
  return operands.filter((operand) => /^[XYMTCD]\d+$/.test(operand)).map((operand) => nameOf(operand, hasValues));
}

/** Returns all contacts and outputs of a wire, including a contact's parts. */
export function partsOf(part) {
  if (part.kind === 'wire') return [...part.blocks, ...part.ends].flatMap(partsOf);
  return part.parts ? part.parts.flatMap(partsOf) : part.kind === 'inverse' ? [] : [part];
}

/** Returns whether a contact conducts, or null for a contact that only reacts to changes. `get` returns a value. */
export function conducts(contact, get) {
  const { word, operands } = contact;
  const compares = /(=|<>|<=|>=|<|>)$/.exec(word)?.[1];
  if (!compares) {
    const value = get(nameOf(operands[0] ?? '', false));
    if (typeof value !== 'number' || /[PF]$/.test(word)) return null;
    return (value !== 0) !== /I$/.test(word);
  }
  const [a, b] = operands.map((operand) => (/^K-?\d+$/.test(operand) ? Number(operand.slice(1)) : get(nameOf(operand, true))));
  if (typeof a !== 'number' || typeof b !== 'number') return null;
  return { '=': a === b, '<>': a !== b, '<': a < b, '>': a > b, '<=': a <= b, '>=': a >= b }[compares];
}
