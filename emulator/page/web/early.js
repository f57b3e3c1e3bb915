// Connects before the rest of the page has arrived, and asks for what its first view needs, because round trips may be
// slow. wire.js takes over the connection, with everything that it has received.
(() => {
  const asked = [{ do: 'bench' }, { do: 'bench', device: '*' }, { do: 'timeline', from: 0 }];
  /** @type {any} */
  const early = { socket: new WebSocket(`ws://${location.host}/ws`), asked: asked.map((message) => JSON.stringify(message)), heard: [], closed: null };
  early.socket.onopen = () => {
    const say = (message) => early.socket.send(JSON.stringify(message));
    say({ token: location.hash.slice(1).split('&')[0] });
    say({ do: 'watch', bench: 0, names: [] });
    asked.forEach((message, id) => say({ do: 'ask', bench: 0, id, message }));
  };
  early.socket.onmessage = (event) => early.heard.push(event);
  early.socket.onclose = (event) => { early.closed = event; };
  Object.assign(globalThis, { early });
})();
