import { html, render } from './preact.js';
import { Wire } from './wire.js';

const known = { state: 'unknown', bench: null, values: {}, frames: [], time: null };

const wire = new Wire({
  hello: (hello) => take(hello.benches[0].state),
  bench: (bench) => take(bench.state),
  lost: (why) => { known.state = why ? `closed: ${why}` : 'the server is gone'; draw(); },
  look: (look) => {
    known.time = look;
    Object.assign(known.values, look.values);
    known.frames = known.frames.concat(look.frames ?? []).slice(-20);
    draw();
  },
});

async function take(state) {
  known.state = state;
  known.frames = [];
  draw();
  if (state !== 'there') return wire.watch(0, { status: true });
  const reply = await wire.ask(0, { do: 'bench' });
  known.bench = reply.bench;
  const names = reply.bench.devices.flatMap((device) =>
    device.axes.map((axis) => `${device.name}.${axis.name}.position`));
  wire.watch(0, { names, frames: true });
  draw();
}

function draw() {
  render(html`<h1>Understudy</h1>
    <p>${known.state} ${known.time ? `${(known.time.time_ns / 1e9).toFixed(3)} s` : ''}</p>
    <table>${Object.entries(known.values).map(([name, value]) => html`<tr><td>${name}</td><td>${value}</td></tr>`)}</table>
    <ol>${known.frames.map((frame) => html`<li key=${frame.number}>${frame.line} ${frame.text}</li>`)}</ol>`,
    document.getElementById('page'));
}
draw();
