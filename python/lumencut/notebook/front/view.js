// The view of vessels in a notebook: shows the pictures of the kernel side by side, and a line of words.

const TRAIT_OF_PANE = { vessels: 'picture', straightened: '_straightened', section: '_section' };
const PANES = Object.keys(TRAIT_OF_PANE);

function render({ model, el }) {
  const root = el.appendChild(document.createElement('div'));
  root.className = 'lumencut';
  const row = root.appendChild(document.createElement('div'));
  row.className = 'panes';
  const words = root.appendChild(document.createElement('div'));
  words.setAttribute('role', 'status');
  const tell = (text, isWrong) => {
    words.textContent = text;
    words.className = isWrong ? 'words is-wrong' : 'words';
  };
  let wrongWords = '';
  const asker = new Asker(model, tell);
  root.dataset.isResting = 'true';
  const panes = Object.fromEntries(PANES.map((name) => [name, new Pane(name, row)]));
  const wrong = (error) =>
    tell(`The picture cannot be shown: ${error.message ?? error}. Run the cell again.`, true);

  const mark = () => {
    const shown = model.get('_shown');
    panes.vessels.resize(shown.size);
    panes.vessels.mark(shown.cross, shown.points, shown.lines);
    for (const name of ['straightened', 'section']) {
      panes[name].mark(shown.marks[name] ? [shown.marks[name]] : [], [], []);
    }
    return shown;
  };
  const showRest = () => {
    mark();
    const drawn = PANES.map((name) => panes[name].draw(model.get(TRAIT_OF_PANE[name]), 'image/png'));
    return Promise.all(drawn).catch(wrong);
  };
  const showMoving = (names, buffers) =>
    Promise.all(names.map((name, n) => panes[name].draw(buffers[n], 'image/jpeg'))).catch(wrong);
  const hear = (content, buffers) => {
    if (content.kind !== 'answer') {
      return;
    }
    const milliseconds = asker.answered(content.answers);
    const drawn = content.pictures ? showMoving(content.pictures, buffers) : showRest();
    const shown = mark();
    // The picture at rest that follows a step which failed does not take the reason away.
    wrongWords = content.words || (content.pictures ? '' : wrongWords);
    tell(wrongWords || shown.words, wrongWords !== '');
    if (milliseconds !== null) {
      drawn.then(() => {
        root.dataset.milliseconds = milliseconds.toFixed(1);
        root.dataset.answers = content.answers;
        root.dataset.isResting = String(asker.isResting);
      });
    }
  };
  // What Python changes; the answers to own requests are shown as they come.
  const told = () => asker.underWay || tell(mark().words, false);
  const painted = () => asker.underWay || showRest();
  const heard = [
    ['msg:custom', hear],
    ['change:_shown', told],
    ...Object.values(TRAIT_OF_PANE).map((trait) => [`change:${trait}`, painted]),
  ];
  for (const [name, act] of heard) {
    model.on(name, act);
  }
  const stop = new AbortController();
  const pointers = Object.values(panes).map((pane) => new gestures.Pointers(pane, asker));
  for (const one of pointers) {
    one.listen(stop.signal);
  }
  // JupyterLab, which hears keys before the view does, leaves those to it that have this: no other ones.
  const claim = (event) => {
    const heard = pointers.find(({ pane }) => pane.element === event.target);
    root.toggleAttribute('data-lm-suppress-shortcuts', Boolean(heard?.stepOf(event)));
  };
  window.addEventListener('keydown', claim, { capture: true, signal: stop.signal });
  tell(model.get('_shown').words, false);
  showRest().then(() => {
    root.dataset.isReady = 'true';
  });
  return () => {
    stop.abort();
    asker.clear();
    for (const [name, act] of heard) {
      model.off(name, act);
    }
  };
}

export default { render };
