/** Help on mouse, touch and keys, generated from the table of bindings. */
import { useLayoutEffect, useRef } from 'preact/hooks';
import { BINDINGS, inputName, type Where } from '../input/bindings';
import { closeHelp, isHelpOpen } from '../state/store';

const PARTS: readonly (readonly [Where, string])[] = [
  ['turning', 'In the turning view'],
  ['flat', 'In slices, section and straightened vessel'],
  ['tracing', 'While tracing, in all views'],
  ['marks', 'While a marker is focused'],
  ['everywhere', 'Everywhere'],
];

export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  const isOpen = isHelpOpen.value;
  // At once after every render: the report of an earlier close must find a help that was opened again open.
  useLayoutEffect(() => {
    const shown = dialog.current;
    if (isOpen && !shown?.open) {
      shown?.showModal();
    } else if (!isOpen) {
      shown?.close();
    }
  });
  return (
    <dialog
      ref={dialog}
      class="help"
      // The browser reports the close only after the key press; a key pressed in between must find the help closed.
      onCancel={closeHelp}
      onClose={() => !dialog.current?.open && closeHelp()}
      aria-label="Keys and mouse"
    >
      <header>
        <h2>Keys and mouse</h2>
        <button type="button" onClick={closeHelp}>
          Close
        </button>
      </header>
      <div class="help-parts">
        {PARTS.map(([where, title]) => (
          <section key={where}>
            <h3>{title}</h3>
            <dl>
              {BINDINGS.filter((row) => row.where === where).map((row) => (
                <div key={inputName(row)}>
                  <dt>{inputName(row)}</dt>
                  <dd>{row.words}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
      <button type="button" onClick={closeHelp}>
        Close
      </button>
    </dialog>
  );
}
