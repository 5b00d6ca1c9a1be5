/** A question to the user. Escape answers it without any effect. */
import type { ComponentChildren } from 'preact';
import { escapeQuestion } from '../state/questions';

export function Question({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div
      class="file-question"
      role="alertdialog"
      aria-label={label}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Escape') {
          escapeQuestion();
        }
      }}
    >
      {children}
    </div>
  );
}
