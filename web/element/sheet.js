// How <bindpose-viewer> looks. What a page may change are its custom properties and its parts.

export const SHEET = `
:host { display: block !important; overflow: hidden !important; width: 640px; max-width: 100%; aspect-ratio: 4 / 3; }
:host([hidden]), [hidden] { display: none !important; }
/* A page's theme is known by the colour of .view, which bindpose-viewer.js reads. */
.frame { all: initial; color-scheme: inherit; position: relative; width: 100%; height: 100%; aspect-ratio: 4 / 3; display: flex; flex-direction: column; container-type: size; overflow: hidden;
  font: 13px/1.4 system-ui, sans-serif; color: var(--bindpose-text, light-dark(#1b2029, #e7eaf0)); background: var(--bindpose-background, light-dark(#e3e6eb, #22262e));
  border-radius: var(--bindpose-radius, 0); transition: background-color 1ms; --accent: var(--bindpose-accent, light-dark(#1f6fd0, #5aa9ff)); }
.stage { position: relative; flex: 1; min-height: 0; }
.view, .view canvas, .over { position: absolute; inset: 0; width: 100%; height: 100%; }
.view { color: light-dark(#000, #fff); transition: color 1ms; }
.view > div { position: absolute; inset: 0; }
.view > .dropped { outline: 2px solid var(--accent); outline-offset: -2px; }
.spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.view canvas { display: block; outline: none; }
.view.turned canvas { touch-action: none; }
.view:not(.drawn) canvas { visibility: hidden; }
:host([interaction=none]) .view { pointer-events: none; }
.over { display: grid; place-items: center; pointer-events: none; text-align: center; padding: 16px; box-sizing: border-box; }
.poster { padding: 0; }
.poster img { width: 100%; height: 100%; object-fit: cover; }
.error slot { font-size: 14px; }
.error p, .error ::slotted(*) { margin: 0; padding: 8px 12px; max-width: 46ch; white-space: pre-line; overflow-wrap: anywhere; border-radius: 8px; background: var(--bindpose-panel, light-dark(#f6f7f9, #181b21)); }
progress { width: 40%; accent-color: var(--accent); }
[part=transport] { display: flex; align-items: center; gap: 6px; padding: 4px 6px; background: var(--bindpose-panel, light-dark(#f6f7f9, #181b21)); }
[part=transport] :is(button, select) { font: inherit; color: inherit; background: none; border: 0; border-radius: 6px; min-width: 32px; height: 32px; padding: 0 6px; cursor: pointer; }
[part=transport] :is(button, select, input):disabled { opacity: 0.5; cursor: default; }
[part=transport] select { max-width: 9em; }
[part=transport] option { color: light-dark(#1b2029, #e7eaf0); background: light-dark(#fff, #22262e); }
[part=transport] button { display: grid; place-items: center; }
[part=transport] svg { width: 16px; height: 16px; fill: currentColor; }
[part=time] { flex: 1; min-width: 40px; accent-color: var(--accent); }
[part=time-text] { font-variant-numeric: tabular-nums; min-width: 5ch; }
:is(button, select, input, canvas):focus-visible { outline: 2px solid var(--accent); outline-offset: -2px; }
@media (pointer: coarse) { [part=transport] :is(button, select) { height: 44px; min-width: 44px; } }
@container (width < 420px) { [part=time-text], [part=speed] { display: none; } }
`;
