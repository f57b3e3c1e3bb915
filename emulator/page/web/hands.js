// Wheel, mouse and fingers on the timeline.
import { useEffect, useRef } from './preact.js';

const kSlack = 5;  // dots; less is a click

/// `on`: { time(x), left, zoom, pan, go, marks, setMark, hover, stretch, dots }. Returns the event handlers of a
/// canvas.
export function useHands(canvas, on) {
  const fingers = useRef(new Map());
  const drag = useRef(null);  // { x, y, stretch, isMark, isMoved }
  const latest = useRef(on);
  latest.current = on;

  useEffect(() => {
    const box = canvas.current;
    // Not passive, because the page must not scroll too; over the labels it does.
    const wheel = (event) => {
      const { left, time, zoom, pan, stretch, dots } = latest.current;
      const x = event.offsetX;
      if (x < left && left > 0) return;
      event.preventDefault();
      if (Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey) {
        pan((event.deltaX || event.deltaY) / Math.max(dots, 1) * (stretch[1] - stretch[0]));
      } else {
        zoom(Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 0.003), time(x));
      }
    };
    box.addEventListener('wheel', wheel, { passive: false });
    return () => box.removeEventListener('wheel', wheel);
  }, []);

  const place = (event) => {
    const box = canvas.current.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const perDot = () => (drag.current.stretch[1] - drag.current.stretch[0]) / Math.max(on.dots, 1);
  const begin = (event) => {
    const [x, y] = place(event);
    drag.current = { x, y, stretch: on.stretch, isMark: on.marks !== event.shiftKey, isMoved: false };
  };
  const pinch = () => {
    const [[x1], [x2]] = [...fingers.current.values()];
    const { pinched } = drag.current;
    const apart = Math.max(Math.abs(x1 - x2), 8);
    on.zoom(pinched / apart, on.time((x1 + x2) / 2));
    drag.current.pinched = apart;
  };
  return {
    onPointerDown: (event) => {
      if (event.button !== 0) return;
      canvas.current.setPointerCapture(event.pointerId);
      fingers.current.set(event.pointerId, place(event));
      if (fingers.current.size === 1) return void begin(event);
      const [[x1], [x2]] = [...fingers.current.values()];
      Object.assign(drag.current, { pinched: Math.max(Math.abs(x1 - x2), 8), isMoved: true });
    },
    onPointerMove: (event) => {
      const [x, y] = place(event);
      if (!fingers.current.has(event.pointerId)) return void on.hover(x < on.left ? null : x, y);
      fingers.current.set(event.pointerId, [x, y]);
      if (fingers.current.size > 1) return void pinch();
      const by = x - drag.current.x;
      if (!drag.current.isMoved && Math.abs(by) < kSlack) return;
      drag.current.isMoved = true;
      on.hover(null);
      if (drag.current.isMark) on.setMark([on.time(drag.current.x), on.time(x)].sort((a, b) => a - b).map(Math.round));
      else on.pan(drag.current.stretch[0] - by * perDot() - on.stretch[0]);
    },
    onPointerUp: (event) => {
      const isClick = fingers.current.size === 1 && drag.current && !drag.current.isMoved;
      fingers.current.delete(event.pointerId);
      if (isClick && drag.current.x >= on.left) on.go(on.time(drag.current.x));
    },
    onPointerCancel: (event) => { fingers.current.delete(event.pointerId); },
    onPointerLeave: () => on.hover(null),
    onDblClick: (event) => on.zoom(0.25, on.time(place(event)[0])),
  };
}
