// The plot of a recording: whole curves, thinned to the dots of the drawing; every tick where the user zooms in.
import { useEffect, useRef, useState } from './preact.js';
import { askQuietly, store } from './store.js';

const kDots = 1500;
const kMargin = 0.25;  // of what is in view, on each side

/// Two points for each dot, so that both its minimum and its maximum are drawn.
function columnsOf(reply, count) {
  const { from_ns, to_ns, curves } = reply;
  const times = [];
  const rows = curves.map(() => []);
  for (let i = 0; i < count; ++i) {
    const at = (share) => (from_ns + (to_ns - from_ns) * (i + share) / count) / 1e9;
    times.push(at(0), at(0.5));
    curves.forEach(({ least, greatest }, row) => {
      const isRising = i === 0 || greatest[i - 1] <= greatest[i];
      rows[row].push(isRising ? least[i] : greatest[i], isRising ? greatest[i] : least[i]);
    });
  }
  return [times, ...rows];
}

/// Returns the columns for these names, and a function to call with the seconds that are in view: `null` for all of
/// them.
export function useRecordedPlot(names) {
  const [columns, setColumns] = useState([[], ...names.map(() => [])]);
  const [view, setView] = useState(null);
  const asked = useRef(0);
  const key = `${store.number} ${names.join('\n')} ${view}`;
  useEffect(() => {
    if (!store.timeline || names.length === 0) return;
    const { begin_ns, end_ns } = store.timeline;
    const [from, to] = view ? view.map((s) => s * 1e9) : [begin_ns, end_ns];
    const room = view ? (to - from) * kMargin : 0;
    // A dot is at least one tick.
    const stretch = [Math.max(begin_ns, Math.floor((from - room) / 1e6) * 1e6), Math.min(end_ns, Math.ceil((to + room) / 1e6) * 1e6)];
    const dots = Math.max(1, Math.min(kDots, Math.round((stretch[1] - stretch[0]) / 1e6)));
    const number = ++asked.current;
    askQuietly({ do: 'curves', names, from_ns: stretch[0], to_ns: stretch[1], dots }).then((reply) => {
      if (reply.ok && number === asked.current) setColumns(columnsOf(reply, dots));
    });
  }, [key, store.timeline === null]);
  const isOfNames = columns.length === names.length + 1;
  return [isOfNames ? columns : [[], ...names.map(() => [])], (to) => setView(to)];
}
