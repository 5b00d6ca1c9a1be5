import { useSignal, useSignalEffect } from '@preact/signals';
import { dropped } from '../input/dropped';
import { hasVolume, started } from '../state/store';
import { takeFiles } from '../study/opening';

export function DropZone() {
  const isOver = useSignal(false);
  useSignalEffect(() => {
    const ended = new AbortController();
    listen(ended.signal, (value) => {
      isOver.value = value;
    });
    return () => ended.abort();
  });
  if (!isOver.value) {
    return null;
  }
  const words = hasVolume.value
    ? 'Drop centerlines or a vessel mask to add vessels, or drop another scan'
    : 'Drop a scan here, with or without its centerlines';
  return <div class="drop-zone">{words}</div>;
}

function listen(signal: AbortSignal, show: (isOver: boolean) => void): void {
  const hasFiles = (event: DragEvent) => Boolean(event.dataTransfer?.types.includes('Files'));
  const over = (event: DragEvent) => {
    if (hasFiles(event)) {
      event.preventDefault();
      show(true);
    }
  };
  const leave = (event: DragEvent) => {
    if (event.relatedTarget === null) {
      show(false);
    }
  };
  const drop = (event: DragEvent) => {
    show(false);
    if (event.dataTransfer && hasFiles(event)) {
      event.preventDefault();
      void open(event.dataTransfer);
    }
  };
  window.addEventListener('dragenter', over, { signal });
  window.addEventListener('dragover', over, { signal });
  window.addEventListener('dragleave', leave, { signal });
  window.addEventListener('drop', drop, { signal });
}

async function open(transfer: DataTransfer): Promise<void> {
  const files = await dropped(transfer);
  if (files.length > 0 && started.value) {
    await takeFiles(files);
  }
}
