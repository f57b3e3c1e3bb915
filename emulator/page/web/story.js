// For a recording: how it failed, what led to that, and whether the page shows what happened or a trial.
import { html } from './preact.js';
import { ask, isAltered, isReadOnly, store } from './store.js';
import { Button, seconds } from './small.js';
import { leaveMoment } from './link.js';
import { keep, useKept } from './kept.js';
import { isTold } from './told.js';

export async function goTo(to_ns) {
  leaveMoment();
  await ask({ do: 'seek', to_ns });
}

/// The names that the failure is about, as curves.
function plotNames(names) {
  keep('plotted', names.slice(0, 8));
  keep('panel', 'Plot', { of: '' });
}

export function Story() {
  const { story, scenario } = store.timeline ?? {};
  const [isOpen, open] = useKept('what led to the failure', innerWidth > 700);
  if (!story) return null;
  const isThere = store.look?.time_ns === story.time_ns;
  return html`<section class="story" aria-label="the failure">
    <p><strong class="bad">${scenario ? `${scenario}: ` : ''}${story.text}</strong>
      <span class="joined"><${Button} kind="small" title="go to the failure" disabled=${isThere || isReadOnly() || isAltered()} does=${() => goTo(story.time_ns)}>go there<//>
      <${Button} kind="small" title="show or hide what led to the failure" pressed=${isOpen} does=${() => open(!isOpen)}>what led to it<//>
      ${story.names.length > 0 && html`<${Button} kind="small" title=${`plot ${story.names.join(', ')}`} does=${() => plotNames(story.names)}>plot its names<//>`}</span></p>
    ${isOpen && html`<ol>${story.moments.map((moment, i) => html`<li key=${i}><button type="button" class="link" disabled=${isReadOnly() || isAltered()}
      title=${`go to ${seconds(moment.time_ns)}`} onClick=${() => goTo(moment.time_ns)}>${seconds(moment.time_ns)}</button> ${moment.text}</li>`)}
      ${story.moments.length === 0 && html`<li>No event touched its names.</li>`}</ol>`}
  </section>`;
}

/// Whether the recording is shown or a trial, with a way between them.
export function WhatIf() {
  if (isAltered()) {
    return html`<span class="badge">altered since ${seconds(store.look.altered_at_ns)}: not what happened</span>
      <${Button} kind="small main" title="back to the recording" disabled=${isReadOnly()} does=${() => ask({ do: 'what-if', off: true })}>back to the recording<//>`;
  }
  return html`<span class="badge calm">recording</span>${!isTold && html`<${Button} kind="small" title="try what would happen from here; the recording stays as it is" disabled=${isReadOnly()}
    does=${() => ask({ do: 'what-if' })}>what if ...<//>`}`;
}
