// The WebSocket to the page's server (docs/page.md): sends requests, watches benches, and reconnects after a failure.
const kQuiet_ms = 2500;  // then the client pings the server,
const kDead_ms = 5000;   // and then gives it up

export class Wire {
  constructor(hears) {
    this.hears = hears;  // { hello, bench, look, lost, dead }
    this.token = location.hash.slice(1).split('&')[0];  // what follows is a moment (link.js)
    this.watched = new Map();
    this.waiting = new Map();
    this.early = new Map();  // by a question that has been sent already: its answer
    this.lastId = 0;
    this.pause = 250;
    this.open();
    setInterval(() => this.listen(), 500);
  }

  // A hung server or a broken tunnel closes nothing; it only falls silent.
  listen() {
    const quiet_ms = performance.now() - this.heardAt;
    if (!this.isKnown || quiet_ms < kQuiet_ms) return;
    if (quiet_ms < kDead_ms) return void (this.pinged ??= this.ask(0, { do: 'status' }));
    const { socket } = this;
    socket.onclose = socket.onmessage = null;
    socket.close();
    this.forget();
    this.hears.dead?.();
    this.open();
  }

  forget() {
    this.early.clear();
    for (const answer of this.waiting.values()) answer({ ok: false, error: 'the page lost the connection to its server' });
    this.waiting.clear();
    this.isKnown = false;
  }

  open() {
    const early = this.takeEarly();
    const socket = early ? early.socket : new WebSocket(`ws://${location.host}/ws`);
    this.socket = socket;
    if (!early) socket.onopen = () => socket.send(JSON.stringify({ token: this.token }));
    socket.onmessage = (event) => {
      this.heardAt = performance.now();
      this.pinged = null;
      this.take(JSON.parse(event.data));
    };
    socket.onclose = (event) => {
      this.forget();
      this.hears.lost?.(event.reason);
      setTimeout(() => this.open(), this.pause);
      this.pause = Math.min(this.pause * 2, 4000);
    };
    // Later, because whoever makes the wire does not have it yet.
    if (early) setTimeout(() => { early.heard.forEach(socket.onmessage); if (early.closed) socket.onclose(early.closed); });
  }

  /// Takes over the connection of early.js, once. Its questions to the first bench have the numbers from 0 on.
  takeEarly() {
    const all = /** @type {any} */ (globalThis);
    const { early } = all;
    delete all.early;
    if (!early) return null;
    early.asked.forEach((text, id) => this.early.set(text, new Promise((resolve) => { this.waiting.set(id, resolve); })));
    this.lastId = early.asked.length;
    return early;
  }

  take(message) {
    if (message.is === 'answer') {
      this.waiting.get(message.id)?.(message.reply);
      this.waiting.delete(message.id);
      return;
    }
    if (message.is === 'hello') {
      this.isKnown = true;
      this.pause = 250;
      for (const [bench, wanted] of this.watched) this.say({ do: 'watch', bench, ...wanted });
    }
    this.hears[message.is]?.(message);
  }

  say(message) {
    if (this.isKnown) this.socket.send(JSON.stringify(message));
  }

  // Sets what this browser wants to receive from a bench from now on: { names: [...], frames, events, status }.
  watch(bench, wanted) {
    this.watched.set(bench, wanted);
    this.say({ do: 'watch', bench, ...wanted });
  }

  // Sends a message of docs/control.md, and resolves to its reply.
  ask(bench, message) {
    if (!this.isKnown) return Promise.resolve({ ok: false, error: 'the page is not connected to its server' });
    const text = bench === 0 && this.early.size > 0 ? JSON.stringify(message) : '';
    const answer = this.early.get(text);
    // The server may not have had the bench yet when early.js asked.
    const again = (reply) => (reply.ok === false && message.do === 'bench' ? this.ask(bench, message) : reply);
    if (answer && this.early.delete(text)) return answer.then(again);
    const id = ++this.lastId;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.say({ do: 'ask', bench, id, message });
    });
  }
}
