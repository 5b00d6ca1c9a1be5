import { useRef } from 'preact/hooks';
import { chosen } from '../input/dropped';
import { started } from '../state/store';
import { takeFiles } from '../study/opening';

export function OpenButtons() {
  return (
    <>
      <Chooser words="Choose files" isFolder={false} />
      <Chooser words="Choose a folder" isFolder={true} />
    </>
  );
}

export function OpenMore({ words = 'Open' }: { readonly words?: string }) {
  return <Chooser words={words} isFolder={false} />;
}

interface ChooserProps {
  readonly words: string;
  readonly isFolder: boolean;
}

function Chooser({ words, isFolder }: ChooserProps) {
  const input = useRef<HTMLInputElement>(null);
  const open = (element: HTMLInputElement) => {
    const files = chosen(element.files ?? new DataTransfer().files);
    // Otherwise the same files could not be chosen again.
    element.value = '';
    if (files.length > 0) {
      void takeFiles(files);
    }
  };
  return (
    <>
      <button type="button" disabled={started.value === null} onClick={() => input.current?.click()}>
        {words}
      </button>
      <input
        ref={input}
        hidden
        type="file"
        multiple
        aria-label={words}
        {...(isFolder ? { webkitdirectory: true } : {})}
        onChange={(event) => open(event.currentTarget)}
      />
    </>
  );
}
